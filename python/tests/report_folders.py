# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes result folders for the tests of reports and studies, with the program, when a test first needs them."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def _program() -> str | None:
    for candidate in (
        os.environ.get("MACADAM_PROGRAM"),
        ROOT / "build/local/macadam",
        ROOT / "build/cpu-release/macadam",
    ):
        if candidate and Path(candidate).is_file():
            return str(Path(candidate).resolve())
    return shutil.which("macadam")


PROGRAM = _program()
# environment of the commands that tests start: they use the package of this source tree, and one thread each
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": os.pathsep.join(filter(None, [str(ROOT / "python"), os.environ.get("PYTHONPATH")])),
    "OMP_NUM_THREADS": "1",
    "MACADAM_PYTHON": sys.executable,
}



def command(line: str) -> list[str]:
    """Returns the arguments of a process that runs a command `macadam report …` of the documents. The program passes
    the command on to this Python interpreter."""
    words = shlex.split(line)
    assert words[0] == "macadam"
    return [str(PROGRAM), *words[1:]]


LAWS = """
[[contacts]]
pair = "M-M"
law = "generalised_kelvin"
E_m = 1.115e10
C_m = 2.515e9
E = [3.799e8]
C = [8.950e9]
alpha = 0.1
{shift}
[[contacts]]
pair = "M-A"
law = "generalised_kelvin"
E_m = 3.511e10
C_m = 7.921e9
E = [1.197e9]
C = [2.819e10]
alpha = 0.1
{shift}
[[contacts]]
pair = "A-A"
law = "elastic"
E = 1.151e11
[[contacts]]
pair = "A-W"
law = "elastic"
E = 1.151e11
[[contacts]]
pair = "M-W"
law = "elastic"
E = 3.511e10
"""
SHIFT = 'shift = "wlf"\nC1 = 15\nC2 = 122\nreference_temperature = 20'
MIX = """
[specimen]
box = [0.012, 0.012, 0.014]
seed = {seed}
{aggregate}
[specimen.mastic]
radius = ["0.75 mm", "1 mm"]
{porosity}
{voids}
[materials.aggregate]
density = 2630
[materials.mastic]
density = 2110
"""
AGGREGATE = """[[specimen.aggregate]]
sieve = ["2 mm", "4.75 mm"]
volume_fraction = 0.35"""
RECIPE = """
[specimen]
box = [0.012, 0.012, 0.014]
[specimen.recipe]
gradation = [["4.75 mm", "100 %"], ["2 mm", "60 %"], ["0.5 mm", "25 %"], ["0.075 mm", "8 %"]]
binder = "6 %"
binder_of = "mix"
aggregate_density = 2630
binder_density = 1030
air_voids = "4 %"
envelope = [["4.75 mm", "95 %", "100 %"], ["2 mm", "62 %", "75 %"]]
[specimen.mastic]
radius = ["0.75 mm", "1 mm"]
"""
FILE = """
[specimen]
file = "{data}/t8.csv"
box = [0.008, 0.008, 0.011]
[materials.aggregate]
density = 2630
[materials.mastic]
density = 2110
"""
HARMONIC = '[solver]\nmethod = "harmonic"\n'
STEPPED = '[solver]\nmethod = "explicit"\ndensity_scaling = 100\n'
CYCLIC = '[loading]\nkind = "cyclic"\nfrequencies = [2, 5, 20]\n'
TESTS = {
    "stepped": CYCLIC + "[solver]\ntolerance = 1e-2\n",
    "harmonic": CYCLIC + HARMONIC + "[output]\nsensitivities = true\ncontacts = true\n",
    "temperatures": '[loading]\nkind = "sweep"\nfrequencies = [0.1, 1, 10]\ntemperatures = [0, 20, 40]\n' + HARMONIC,
    "relaxation": '[loading]\nkind = "relaxation"\ntimes = [0.01, 10]\npoints_per_decade = 3\n' + HARMONIC,
    "creep": '[loading]\nkind = "creep"\nstress = 1e5\nrelease = 1\ntimes = [0.01, 10]\npoints_per_decade = 3\n'
    + HARMONIC,
    "monotonic": '[loading]\nkind = "monotonic"\nrate = -1e-5\ntimes = [0.1, 10]\npoints_per_decade = 3\n' + HARMONIC,
    "stepped_relaxation": '[loading]\nkind = "relaxation"\nstrain = 1e-4\ntimes = ["1 ms", "4 ms"]\npoints = 7\n' + STEPPED,
    "stepped_creep": '[loading]\nkind = "creep"\nstress = 1e5\nrelease = "3 ms"\ntimes = ["1 ms", "6 ms"]\npoints = 11\n'
    + STEPPED,
    "stepped_monotonic": '[loading]\nkind = "monotonic"\nrate = -1e-2\ntimes = ["1 ms", "4 ms"]\npoints = 7\n' + STEPPED,
    "confined": "[network]\nlateral_walls = true\n" + CYCLIC + HARMONIC,
    "voids": CYCLIC + HARMONIC,
    "fields": CYCLIC + HARMONIC + '[output]\nfields = ["particles", "contacts"]\n',
    "file": CYCLIC + HARMONIC,
}


BROKEN = (
    '[specimen]\nfile = "{data}/t8.csv"\nbox = [0.008, 0.008, 0.011]\n[materials.aggregate]\ndensity = 2630.0\n'
    "[materials.mastic]\ndensity = 2110.0\n"
    + "".join(
        f'[[contacts]]\npair = "{pair}"\nlaw = "brittle_bond"\nE = 1e10\nalpha = 0.1\ntensile_strength = 3e6\nshear_strength = 8e5\n'
        for pair in ("M-M", "M-A", "A-A")
    )
    + "".join(f'[[contacts]]\npair = "{pair}"\nlaw = "elastic"\nE = 1e10\nalpha = 0.1\n' for pair in ("A-W", "M-W"))
    + '[loading]\nkind = "monotonic"\nrate = 0.1\nstrain = 2e-3\npoints = 40\n'
    + '[solver]\nmethod = "explicit"\nbackend = "cpu"\ndensity_scaling = 1e4\n'
)


# the same specimen with cohesive cracks
CRACKED = (
    BROKEN.replace('law = "brittle_bond"', 'law = "elastic"')
    .replace("tensile_strength = 3e6\nshear_strength = 8e5\n",
             "crack = { tensile_strength = 1e6, fracture_energy = 10, shear_strength = 1.5e6, friction = 0.5 }\n")
    .replace("rate = 0.1\nstrain = 2e-3", "rate = 1.0\nstrain = 4e-3")
    .replace("density_scaling = 1e4", "density_scaling = 100")
)  # fmt: skip


def scene(kind: str, seed: int = 1) -> str:
    """Returns the text of a small scene of this kind."""
    if kind in ("broken", "cracked"):
        text = BROKEN if kind == "broken" else CRACKED
        return text.replace("{data}", str(ROOT / "tests/data"))
    laws = LAWS.format(shift=SHIFT if kind == "temperatures" else "")
    if kind == "file":
        return FILE.format(data=ROOT / "tests/data") + laws + TESTS[kind]
    voids = '[specimen.voids]\nradius = ["0.6 mm", "0.8 mm"]\nfraction = "4 %"\n' if kind == "voids" else ""
    return MIX.format(seed=seed, aggregate=AGGREGATE, porosity="porosity = 0.05", voids=voids) + laws + TESTS[kind]


def run(*arguments: str | Path) -> None:
    """Runs the program with these arguments and asserts that it succeeds."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=ENVIRONMENT)
    assert done.returncode == 0, done.stderr


# shared by all test modules; removed at the end of the process
_kept = tempfile.TemporaryDirectory(prefix="macadam-results-")


def make(kind: str, seed: int = 1) -> Path:
    """Returns the result folder of this kind; makes it if it does not exist yet."""
    folder = Path(_kept.name)
    out = folder / (kind if seed == 1 else f"{kind}-{seed}")
    if out.exists():
        return out
    if kind == "recipe":
        (folder / "recipe.toml").write_text(RECIPE + LAWS.format(shift="") + CYCLIC, encoding="utf-8")
        run("specimen", folder / "recipe.toml", "--out", out, "--section", "x=0.006")
    elif kind == "calibration":
        make("harmonic")
        (folder / "lab.csv").write_text("frequency_hz,e_star_pa,phase_deg\n2,9e9,26\n20,1.2e10,6.6\n", encoding="utf-8")
        run(
            "calibrate",
            folder / "harmonic.toml",
            "--target",
            folder / "lab.csv",
            "--free",
            "M-A.delta",
            "--nearest",
            "--out",
            out,
            "--bounds",
            "M-A.delta=0.1:10",
            "--no-pictures",
        )
    elif kind == "fit":
        run(
            "fit",
            ROOT / "examples/laws/mastic.csv",
            "--shift",
            "wlf",
            "--reference-temperature",
            "15",
            "--units",
            "6",
            "--out",
            out,
            "--no-pictures",
        )
    elif kind == "shapes":
        run("shapes", "measure", ROOT / "examples/shapes", "--out", out)
    else:
        file = folder / f"{kind}.toml"  # all seeds share one scene file
        if not file.exists():
            file.write_text(scene(kind), encoding="utf-8")
        run("run", file, "--out", out, *([] if seed == 1 else ["--seed", str(seed)]))
    return out
