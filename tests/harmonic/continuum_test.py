# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests bench/continuum against exact solutions, with every kind of input: layers, placed surfaces, scans and voids.
Also compares `macadam ct modulus` with bench/continuum.

usage: continuum_test.py PROGRAM [MACADAM]; exit code 1 if something is wrong."""
import cmath
import csv
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

# The solver ends at a residual of 1e-6 of the first one. The modulus follows from the energy, whose error is the square
# of this; the printed digits are ten.
TOLERANCE = 1e-9
MASTIC, PHASE, ROCK = 4e9, 30.0, 60e9
SOFT = cmath.rect(MASTIC, math.radians(PHASE))
SERIES = 2 / (1 / SOFT + 1 / ROCK)  # equal layers of both phases without Poisson's ratio
NO_POISSON = ("--mastic", MASTIC, PHASE, 0, "--rock", ROCK, 0, 0)


class Checks:
    """Runs the program, compares, and counts what is wrong."""

    def __init__(self, program):
        self.program, self.wrong = program, 0

    def expect(self, condition, message):
        """Counts and prints a fault."""
        if not condition:
            print(message)
            self.wrong += 1

    def rows(self, *arguments):
        """Returns the rows of the program's table; phases are radians there."""
        out = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.expect(out.returncode == 0, f"{arguments}: {out.stderr}")
        return list(csv.DictReader(out.stdout.splitlines()))

    def exact(self, name, modulus, poisson, *arguments, mixings=("stiff", "soft")):
        """Compares the moduli and Poisson's ratios of some mixing rules with exact values."""
        rows = [row for row in self.rows(*arguments) if row["mixing"] in mixings]
        self.expect(len(rows) > 0, f"{name}: no results")
        for row in rows:
            found = cmath.rect(float(row["e_star_pa"]), math.radians(float(row["phase_deg"])))
            ratio = float(row["poisson_ratio"])
            # phases are printed to 1e-6 degrees, which is 1.7e-8 rad; Poisson's ratio is as exact as the displacement
            self.expect(abs(abs(found) / abs(modulus) - 1) <= TOLERANCE and abs(cmath.phase(found / modulus)) <= 2e-8 and
                        abs(ratio - poisson) <= 1e-6, f"{name}: found {found} and {ratio}, expected {modulus} and {poisson}")

    def refused(self, message, *arguments):
        """Checks that the program ends with a message."""
        out = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.expect(out.returncode != 0 and message in out.stderr, f"expected \"{message}\", found \"{out.stderr.strip()}\"")


def layers(check):
    """Tests a homogeneous bar, and layers, which may end inside a voxel."""
    mastic = ("--mastic", MASTIC, PHASE, 0.3)
    box = ("--box", 0.004, 0.004, 0.008, "--voxel", 0.001)
    check.exact("homogeneous", SOFT, 0.3, "--layers", "z", *box, *mastic, "--rock", MASTIC, PHASE, 0.3)
    # equal lateral strains, so no stress between the layers
    check.exact("in parallel", (SOFT + ROCK) / 2, 0.3, "--layers", "x", *box, *mastic, "--rock", ROCK, 0, 0.3)
    check.exact("in series", SERIES, 0, "--layers", "z", *box, *NO_POISSON)
    # coarser grids with an odd number of layers and with columns without material
    large = ("--box", 0.018, 0.021, 0.03, "--voxel", 0.001)
    check.exact("homogeneous, 15 coarse layers", SOFT, 0.3, "--layers", "z", *large, *mastic, "--rock", MASTIC, PHASE, 0.3)
    check.exact("in series, 15 coarse layers", SERIES, 0, "--layers", "z", *large, *NO_POISSON)
    # the middle layer of voxels is cut: the soft rule is exact in series, so the extrapolation is, too
    cut = ("--layers", "z", "--box", 0.004, 0.004, 0.006, "--voxel", 0.002, 0.0004)
    check.exact("cut in series", SERIES, 0, *cut, *NO_POISSON, mixings=("soft", "extrapolated"))


def surfaces(check, folder):
    """Tests the pose of a surface: scale, centroid and rotation."""
    # A block of 1 × 1 × 3. D^L is its diagonal. D^I, the longest chord perpendicular to it, is (1, 1, −2/3).
    corners = [(x + 5, y - 2, z) for z in (0, 3) for y in (0, 1) for x in (0, 1)]
    facets = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
              (1, 3, 5), (3, 7, 5)]
    library = folder / "library"
    library.mkdir()
    (library / "block.off").write_text("OFF\n8 12 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in corners) +
                                       "".join(f"3 {a} {b} {c}\n" for a, b, c in facets))
    size = 0.001 * math.sqrt(2 + 4 / 9)
    file = folder / "aggregates.csv"
    header = "body,shape,size,x,y,z,qw,qx,qy,qz\n"
    arguments = ("--aggregates", file, "--shapes", library, "--box", 0.003, 0.001, 0.002, "--voxel", 0.0005)
    # The rotation by 120 degrees about (1, 1, 1) turns z into x. The block then fills the upper half of the box.
    file.write_text(header + f"0,block,{size!r},0.0015,0.0005,0.0015,0.5,0.5,0.5,0.5\n")
    check.exact("a block as upper layer", SERIES, 0, *arguments, *NO_POISSON)
    # The block is turned and halved, and a ball is added. Volumes follow from 8 × 8 lines per voxel.
    file.write_text(header + f"0,block,{size / 2!r},0.0015,0.0011,0.0007,0.8,0.36,0.48,0\n"
                    "1,sphere,0.001,0.0015,0.001,0.0022,1,0,0,0\n")
    arguments = ("--aggregates", file, "--shapes", library, "--box", 0.003, 0.002, 0.003, "--voxel", 0.00025)
    expected = (0.375e-9 + math.pi / 6 * 1e-9) / 18e-9
    found = float(check.rows(*arguments, *NO_POISSON)[0]["rock_fraction"])
    check.expect(abs(found / expected - 1) < 2e-3, f"a turned block and a ball: found {found} of rock, expected {expected}")
    for line, message in (("0,block,1e-3,0,0,0,1,1,0,0", "aggregates.csv:2: found a quaternion of norm 1.41"),
                          ("0,cube,1e-3,0,0,0,1,0,0,0", "aggregates.csv:2: found the shape \"cube\""),
                          ("0,block,-1,0,0,0,1,0,0,0", "found -1 in column size, expected a positive number"),
                          ("0,block,1e-3,0,x,0,1,0,0,0", "found \"x\" in column y, expected a number"),
                          ("0,block,1e-3", "found 3 values, expected 10")):
        file.write_text(header + line + "\n")
        check.refused(message, *arguments, *NO_POISSON)


def voids(check, folder):
    """Tests that the solver converges with voids, and the modulus of a body with one small void."""
    ball = folder / "ball.csv"
    ball.write_text("x,y,z,radius\n0.005,0.005,0.005,0.0015\n")
    homogeneous = ("--layers", "z", "--mastic", MASTIC, PHASE, 0.2, "--rock", MASTIC, PHASE, 0.2)
    rows = check.rows("--voids", ball, "--box", 0.01, 0.01, 0.01, "--voxel", 0.001, 0.0005, 0.00025, *homogeneous)
    fraction = 4 / 3 * math.pi * 0.15**3
    check.expect(abs(float(rows[-1]["void_fraction"]) / fraction - 1) < 2e-3, f"voids: found {rows[-1]}, expected {fraction}")
    # A spherical void in an infinite body with Poisson's ratio 0.2 has E = E_0·(1 − 2·fraction). The free sides are 2.3
    # radii away, so this holds to some tenths of the difference.
    loss = (1 - float(rows[-1]["e_star_pa"]) / MASTIC) / fraction
    check.expect(1.8 < loss < 2.4, f"voids: the modulus falls by {loss} times the fraction, expected about 2")
    check.expect(all(int(row["iterations"]) <= 15 for row in rows[:-1]), f"voids: more than 15 iterations: {rows}")
    # A void that cuts the specimen in two
    ball.write_text("x,y,z,radius\n0.002,0.002,0.004,0.003\n")
    check.refused("connection of bottom and top: found none", "--voids", ball, "--box", 0.004, 0.004, 0.008, "--voxel", 0.001, *homogeneous)


def scans(check, folder):
    """Tests MetaImages: packed or not, phases and labels, a specimen with another outline than a box."""
    size = (14, 12, 16)
    phases = {}  # a prism with an L as cross-section, its upper half rock
    for k in range(size[2]):
        for j in range(size[1]):
            for i in range(size[0]):
                inside = 2 <= i < 10 and 1 <= j < 11 and (i < 6 or j < 7) and 4 <= k < 12
                phases[i, j, k] = 255 if not inside else 2 if k >= 8 else 1
    cells = [phases[i, j, k] for k in range(size[2]) for j in range(size[1]) for i in range(size[0])]

    def image(name, kind, data, packed=False, spacing="0.5 0.5 0.5"):
        data = zlib.compress(data) if packed else data
        header = (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = {packed}\n"
                  f"ElementSpacing = {spacing}\nDimSize = {size[0]} {size[1]} {size[2]}\nElementType = {kind}\n"
                  "ElementDataFile = LOCAL\n")
        (folder / name).write_bytes(header.encode() + data)
        return "--scan", folder / name

    for packed in (False, True):
        scan = image("phases.mha", "MET_UCHAR", bytes(cells), packed)
        for voxel in (0.0005, 0.001):
            check.exact(f"scan, packed {packed}, voxel {voxel}", SERIES, 0, *scan, "--voxel", voxel, *NO_POISSON)
    check.exact("outline", SOFT, 0.3, *scan, "--voxel", 0.0005, "--mastic", MASTIC, PHASE, 0.3, "--rock", MASTIC, PHASE, 0.3)
    labels = struct.pack(f"<{len(cells)}I", *(1000 if n // (size[0] * size[1]) >= 8 else 0 for n in range(len(cells))))
    check.exact("labels", SERIES, 0, *image("labels.mha", "MET_UINT", labels), "--voxel", 0.001, *NO_POISSON)
    check.refused("expected a multiple of the scan's", *scan, "--voxel", 0.0007, *NO_POISSON)
    check.refused("expected equal edges", *image("flat.mha", "MET_UCHAR", bytes(cells), spacing="1 1 2"), "--voxel", 0.001, *NO_POISSON)
    check.refused("expected 2688", *image("short.mha", "MET_UCHAR", bytes(cells[1:])), "--voxel", 0.001, *NO_POISSON)
    check.refused("phase of a voxel: found 7", *image("seven.mha", "MET_UCHAR", bytes([7] * len(cells))), "--voxel", 0.001, *NO_POISSON)
    check.refused("--mastic: found a modulus of -1", *scan, "--voxel", 0.001, "--mastic", -1, 0, 0)
    check.refused("--box: missing", "--layers", "z", "--voxel", 0.001, *NO_POISSON)


def command(check, folder, macadam):
    """Compares `macadam ct modulus` with the program for a scan of balls and voids, at two frequencies."""
    edge, maxwell, viscosity = 32, 5e9, 4e8
    balls = [(9, 9, 9, 8, 2), (23, 21, 10, 8, 2), (14, 20, 24, 7, 2), (25, 7, 23, 5, 2), (6, 26, 14, 3, 0), (18, 5, 16, 4, 0)]

    def phase(i, j, k):
        inside = (number for x, y, z, r, number in balls if (i - x)**2 + (j - y)**2 + (k - z)**2 < r * r)
        return next(inside, 1)

    cells = bytes(phase(i, j, k) for k in range(edge) for j in range(edge) for i in range(edge))
    (folder / "scan").mkdir()
    file = folder / "scan" / "phases.mha"
    file.write_bytes(f"ObjectType = Image\nNDims = 3\nElementSpacing = 0.5 0.5 0.5\nDimSize = {edge} {edge} {edge}\n"
                     "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n".encode() + cells)
    (folder / "scene.toml").write_text(
        "[specimen]\nbox = [0.01, 0.01, 0.01]\n[specimen.mastic]\nradius = [0.001, 0.001]\nporosity = 0.3\n"
        '[network]\nrule = "series"\n[materials.aggregate]\ndensity = 2600\nlaw = "elastic"\nE = 60e9\npoisson_ratio = 0.28\n'
        '[materials.mastic]\ndensity = 2000\nlaw = "generalised_kelvin"\npoisson_ratio = 0.35\n'
        f"E_m = {maxwell}\nC_m = {viscosity}\n"
        '[loading]\nkind = "cyclic"\nfrequencies = [1.0, 10.0]\n[solver]\nmethod = "harmonic"\n')
    out = subprocess.run([macadam, "ct", "modulus", folder / "scan", "--scene", folder / "scene.toml", "--out", folder / "out"],
                         capture_output=True, text=True, check=False)
    check.expect(out.returncode == 0, f"ct modulus: {out.stderr}")
    with (folder / "out" / "modulus.csv").open(encoding="utf-8") as table:
        found = list(csv.DictReader(table))
    mastics = []
    for frequency in (1.0, 10.0):
        modulus = 1 / (1 / maxwell + 1 / (2j * math.pi * frequency * viscosity))
        mastics += ["--mastic", repr(abs(modulus)), repr(math.degrees(cmath.phase(modulus))), 0.35]
    rows = check.rows("--scan", file, "--voxel", 0.002, 0.001, 0.0005, *mastics, "--rock", 60e9, 0, 0.28)
    expected = [row for row in rows if row["mixing"] == "extrapolated"]
    check.expect(len(found) == len(expected) == 2, f"ct modulus: {len(found)} and {len(expected)} results, expected 2")
    for a, b in zip(found, expected):
        # Both programs stop at a residual of 1e-6, but they start from different displacements if no voxel is cut.
        near = [("e_star_pa", TOLERANCE * float(b["e_star_pa"])), ("phase_deg", 2e-6), ("poisson_ratio", 1e-6)]
        for name, tolerance in near:
            check.expect(abs(float(a[name]) - float(b[name])) <= tolerance, f"ct modulus: {name} {a[name]}, expected {b[name]}")
        # printed with three digits
        check.expect(math.isclose(float(a["e_star_uncertainty_pa"]), float(b["e_star_uncertainty_pa"]), rel_tol=0.01),
                     f"ct modulus: uncertainty {a['e_star_uncertainty_pa']}, expected {b['e_star_uncertainty_pa']}")


def main():
    """Returns 1 if something is wrong."""
    check = Checks(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        layers(check)
        surfaces(check, pathlib.Path(folder))
        voids(check, pathlib.Path(folder))
        scans(check, pathlib.Path(folder))
        if len(sys.argv) > 2 and sys.argv[2]:
            command(check, pathlib.Path(folder), sys.argv[2])
    return check.wrong > 0


if __name__ == "__main__":
    sys.exit(main())
