# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns with failing calls of NVIDIA's driver (memory, launches, waits, copies), failing kernels, and a lost GPU."""
import ctypes
import re
import shutil
import sys

from verdicts import Result, damaged, differences

KINDS = ("memory", "launch", "together", "graph", "wait", "copy", "other")


def stepped(setting):
    faults(setting, "stepped", ["device.toml", "--method", "explicit"], "two kernels a step")


def tiles(setting):
    """Makes faults in a run on one GPU that steps in tiles. A tile is a block of threads that keeps its part of the
    specimen in registers and shared memory and waits for the other tiles."""
    faults(setting, "tiles", ["tiles.toml", "--method", "explicit", "--precision", "mixed", "--devices", "0"], "cuda, ", "tiles on the chip")


def team(setting):
    """Makes faults in a run on two GPUs whose tiles wait for one another. If one GPU fails, the second must end."""
    faults(setting, "team", ["tiles.toml", "--method", "explicit", "--precision", "mixed", "--devices", "0,1"],
           "cuda devices 0 and 1, ", "tiles on the chip")


def harmonic(setting):
    faults(setting, "harmonic", ["device.toml", "--method", "harmonic", "--linear", "iterative"], "harmonic, ")


def faults(setting, name, arguments, *solver):
    """Makes single calls of the driver fail, makes kernels fail, and makes every call after a certain launch fail. Tests a
    random sample of the faults of each kind.

    `solver` are words that the program must print about its solver. They show that the intended solver runs."""
    library = setting.preloaded("driver_faults", "-Wl,-soname,libcuda.so.1")
    whole = setting.clear("whole")
    outcome = setting.run(command(whole, arguments))
    if outcome.code != 0 or not all(words in outcome.out for words in solver):
        sys.exit(f"{name} does not even run on a GPU, by {' '.join(solver)}: {outcome}")
    expected = Result(whole)
    counts = census(setting, library, arguments)
    print(f"{name}: " + ", ".join(f"{counts[kind]} {kind}" for kind in KINDS), flush=True)
    for kind in KINDS:
        for at in setting.sample(range(1, counts[kind] + 1), 10, long=120 if kind != "memory" else None):
            trial(setting, library, f"{name}, {kind} {at}", arguments, kind, at, expected)
    for kind, dies in (("launch", "dies"), ("together", "dies-together")):
        for at in setting.sample(range(1, counts[kind] + 1), 5, long=40):
            trial(setting, library, f"{name}, {dies} at launch {at}", arguments, dies, at, expected)
    for at in setting.sample(range(1, counts["launch"] + counts["together"] + counts["graph"] + 1), 5, long=40):
        trial(setting, library, f"{name}, lost at launch {at}", arguments, "lost", at, expected)


def driver_file():
    """Returns the path at which the loader finds the driver."""
    try:
        ctypes.CDLL("libcuda.so.1")
    except OSError as error:
        sys.exit(f"no driver: {error}")
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return re.search(r"\S*/libcuda\.so\S*", maps.read())[0]


def command(out, arguments):
    checkpoints = ["--resume"] if (out / "checkpoint.h5").exists() else []
    return ["run", *arguments, "--backend", "cuda", "--out", str(out), *checkpoints]


def preloaded(library, report, kind="", at=0):
    return {"LD_PRELOAD": library, "FAULT_DRIVER": driver_file(), "FAULT_KIND": kind, "FAULT_AT": str(at), "FAULT_REPORT": str(report)}


def census(setting, library, arguments):
    report = setting.folder / "report.txt"
    report.unlink(missing_ok=True)
    outcome = setting.run(command(setting.clear(), arguments), preloaded(library, report))
    lines = [line.split() for line in report.read_text().splitlines()] if report.exists() else []
    counts = {words[1]: int(words[2]) for words in lines if words[0] == "count"}
    if outcome.code != 0 or not counts.get("launch", 0) + counts.get("graph", 0):
        sys.exit(f"no call of the driver was counted: {outcome}, {counts}")
    return counts


def trial(setting, library, what, arguments, kind, at, expected):
    """A run that fails keeps its last checkpoint. The resumed run gives the same bits as an undisturbed one."""
    out, report = setting.clear(), setting.folder / "report.txt"
    report.unlink(missing_ok=True)
    outcome = setting.run(command(out, arguments), preloaded(library, report, kind, at))
    hit = report.read_text().split() if report.exists() else []
    if "hit" not in hit:
        return  # the program makes fewer calls than the census counted
    what += f", {hit[hit.index('hit') + 1]}"
    complaints = []
    if outcome.code == 0:  # the fault had no effect: the call was repeated, or not needed
        complaints += differences(Result(out), expected, "a plain run")
    elif outcome.code != 1 or not ("CUDA" in outcome.err or "memory" in outcome.err or "device" in outcome.err):
        complaints.append(f"exit code {outcome.code}, expected 1 and a word of CUDA, memory or a device")
    else:
        complaints += damaged(out) if out.exists() else []
        again = setting.run(command(out, arguments))
        if again.code != 0:
            complaints.append(f"cannot be run after that: {again.err.strip()}")
        else:
            complaints += differences(Result(out), expected, "a plain run")
    setting.report("driver, " + what.split(",")[0], what, complaints, outcome)
    shutil.rmtree(out, ignore_errors=True)
