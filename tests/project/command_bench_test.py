# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests bench/command: phases that do not add up to the wall time are refused, and a run of the program gives all rows.

usage: command_bench_test.py REPOSITORY PROGRAM; exit code 1 if something is wrong."""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "bench" / "command"))
from phases import PHASES, TIMED, collected, phases_of  # noqa: E402

WALL = 20.0  # [s]; a twentieth may be missing in the sum of the phases


def summary(status="done", solve=17.0, **changed):
    """Returns a summary whose phases last 2 s each; None removes a phase."""
    timing = {**{phase: 2.0 for phase in TIMED}, "solve": solve, **changed}
    return {"status": status, "timing_s": {name: s for name, s in timing.items() if s is not None}}


# summary, wall time, expected message (None for a valid summary); processor time if it is known
CASES = [
    (summary(), 2.0 * len(TIMED), None),
    (summary(), 2.0 * len(TIMED) + 0.9, None),
    (summary(**{phase: 0.01 for phase in TIMED}), 0.35, None),
    (summary(), 2.0 * len(TIMED) + 1.1, "sum up to 20.000 s of 21.100 s"),
    (summary(**{phase: 0.01 for phase in TIMED}), 0.45, "sum up to 0.100 s of 0.450 s"),
    (summary(), 2.0 * len(TIMED) - 0.1, "sum up to 20.000 s of 19.900 s"),
    (summary(stepping=0.0), WALL, "sum up to 18.000 s"),
    (summary(harmonic=4.0), WALL, "sum up to 22.000 s"),
    (summary(harmonic=-2.0, stepping=6.0), WALL, "harmonic: -2.0 s"),
    (summary(stepper=float("nan")), WALL, "stepper: nan s"),
    (summary(writing=None), WALL, "timing_s has no writing"),
    (summary(status="interrupted"), WALL, "status 'interrupted'"),
    (summary(), 2.0 * len(TIMED) + 1.1, None, 18.0),  # the process waited 3.1 s for a core
    (summary(), 2.0 * len(TIMED) + 1.1, "sum up to 20.000 s of 21.100 s", 21.1),
    (summary(harmonic=4.0), WALL, "sum up to 22.000 s", 18.0),  # a phase that is counted twice must be found too
]


def of_phases():
    wrong = []
    for made, wall, expected, *processor in CASES:
        try:
            phases = phases_of(made, wall, *processor)
        except ValueError as error:
            if expected is None or expected not in str(error):
                wrong.append(f"expected {expected or 'nothing refused'}: {error}")
            continue
        if expected is not None:
            wrong.append(f"nothing was refused for '{expected}'")
        elif list(phases) != PHASES or abs(sum(phases.values()) - wall) > 1e-9:
            wrong.append(f"phases that do not make up {wall} s: {phases}")
    runs = [{phase: seconds for phase in PHASES} for seconds in (3.0, 1.0, 2.5)]
    expected = [*((phase, 2.5, 1.0, 3.0) for phase in PHASES), ("wall", *(len(PHASES) * s for s in (2.5, 1.0, 3.0)))]
    if collected(runs) != expected:
        wrong.append(f"median, least and largest: {collected(runs)}")
    return wrong


def of_program():
    """Runs the whole script, with a specimen that is generated and with one that is read from a file."""
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "command.csv"
        done = subprocess.run([sys.executable, ROOT / "bench" / "command" / "run", "--program", PROGRAM, "--out", out,
                               "--runs", "2", "--threads", "1", "demo:harmonic", "demo:harmonic:read"],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return [f"bench/command/run: exit code {done.returncode}\n{done.stdout}{done.stderr}"]
        with open(out, encoding="utf-8") as f:
            rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    for specimen in ("generated", "read"):
        found = {row["phase"]: row for row in rows if row["specimen"] == specimen}
        if list(found) != [*PHASES, "wall"]:
            wrong.append(f"{specimen}: phases {list(found)}")
            continue
        for phase, row in found.items():
            least, middle, most = (float(row[key]) for key in ("min", "seconds", "max"))
            if not least <= middle <= most or (row["runs"], row["threads"], row["particles"]) != ("2", "1", "2391"):
                wrong.append(f"{specimen}, {phase}: {row}")
        if not float(found["harmonic"]["min"]) > 0:
            wrong.append(f"{specimen}: no time in harmonic solutions: {found['harmonic']}")
    return wrong


if __name__ == "__main__":
    faults = of_phases() + of_program()
    print("\n".join(faults))
    sys.exit(1 if faults else 0)
