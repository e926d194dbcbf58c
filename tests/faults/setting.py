# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes, commands and the list of results, which all campaigns use."""
import collections
import os
import random
import shutil
import subprocess
from pathlib import Path

from verdicts import callers

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SURFACE = ROOT / "examples" / "icosahedron" / "icosahedron.off"
TIMEOUT = 3600  # [s]; the commands take about 0.1 s; only a command that never ends reaches this limit

CONTACTS = """
[materials.aggregate]
density = 2630.0
[materials.mastic]
density = 2110.0
[[contacts]]
pair = "M-M"
law = "generalised_kelvin"
E_m = 1.115e10
C_m = 2.515e9
E = [3.799e8, 1.600e9, 4.308e10]
C = [8.950e9, 5.695e9, 1.114e9]
alpha = 0.10
[[contacts]]
pair = "M-A"
law = "generalised_kelvin"
E_m = 3.511e10
C_m = 7.921e9
E = [1.197e9, 5.039e9, 1.357e11]
C = [2.819e10, 1.794e10, 3.510e9]
alpha = 0.10
[[contacts]]
pair = "A-A"
law = "elastic"
E = 1.151e11
alpha = 0.05
[[contacts]]
pair = "A-W"
law = "elastic"
E = 1.151e11
alpha = 0.0
[[contacts]]
pair = "M-W"
law = "elastic"
E = 3.511e10
alpha = 0.0
"""


def scene(specimen, solver="density_scaling = 1e6", output=""):
    """Returns a scene of one cycle at 20 Hz. The cycle takes 500 steps with a density scaling of 1e6. The number of
    steps is proportional to 1 / sqrt(density_scaling)."""
    return (f'[specimen]\nfile = "{specimen}"\nbox = [0.008, 0.008, 0.011]\n[loading]\nkind = "cyclic"\n'
            f"frequencies = [20.0]\ncycles = 1\n[solver]\n{solver}\n[output]\n{output}\n{CONTACTS}")


# HDF5 1.10 crashes, or ends the program without a message, if one of its own allocations fails. The program therefore
# checks that memory is available before it calls HDF5, and here HDF5's own allocations do not fail. In the campaign "little
# memory" all allocations can fail.
SPARED = {"FAULT_SPARE": "libhdf5_serial.so"}

Outcome = collections.namedtuple("Outcome", "code out err")
# older: arguments of the command that makes the older result
Command = collections.namedtuple("Command", "name arguments older")


class Setting:
    def __init__(self, arguments, folder):
        self.program = str(Path(arguments.program).resolve())
        self.backend, self.kills = arguments.backend, arguments.kills
        self.long, self.every, self.folder = arguments.long, arguments.every, folder
        self.random = random.Random(arguments.seed)
        self.trials = collections.Counter()
        self.failed = collections.Counter()
        self.alike = collections.Counter()
        self.skipped = {}
        self.rows = []
        self.built = Path(arguments.libraries or folder)
        self.library = self.preloaded("faults")
        # one thread, so that the allocations have the same order every time
        self.environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "LC_ALL": "C"}
        particles = (ROOT / "tests" / "data" / "t8.csv").read_text()
        (folder / "t8.csv").write_text(particles)
        number, x, rest = particles.splitlines()[-1].split(",", 2)
        (folder / "other.csv").write_text(particles[:particles.rindex(f"{number},{x}")] + f"{number},{x[:-4]},{rest}\n")
        everything = 'contacts = true\ncheckpoint = "1 ms"\nfields = ["particles", "cells"]\nevery = 50\n'
        scenes = {"quick": scene("t8.csv"), "older": scene("other.csv", output=everything),
                  "full": scene("t8.csv", output=everything + 'format = "vtp"'),
                  "hdf5": scene("t8.csv", output=everything),
                  "device": scene("t8.csv", "density_scaling = 1e4", "checkpoint = 0.02"),
                  # short steps, so they are taken in blocks, after which the states of the laws are updated
                  "tiles": scene("t8.csv", "density_scaling = 1e2", "checkpoint = 0.02"),
                  "stepped": scene("t8.csv", f"density_scaling = {self.scaling()}", "checkpoint = 0.05")}
        for name, text in scenes.items():
            (folder / f"{name}.toml").write_text(text)

    def preloaded(self, name, *options):
        """Returns the path of a library to be preloaded. Compiles it from the source in this folder if it does not exist."""
        out = self.built / f"{name}.so"
        if not out.exists():
            subprocess.run(["cc", "-shared", "-fPIC", "-O1", *options, "-o", out, HERE / f"{name}.c", "-ldl"], check=True)
        return str(out.resolve())

    def report(self, campaign, what, complaints, outcome=None, trace=None, trials=1):
        self.trials[campaign] += trials
        where = callers(trace) if complaints and trace else ""
        self.rows.append([campaign, what, "; ".join(complaints) or "good",
                          "" if outcome is None else outcome.code, "" if outcome is None else outcome.err.strip(), where])
        if complaints:
            self.failed[campaign] += 1
            alike = (campaign, what.split(",")[0], *complaints, where.split(" < ")[0])
            self.alike[alike] += 1
            if self.alike[alike] <= 2:  # the file that --out names contains all complaints
                said = f" | code {outcome.code}: {outcome.err.strip()[-300:]!r}" if outcome else ""
                print(f"FAILED {campaign}: {what}: {'; '.join(complaints)}{said}{where and ' | in ' + where}", flush=True)

    def run(self, arguments, environment=None, timeout=TIMEOUT, **more):
        try:
            done = subprocess.run([self.program, *map(str, arguments)], env={**self.environment, **(environment or {})},
                                  stdin=subprocess.DEVNULL, capture_output=True, timeout=timeout, cwd=self.folder,
                                  errors="replace", **more)
            return Outcome(done.returncode, done.stdout, done.stderr)
        except subprocess.TimeoutExpired:
            return Outcome("hangs", "", "")

    def clear(self, name="out"):
        shutil.rmtree(self.folder / name, ignore_errors=True)
        return self.folder / name

    def scaling(self):
        """Returns a density scaling for which a stepped run takes about a second, with 35,000 to 500,000 steps."""
        return 1 if self.backend == "cuda" else 20 if self.long else 200

    def stepped(self, out, *more):
        threads = ["--threads", "1"] if self.backend == "cpu" else []
        return ["run", "stepped.toml", "--backend", self.backend, *threads, "--out", str(out), *more]

    def quick(self, out, *more):
        return ["run", "quick.toml", "--backend", "cpu", "--out", str(out), *more]

    def commands(self):
        one = ["--threads", "1"]
        older = ["run", "older.toml", "--backend", "cpu", *one]
        return [Command("run", ["run", "full.toml", "--backend", "cpu", *one], older),
                Command("run with HDF5", ["run", "hdf5.toml", "--backend", "cpu", *one], older),
                Command("run harmonic", ["run", "full.toml", "--method", "harmonic", "--backend", "cpu", *one], older),
                Command("specimen", ["specimen", "full.toml", "--section", "x=0.004"], ["specimen", "older.toml"]),
                Command("shapes measure", ["shapes", "measure", SURFACE], ["shapes", "measure", SURFACE, "--scale", "2"]),
                Command("shapes fill", ["shapes", "fill", SURFACE, "--radius", "0.001"],
                        ["shapes", "fill", SURFACE, "--radius", "0.0015"]),
                Command("shapes generate", ["shapes", "generate", "--count", "1"],
                        ["shapes", "generate", "--count", "1", "--seed", "2"])]

    def sample(self, numbers, quick, long=None):
        """Returns a random sample of `quick` numbers, or in a long campaign of `long` numbers (None: all)."""
        number = long if self.long else quick
        return sorted(numbers if number is None or len(numbers) <= number else self.random.sample(list(numbers), number))
