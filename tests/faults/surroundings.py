# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns with unusual folders, disks, streams, languages and names."""
import errno
import os
import resource
import shutil
import signal
import subprocess
import time

from memory_and_files import prepare
from setting import TIMEOUT, Outcome
from verdicts import Result, differences, left_behind


def two_at_once(setting):
    for command in (["specimen", "quick.toml"], ["run", "quick.toml", "--backend", "cpu"]):
        out = setting.clear()
        first = subprocess.Popen([setting.program, *setting.stepped(out)], env=setting.environment, cwd=setting.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (out / "summary.json").exists() and first.poll() is None:
            time.sleep(0.005)
        second = setting.run([*command, "--out", out])
        first.kill()
        first.wait()
        complaints = [] if second.code == 2 and "another command" in second.err else ["the second is not refused"]
        setting.report("two at once", command[0], complaints, second)
        after = setting.run(setting.quick(out))
        setting.report("two at once", "after the first was killed", [] if after.code == 0 else ["is refused"], after)


def full_disks(setting):
    """Runs commands whose result folder is on a small file system in memory, which is mounted only for the command."""
    command = setting.commands()[0]
    mount = ["unshare", "-rm"]
    disk = setting.folder / "disk"
    disk.mkdir(exist_ok=True)
    probe = subprocess.run([*mount, "mount", "-t", "tmpfs", "none", disk], capture_output=True)
    if probe.returncode != 0:
        setting.skipped["full disk"] = "no file system can be mounted here"
        return
    for command in setting.commands():
        prepare(setting, command)
        # bytes in use: the files take whole pages of 4096 bytes, and the folders take 12288 bytes
        held = sum((len(b) + 4095) // 4096 * 4096 for b in setting.older.files.values()) + 12288
        for spare in setting.sample([4096 * (1 << k) // 2 for k in range(1, 12)], 4):
            left = setting.clear("left")
            script = ('mount -t tmpfs -o size="$SIZE" none "$DISK" && cp -r "$OLDER" "$DISK/out" || exit 99\n'
                      '"$@" --out "$DISK/out"; code=$?; cp -r "$DISK/out" "$LEFT"; exit $code')
            extra = {"SIZE": str(held + spare), "DISK": str(disk), "OLDER": str(setting.folder / "older"), "LEFT": str(left)}
            done = subprocess.run([*mount, "sh", "-c", script, "sh", setting.program, *map(str, command.arguments)],
                                  env={**setting.environment, **extra}, cwd=setting.folder, capture_output=True, text=True,
                                  timeout=TIMEOUT)
            outcome = Outcome(done.returncode, done.stdout, done.stderr)
            complaints = [] if outcome.code in (0, 1) else [f"exit code {outcome.code}, expected 0 or 1"]
            if outcome.code == 1 and not (str(disk) in outcome.err and os.strerror(errno.ENOSPC) in outcome.err):
                complaints.append("file or reason not said")
            if left.exists():
                complaints += left_behind(left, setting.older, setting.new, outcome, "write")
            setting.report("full disk", f"{command.name}, {spare} bytes to spare", complaints, outcome)


def folders(setting):
    # a folder without write permission; root could write into it, so another user runs the command
    out = setting.clear()
    out.mkdir()
    (out / "kept.txt").write_text("kept")
    out.chmod(0o555)
    who = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
    for command in setting.commands():
        outcome = setting.run([*command.arguments, "--out", out], **who)
        good = outcome.code == 1 and str(out) in outcome.err and os.strerror(errno.EACCES) in outcome.err
        setting.report("read-only folder", command.name, [] if good else ["is not refused, or not why"], outcome)
    out.chmod(0o755)
    # a folder that is removed while the command runs; the command is held meanwhile, so that it does not end before
    removed = 0
    while removed < (20 if setting.long else 4):
        out = setting.clear()
        child = subprocess.Popen([setting.program, *setting.stepped(out)], env=setting.environment, cwd=setting.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not all((out / name).exists() for name in ("response.csv", "summary.json")) and child.poll() is None:
            time.sleep(0.002)
        time.sleep(setting.random.uniform(0, 0.2))
        child.send_signal(signal.SIGSTOP)
        ended = child.poll() is not None or '"status": "running"' not in (out / "summary.json").read_text()
        if ended:  # or is about to end
            child.kill()
            child.communicate()
            continue
        removed += 1
        shutil.rmtree(out)
        child.send_signal(signal.SIGCONT)
        try:
            _, err = child.communicate(timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            child.kill()
            err = ""
        outcome = Outcome(child.returncode, "", err)
        said = str(out) in err and os.strerror(errno.ENOENT) in err
        setting.report("folder removed", "", [] if outcome.code == 1 and said else ["no exit code 1, or not said why"], outcome)


def streams(setting):
    out = setting.clear("plain")
    setting.run(setting.quick(out))
    expected = Result(out)
    closed = {"standard input closed": [0], "standard output closed": [1], "standard error closed": [2],
              "all closed": [0, 1, 2]}
    for what, numbers in closed.items():
        out = setting.clear()
        child = subprocess.Popen([setting.program, *setting.quick(out)], env=setting.environment, cwd=setting.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 preexec_fn=lambda: [os.close(n) for n in numbers])
        outcome = Outcome(child.wait(TIMEOUT), "", "")
        expect_same(setting, what, outcome, out, expected)
    out = setting.clear()
    child = subprocess.Popen([setting.program, *setting.quick(out)], env=setting.environment, cwd=setting.folder, bufsize=0,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    child.stdout.readline()
    child.stdout.close()
    outcome = Outcome(child.wait(TIMEOUT), "", child.stderr.read().decode())
    expect_same(setting, "a pipe that breaks", outcome, out, expected)

    for solver, arguments in (("quick", setting.quick), ("stepped", setting.stepped)):
        plain = setting.clear("plain_time")
        setting.run(arguments(plain))
        out = setting.clear()
        outcome = setting.run(arguments(out), {"LD_PRELOAD": setting.library, "FAULT_CLOCK": "back"})
        expect_same(setting, f"a clock that goes back, {solver}", outcome, out, Result(plain))
    for threads in (1, 2, 1000):
        out = setting.clear()
        expect_same(setting, f"{threads} threads", setting.run(setting.quick(out, "--threads", threads)), out, expected)
    for size in (256, 128):
        limit = lambda: resource.setrlimit(resource.RLIMIT_STACK, (size * 1024, size * 1024))
        for threads in ("1", "4"):
            out = setting.clear()
            outcome = setting.run(setting.quick(out, "--threads", threads), preexec_fn=limit)
            expect_same(setting, f"a stack of {size} KiB, {threads} threads", outcome, out, expected)
        for command in setting.commands():
            out = setting.clear()
            outcome = setting.run([*command.arguments, "--out", out], preexec_fn=limit)
            setting.report("surroundings", f"a stack of {size} KiB, {command.name}",
                        [] if outcome.code == 0 else ["does not run"], outcome)
    locales(setting, expected)
    paths(setting, expected)


def expect_same(setting, what, outcome, out, expected):
    complaints = [] if outcome.code == 0 else [f"exit code {outcome.code}, expected 0"]
    if outcome.code == 0:
        complaints += differences(Result(out), expected, "a plain run")
    setting.report("surroundings", what, complaints, outcome)


def locales(setting, expected):
    for name in ("tr_TR.UTF-8", "de_DE.UTF-8", "nowhere.UTF-8"):
        place = setting.folder / "locales"
        place.mkdir(exist_ok=True)
        if name != "nowhere.UTF-8" and (not shutil.which("localedef") or subprocess.run(
                ["localedef", "-i", name.split(".")[0], "-f", "UTF-8", place / name], capture_output=True).returncode > 1):
            setting.skipped[f"locale {name}"] = "localedef cannot make it here"
        out = setting.clear()
        outcome = setting.run(setting.quick(out), {"LC_ALL": name, "LOCPATH": str(place), "LANGUAGE": name})
        expect_same(setting, f"locale {name}", outcome, out, expected)


def paths(setting, expected):
    names = {"spaces": "a b  c ", "a newline": "a\nb", "quotes": "a'b\"c", "no UTF-8": os.fsdecode(b"a\xff\xfeb"),
             "a percent sign and braces": "%s{}%n{0}", "a dash": "-out"}
    for what, name in names.items():
        place = setting.folder / name
        place.mkdir()
        shutil.copy(setting.folder / "t8.csv", place)
        shutil.copy(setting.folder / "quick.toml", place)
        outcome = setting.run(["run", place / "quick.toml", "--backend", "cpu", "--out", place / "out"])
        complaints = [] if outcome.code == 0 else [f"exit code {outcome.code}, expected 0"]
        if outcome.code == 0:
            complaints += differences(Result(place / "out"), expected, "a plain run")
        setting.report("surroundings", f"a path with {what}", complaints, outcome)
    for length in (4000, 4060, 4080, 4095, 5000, 100000):
        part = str(setting.folder / "long")
        while len(part) + 2 < length:
            part += "/" + "x" * min(200, length - len(part) - 1)
        setting.clear("long")
        outcome = setting.run(setting.quick(part))
        fits = length + len("/.part/specimen.csv.part") < 4096
        if fits:
            complaints = [] if outcome.code == 0 else [f"exit code {outcome.code}, expected 0"]
        else:
            good = outcome.code in (1, 2) and "name too long" in outcome.err
            complaints = [] if good else ["is not refused, or not why"]
        setting.report("surroundings", f"a path of {length} characters", complaints, Outcome(outcome.code, "", outcome.err[-200:]))
        setting.clear("long")
