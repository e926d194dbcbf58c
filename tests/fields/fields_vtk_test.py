# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that VTK reads what `[output] fields` writes, in both formats, with the numbers of specimen.csv and contacts.csv.

usage: fields_vtk_test.py REPOSITORY PROGRAM; exit code 1 if something is wrong, 77 (skipped) if VTK 9.3 or newer
is not available: `scripts/vtk-python` installs it."""
import csv
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
OWN = ROOT / "build" / "vtk" / "bin" / "python3"  # installed by scripts/vtk-python
try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    if OWN.exists() and Path(sys.prefix).resolve() != (ROOT / "build" / "vtk").resolve():
        os.execv(OWN, [str(OWN), *sys.argv])
    print(f"skipped: {error}; scripts/vtk-python installs it")
    sys.exit(77)
if (vtk.vtkVersion.GetVTKMajorVersion(), vtk.vtkVersion.GetVTKMinorVersion()) < (9, 3):
    print(f"skipped: VTK {vtk.vtkVersion.GetVTKVersion()} is older than 9.3, the first that reads PolyData with time")
    sys.exit(77)

SCENE = """
[specimen]
file = "{data}/t8.csv"
box = [0.008, 0.008, 0.011]
[loading]
kind = "cyclic"
frequencies = [20.0]
samples_per_cycle = 40
[solver]
method = "{method}"
backend = "cpu"
{solver}
[output]
contacts = true
fields = [{fields}]
format = "{format}"
"""
LAWS = """
[materials.aggregate]
density = 2630.0
[materials.mastic]
density = 2110.0
"""
for pair, alpha in (("M-M", 0.1), ("M-A", 0.1)):
    LAWS += f'[[contacts]]\npair = "{pair}"\nlaw = "generalised_kelvin"\nE_m = 1.1e10\nC_m = 2.5e9\n' \
            f"E = [3.8e8, 1.6e9]\nC = [8.9e9, 5.7e9]\nalpha = {alpha}\n"
for pair in ("A-A", "A-W", "M-W"):
    LAWS += f'[[contacts]]\npair = "{pair}"\nlaw = "elastic"\nE = 1.1e11\nalpha = 0.05\n'
PAIRS = ["M-M", "M-A", "A-A", "inner", "A-W", "M-W"]
faults = []


def check(holds, what):
    if not holds:
        faults.append(what)


def equal(found, expected, what):
    """Checks that the values of a field equal, bit by bit, the values of a CSV file rounded to single precision."""
    found = np.asarray(found)
    expected = np.asarray(expected).astype(found.dtype)
    check(found.shape == expected.shape and np.array_equal(found, expected), f"{what}: {found} is not {expected}")


def run(folder, *arguments):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"macadam {arguments}: exit code {done.returncode}\n{done.stderr}")


def write_scene(folder, form, fields, method="harmonic", solver=""):
    quoted = ", ".join(f'"{f}"' for f in fields)
    text = SCENE.format(data=ROOT / "tests" / "data", method=method, solver=solver, fields=quoted, format=form)
    (folder / "scene.toml").write_text(text + LAWS, encoding="utf-8")


class Errors:
    """Collects the errors and warnings of VTK, because VTK continues after them."""

    def __init__(self, algorithm):
        algorithm.AddObserver("ErrorEvent", lambda *_: faults.append(f"VTK complains of {algorithm.GetFileName()}"))
        algorithm.AddObserver("WarningEvent", lambda *_: faults.append(f"VTK warns of {algorithm.GetFileName()}"))


def frames(file):
    """Returns (time or None, PolyData) of each frame of a .vtkhdf, .pvd or .vtp file."""
    if file.suffix == ".pvd":
        listed = [(float(d.get("timestep")), file.parent / d.get("file")) for d in xml.parse(file).iter("DataSet")]
        return [(time, frames(name)[0][1]) for time, name in listed]
    reader = vtk.vtkHDFReader() if file.suffix == ".vtkhdf" else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    Errors(reader)
    reader.UpdateInformation()
    if file.suffix == ".vtkhdf":
        key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        information = reader.GetOutputInformation(0)
        times = [information.Get(key, i) for i in range(information.Length(key))] if information.Has(key) else [None]
    else:
        times = [None]
    out = []
    for time in times:
        if time is None:
            reader.Update()
        else:
            reader.UpdateTimeStep(time)
        data = reader.GetOutputDataObject(0)
        if data.IsA("vtkPartitionedDataSet"):
            data = data.GetPartition(0)
        copy = vtk.vtkPolyData()
        copy.DeepCopy(data)
        out.append((time, copy))
    return out


def arrays(data):
    attributes = data.GetPointData() if data.GetPointData().GetNumberOfArrays() else data.GetCellData()
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)) for i in range(attributes.GetNumberOfArrays())}


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def rows_of(file):
    with open(file, encoding="utf-8") as f:
        return list(csv.DictReader(f))


def column(rows, *names):
    values = [[float(row[n]) for n in names] for row in rows]
    return np.array(values)[:, 0] if len(names) == 1 else np.array(values)


def check_specimen(out, ending):
    """Compares particles, contacts and cells of files without times with the CSV files."""
    rows = rows_of(out / "specimen.csv")
    [(_, particles)] = frames(out / "fields" / f"particles{ending}")
    centres, found = column(rows, "x", "y", "z"), arrays(particles)
    equal(points(particles), centres, "particles: points")
    check(particles.GetNumberOfVerts() == len(rows), "particles: vertices")
    equal(found["radius"], column(rows, "radius"), "radius")
    equal(found["body"], column(rows, "body"), "body")
    equal(found["phase"], [["aggregate", "mastic"].index(row["phase"]) for row in rows], "phase")
    rows = rows_of(out / "contacts.csv")
    [(_, contacts)] = frames(out / "fields" / f"contacts{ending}")
    found = arrays(contacts)
    check(contacts.GetNumberOfLines() == len(rows), "contacts: lines")
    for name in ("a", "b", "area", "distance"):
        equal(found[name], column(rows, name), f"contacts: {name}")
    equal(found["normal"], column(rows, "nx", "ny", "nz"), "contacts: normal")
    equal(found["pair"], [PAIRS.index(row["pair"]) for row in rows], "contacts: pair")
    ends = vtk_to_numpy(contacts.GetLines().GetConnectivityArray()).reshape(-1, 2)
    equal(ends[:, 0], found["a"], "contacts: first end")
    inner = found["b"] >= 0
    equal(ends[inner, 1], found["b"][inner], "contacts: second end")
    check(np.abs(points(contacts)[ends[~inner, 1]] / [0.008, 0.008, 0.011] - 0.5).max(axis=1).min() > 0.5 - 1e-6,
          "contacts: feet are not on walls")
    [(_, cells)] = frames(out / "fields" / f"cells{ending}")
    found = arrays(cells)
    volume = vtk.vtkMassProperties()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(cells)
    chosen = vtk.vtkThreshold()  # the surface of a single cell is closed, so it has a volume
    chosen.SetInputConnection(triangles.GetOutputPort())
    chosen.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "particle")
    total = 0
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(chosen.GetOutputPort())
    again = vtk.vtkTriangleFilter()
    again.SetInputConnection(surface.GetOutputPort())
    volume.SetInputConnection(again.GetOutputPort())
    for cell in range(len(centres)):
        chosen.SetLowerThreshold(cell)
        chosen.SetUpperThreshold(cell)
        volume.Update()
        total += volume.GetVolume()
    check(abs(total / (0.008 * 0.008 * 0.011) - 1) < 1e-5, f"cells: volumes sum up to {total}")
    check(set(found["phase"]) <= {0, 1} and found["neighbour"].min() == -6, "cells: phases, neighbours")


def check_harmonic(out, ending, others):
    [(_, particles)] = frames(out / "fields" / f"particles_20Hz{ending}")
    [(_, contacts)] = frames(out / "fields" / f"contacts_20Hz{ending}")
    p, c = arrays(particles), arrays(contacts)
    amplitude = np.hypot(p["displacement_real"], p["displacement_imag"])
    check(np.allclose(amplitude, p["displacement_amplitude"], rtol=1e-6, atol=0), "harmonic: amplitude")
    check(0.7e-6 < amplitude.max() < 1.2e-6, f"harmonic: {amplitude.max()} m of 1.1e-6 m")
    tensions = (c["force_real"].astype(float) * c["normal"]).sum(axis=1)
    expected = c["normal_force_amplitude"] * np.cos(np.radians(c["normal_force_phase"]))
    check(np.abs(tensions - expected).max() < 1e-6 * c["normal_force_amplitude"].max(), "harmonic: normal forces")
    check(c["stretch_2_imag"].shape == (len(tensions), 6) and "stretch_3_real" not in c, "harmonic: stretches")
    for name, values in (p | c).items():
        equal(values, others.setdefault(name, values), f"harmonic: {name} of the two formats")


def check_stepped(out, file, others):
    found = frames(out / "fields" / file)
    check([round(time, 9) for time, _ in found] == [round(0.05 * k / 20, 9) for k in range(21)], f"times of {file}")
    norms = [np.abs(arrays(data)["displacement"]).max() for _, data in found]
    check(norms[0] == 0 and 0.7e-6 < max(norms) < 2e-6 and len(set(norms)) == len(norms), f"displacements: {norms}")
    equal(points(found[0][1]), points(found[-1][1]), "stepped: points")
    check(arrays(found[7][1])["radius"].min() > 0, "stepped: constant arrays are in every frame")
    for k, (_, data) in enumerate(found):
        for name, values in arrays(data).items():
            equal(values, others.setdefault((k, name), values), f"stepped: frame {k}, {name} of the two formats")


def main():
    harmonic, stepped = {}, {}
    everything = ("particles", "contacts", "cells")
    for form, ending in (("vtkhdf", ".vtkhdf"), ("vtp", ".vtp")):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write_scene(folder, form, everything)
            run(folder, "specimen", "scene.toml", "--out", "specimen")
            check_specimen(folder / "specimen", ending)
            run(folder, "run", "scene.toml", "--out", "harmonic")
            check_harmonic(folder / "harmonic", ending, harmonic)
            write_scene(folder, form, ("particles",), "explicit", "density_scaling = 1e5\n")
            text = (folder / "scene.toml").read_text(encoding="utf-8").replace("kind =", "cycles = 1\nkind =")
            (folder / "scene.toml").write_text(text, encoding="utf-8")
            run(folder, "run", "scene.toml", "--out", "stepped")
            check_stepped(folder / "stepped", "particles_20Hz" + (".pvd" if form == "vtp" else ".vtkhdf"), stepped)
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()}: {len(faults)} faults")


main()
print("\n".join(faults[:20]))
sys.exit(1 if faults else 0)
