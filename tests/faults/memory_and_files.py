# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns with failing allocations, and failing calls on files."""
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
    """Counts the calls of each kind that a command makes. With `stacks` also returns a hash of the call stack of each
    allocation."""
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
    """Makes the older result and the new result of a command."""
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
        return  # the program makes fewer calls than the census counted
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
        # If HDF5 1.10 could not close a file, it crashes at the end of the program, after all results and messages were
        # written.
        crashes = outcome.code == -signal.SIGSEGV and "H5Fclose failed" in outcome.err
        if outcome.code not in (0, 1) and not crashes:
            complaints.append(f"exit code {outcome.code}, expected 1")
        # Some faults do no harm, so no message is needed. After a short write the program writes the remaining bytes. A
        # command may succeed although a file was not removed. HDF5 first tries to open a file that does not exist, and
        # then creates it.
        elif not said and not (outcome.code == 0 and (kind in ("short", "remove") or (kind == "open" and "HDF5" in what))):
            complaints.append("file or reason not said")
    complaints += left_behind(out, setting.older, setting.new, outcome, kind)
    setting.report(campaign, what, complaints, outcome, trace)


def memory(setting):
    """Makes one allocation of each call stack fail (in a quick campaign some of them), or with --every each allocation.
    In addition runs each command with little memory."""
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
    """Makes allocations fail that the program makes before any command, while it reads its arguments. They are the same for
    all commands."""
    for at in range(1, count + 1) if setting.every else setting.sample(ways, 40):
        outcome = setting.run(["--version"], {"LD_PRELOAD": setting.library, "FAULT_KIND": "memory", "FAULT_AT": str(at),
                                           "FAULT_TRACE": str(setting.folder / "trace.txt")})
        complaints = []
        if outcome.code not in (0, 1) or (outcome.code == 1 and "memory" not in outcome.err):
            complaints.append(f"exit code {outcome.code}, expected 1 and a word of memory")
        setting.report("memory", f"start, memory {at}", complaints, outcome, setting.folder / "trace.txt")


def files(setting):
    """Makes every write, fsync, rename, close, removal, new folder and opening for writing fail once (in a quick campaign
    six of each kind)."""
    for command in setting.commands():
        prepare(setting, command)
        _, counts, _ = census(setting, command)
        for kind in ("open", "write", "short", "sync", "rename", "close", "remove", "mkdir"):
            for at in setting.sample(range(1, counts[kind] + 1), 6):
                number = errno.EIO if (setting.random.random() < 0.5 or kind == "close") else errno.ENOSPC
                trial(setting, "files", command, kind, at, number)
