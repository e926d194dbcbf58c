# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubic lattices of equal spheres, one layer thick, and runs of scenes with them.

The spacing is 1 mm, the modulus of all contacts 1 GPa and the tensile strength of a facet 1 MPa. Therefore the fracture
energy in J/m2 is the characteristic length E G_f/f_t^2 in mm. With alpha = 1 the lattice is isotropic and has Poisson's
ratio 0."""
import csv
import json
import math
import os
import resource
import shutil
import subprocess
import time

from paper_runs import commit_of_tree, processor

SPACING = 1e-3  # m, also the thickness of the layer
MODULUS = 1e9  # Pa
STRENGTH = 1e6  # Pa, of a facet in tension

SCENE = """[specimen]
{specimen}
[materials]
mastic = {{ density = 2000 }}
[[contacts]]
pair = "M-M"
law = "elastic"
E = {modulus!r}
alpha = 1.0
{crack}
[[contacts]]
pair = "M-W"
law = "elastic"
E = {modulus!r}
[network]
lateral_walls = {walls}
[loading]
{loading}
[solver]
method = "quasi_static"
tolerance = {tolerance}
"""

def spheres(columns, rows):
    """Returns the centres (x, z) of a cubic lattice in m, and the width and the height of its box in m."""
    centres = [((i + 0.5) * SPACING, (k + 0.5) * SPACING) for k in range(rows) for i in range(columns)]
    return centres, columns * SPACING, rows * SPACING


def box(width, height):
    """Returns the keys of a box of one layer."""
    return f"box = [{width!r}, {SPACING!r}, {height!r}]"


def notch(axis, at, limits):
    """Returns the section of a notch perpendicular to an axis; limits: text of its other key."""
    return f'[[specimen.notch]]\naxis = "{axis}"\nat = {at!r}\n{limits}'


def crack(energy, shear=1.0):
    """Returns the key `crack`. shear: shear strength over tensile strength. The shear energy is chosen so that the
    initial slopes of both softening curves are equal."""
    return (f'crack = {{ tensile_strength = {STRENGTH!r}, fracture_energy = "{energy!r} J/m2", shear_strength = '
            f'{shear * STRENGTH!r}, shear_fracture_energy = "{shear * shear * energy!r} J/m2" }}')


class Bench:
    """Runs scenes with one thread below a folder."""

    def __init__(self, macadam, folder):
        self.macadam, self.folder = macadam, folder
        self.origin = {"date": time.strftime("%Y-%m-%d", time.gmtime()), "commit": None, "machine": processor()}

    def run(self, name, specimen, loading, crack_key="", notches="", centres=None, walls=False, tolerance=1e-2):
        """Runs a scene. centres: (x, z) of a lattice, or None if the section describes a generated specimen.
        Returns the entry of `results` in summary.json, with the number of particles, the rows of the table and the
        processor time in s. Ends the process if the run fails."""
        work = self.folder / name
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        if centres is not None:
            with open(work / "lattice.csv", "w", encoding="utf-8") as out:
                out.write("id,x,y,z,radius,phase,body\n")
                out.writelines(f"{n},{x:.12g},{SPACING / 2:.12g},{z:.12g},{SPACING / 2:.12g},mastic,-1\n"
                               for n, (x, z) in enumerate(centres))
            specimen += '\nfile = "lattice.csv"'
        (work / "scene.toml").write_text(
            SCENE.format(specimen="\n".join(filter(None, (specimen, notches))), crack=crack_key, loading=loading,
                         modulus=MODULUS, tolerance=tolerance, walls=str(walls).lower()), encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([str(self.macadam), "run", str(work / "scene.toml"), "--out", str(work / "out"),
                               "--threads", "1"], env=dict(os.environ, OMP_NUM_THREADS="1"), capture_output=True,
                              text=True, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            raise SystemExit(f"{name}: exit code {done.returncode}: {done.stderr[-600:].strip()}")
        summary = json.loads((work / "out" / "summary.json").read_text(encoding="utf-8"))
        self.origin["commit"] = summary["macadam"].rpartition("+g")[2] or commit_of_tree()
        result = summary["results"][0]
        tables = (work / "out").glob("*.csv")
        table = next(file for file in tables if file.stem in ("monotonic", "indirect_tensile_strength",
                                                              "semicircular_bending"))
        with open(table, encoding="utf-8") as lines:
            result["rows"] = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        result["particles"] = summary["particles"]
        result["processor_s"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return result

    def row(self, result, **values):
        """Returns a row of a table: the values, then particles, processor time, and the origin of the row."""
        print(values, f"{result['processor_s']:.0f} s", flush=True)
        return {**{key: f"{value:.6g}" if isinstance(value, float) else value for key, value in values.items()},
                "particles": result["particles"], "processor_s": f"{result['processor_s']:.1f}", **self.origin}


def strain_before_drop(result):
    """Returns the strain of the last equilibrium before the first sudden drop."""
    return result["sudden_drops"]["first_strain"]
