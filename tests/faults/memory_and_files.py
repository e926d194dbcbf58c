# SPDX-License-Identifier: GPL-3.0-or-later
"""Allocations and calls on files that fail."""
import array
import ctypes
import errno
import os
import shutil
import signal
import sys

from setting import SPARED, Command
from verdicts import Result, left_behind


def census(setting, command, stacks=False):
    """How many calls of each kind a command makes, and, for each allocation, a number for the functions that it is in."""
    out = setting.clear()
    shutil.copytree(setting.folder / "older", out)
    report, hashes = setting.folder / "report.txt", setting.folder / "stacks.bin"
    report.unlink(missing_ok=True)
    extra = {"LD_PRELOAD": setting.library, "FAULT_REPORT": str(report), "FAULT_FOLDER": str(out), **SPARED}
    if stacks:
        extra["FAULT_STACKS"] = str(hashes)
    no_random_addresses = lambda: ctypes.CDLL(None).personality(0x0040000)
    outcome = setting.run([*command.arguments, *(["--out", out] if command.arguments[0] != "--version" else [])], extra,
                       preexec_fn=no_random_addresses)
    counts = {line.split()[1]: int(line.split()[2]) for line in report.read_text().splitlines()}
    at = array.array("Q")
    if stacks:
        at.frombytes(hashes.read_bytes())
    return outcome, counts, at


def prepare(setting, command):
    """The older result and the new one of a command."""
    for name, arguments in (("older", command.older), ("new", command.arguments)):
        out = setting.clear(name)
        if arguments[0] == "run" or name == "older":
            outcome = setting.run([*arguments, "--out", out])
        else:
            shutil.copytree(setting.folder / "older", out)
            outcome = setting.run([*arguments, "--out", out])
        if outcome.code != 0:
            sys.exit(f"{command.name} does not even run: {outcome}")
    setting.older, setting.new = Result(setting.folder / "older"), Result(setting.folder / "new")


def trial(setting, campaign, command, kind, at, number=errno.EIO, limit=0):
    out, report, trace = setting.clear(), setting.folder / "report.txt", setting.folder / "trace.txt"
    shutil.copytree(setting.folder / "older", out)
    report.unlink(missing_ok=True)
    outcome = setting.run([*command.arguments, "--out", out],
                       {"LD_PRELOAD": setting.library, "FAULT_KIND": kind, "FAULT_AT": str(at), "FAULT_BYTES": str(limit), **({} if limit else SPARED),
                        "FAULT_ERRNO": str(number), "FAULT_FOLDER": str(out), "FAULT_REPORT": str(report), "FAULT_TRACE": str(trace)})
    if "hit" not in (report.read_text() if report.exists() else ""):
        return  # fewer calls than before
    what = f"{command.name}, {f'{limit} bytes' if limit else f'{kind} {at}'}"
    complaints = []
    if kind == "memory":
        if outcome.code not in (0, 1):
            complaints.append(f"exit code {outcome.code}, expected 1")
        if outcome.code == 1 and "memory" not in outcome.err:
            complaints.append("no word of memory")
    else:
        what += f", {errno.errorcode[number]}"
        said = os.strerror(number) in outcome.err and str(out) in outcome.err
        # HDF5 1.10 crashes at the end of a program in which it could not close a file, after all is said and done
        crashes = outcome.code == -signal.SIGSEGV and "H5Fclose failed" in outcome.err
        if outcome.code not in (0, 1) and not crashes:
            complaints.append(f"exit code {outcome.code}, expected 1")
        # what is absorbed: the rest is written, HDF5 tries to open a file before it makes it
        elif not said and not (outcome.code == 0 and (kind in ("short", "remove") or (kind == "open" and "HDF5" in what))):
            complaints.append("file or reason not said")
    complaints += left_behind(out, setting.older, setting.new, outcome, kind)
    setting.report(campaign, what, complaints, outcome, trace)


def memory(setting):
    """Every allocation fails once: one for each way through the program that asks for memory, or all of them."""
    start = None
    for command in [Command("start", ["--version"], None), *setting.commands()]:
        if command.older is None:
            setting.clear("older").mkdir()
            setting.older = setting.new = Result(setting.folder / "older")
        else:
            prepare(setting, command)
        _, counts, stacks = census(setting, command, stacks=True)
        first = {}
        for k, stack in enumerate(stacks):
            first.setdefault(stack, k + 1)
        if start is None:
            start = set(first)
            starting(setting, list(first.values()), counts["memory"])
            continue
        ways = [k for stack, k in first.items() if stack not in start]
        numbers = range(1, counts["memory"] + 1) if setting.every else setting.sample(ways, 36)
        for at in numbers:
            trial(setting, "memory", command, "memory", at)
        for _ in range(60 if setting.long else 6):
            trial(setting, "little memory", command, "memory", 0, limit=setting.random.randrange(counts["start"], counts["most"]))


def starting(setting, ways, count):
    """What comes before any command is the same for all: making the command line."""
    for at in range(1, count + 1) if setting.every else setting.sample(ways, 40):
        outcome = setting.run(["--version"], {"LD_PRELOAD": setting.library, "FAULT_KIND": "memory", "FAULT_AT": str(at),
                                           "FAULT_TRACE": str(setting.folder / "trace.txt")})
        complaints = []
        if outcome.code not in (0, 1) or (outcome.code == 1 and "memory" not in outcome.err):
            complaints.append(f"exit code {outcome.code}, expected 1 and a word of memory")
        setting.report("memory", f"start, memory {at}", complaints, outcome, setting.folder / "trace.txt")


def files(setting):
    """Every write, fsync, rename, close, removal and opening for writing fails once."""
    for command in setting.commands():
        prepare(setting, command)
        _, counts, _ = census(setting, command)
        for kind in ("open", "write", "short", "sync", "rename", "close", "remove", "mkdir"):
            for at in setting.sample(range(1, counts[kind] + 1), 6):
                number = errno.EIO if (setting.random.random() < 0.5 or kind == "close") else errno.ENOSPC
                trial(setting, "files", command, kind, at, number)
