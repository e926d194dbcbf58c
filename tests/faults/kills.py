# SPDX-License-Identifier: GPL-3.0-or-later
"""Campaigns with kills at random moments, and with damaged checkpoints."""
import shutil
import signal
import subprocess
import sys
import time

from setting import TIMEOUT
from verdicts import Result, damaged, differences


def kills(setting):
    """A run that is killed at random moments, and resumed until it finishes, gives the same bits."""
    whole = setting.clear("whole")
    start = time.monotonic()
    outcome = setting.run(setting.stepped(whole))
    alone = time.monotonic() - start
    if outcome.code != 0:
        sys.exit(f"the stepped run does not even run: {outcome}")
    expected = Result(whole)
    all_killed, most = 0, setting.kills or (1000 if setting.long else 20)
    while all_killed < most:
        out, killed, complaints = setting.clear(), 0, []
        for _ in range(300):
            more = ["--resume"] if (out / "checkpoint.h5").exists() else []  # the newest checkpoint is complete at every moment
            child = subprocess.Popen([setting.program, *setting.stepped(out, *more)], env=setting.environment, cwd=setting.folder,
                                     stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            # the time until a kill grows with each kill, so that the run ends even if other processes use the processor
            longest = 0.6 * max(0.3, alone) * (1 + killed / 20)
            try:
                _, err = child.communicate(timeout=setting.random.uniform(0.01, longest))
            except subprocess.TimeoutExpired:
                child.kill()
                child.communicate()
                killed += 1
                all_killed += 1
                complaints += damaged(out, killed=True)
                continue
            if child.returncode != 0:
                complaints.append(f"exit code {child.returncode}: {err.strip()}")
            break
        else:
            complaints.append("never done")
        complaints += differences(Result(out), expected, "an uninterrupted run")
        complaints += [f"{p.name} is left" for p in out.glob("*.part")]
        setting.report(f"kill and resume, {setting.backend}", f"killed {killed} times", complaints, trials=killed)


def checkpoints(setting):
    """A checkpoint that is cut or has a flipped bit is refused, and nothing in its folder changes. If the previous
    checkpoint exists, the run reports the damage and continues from the previous one, to the same bits."""
    whole = setting.clear("whole")
    setting.run(setting.stepped(whole))
    expected, out = Result(whole), interrupted(setting)
    found = Result(out).files
    previous, good = found.pop("checkpoint-previous.h5"), found.pop("checkpoint.h5")
    for k, (what, bytes_) in enumerate(damages(setting, good)):
        for with_previous in (False, True) if k % 8 == 0 else (False,):
            put_back(out, {**found, "checkpoint.h5": bytes_, **({"checkpoint-previous.h5": previous} if with_previous else {})})
            outcome = setting.run(setting.stepped(out, "--resume"))
            if with_previous:
                setting.report("damaged, previous one intact", what, gone_on(outcome, out, expected), outcome)
            else:
                setting.report("damaged checkpoints", what, refused(outcome, out, {**found, "checkpoint.h5": bytes_}), outcome)
    put_back(out, {**found, "checkpoint.h5": good})
    outcome = setting.run(setting.stepped(out, "--resume"))
    setting.report("damaged checkpoints", "the good one", [] if outcome.code == 0 else ["is refused"], outcome)


def interrupted(setting):
    """Returns the folder of a run that was interrupted after it had written two checkpoints."""
    end = time.monotonic() + TIMEOUT
    while time.monotonic() < end:  # on a busy machine the run may finish before its checkpoint is noticed
        out = setting.clear()
        child = subprocess.Popen([setting.program, *setting.stepped(out)], env=setting.environment, cwd=setting.folder,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (out / "checkpoint.h5").exists() and child.poll() is None and time.monotonic() < end:
            time.sleep(0.005)
        child.send_signal(signal.SIGTERM)  # SIGINT is ignored if a shell runs this in the background
        child.wait()
        if (out / "checkpoint-previous.h5").exists():
            return out
    sys.exit("a stepped run could not be interrupted behind its second checkpoint")


def damages(setting, good):
    flips = [(setting.random.randrange(512 if k % 10 == 0 else len(good)), setting.random.randrange(8))
             for k in range(1000 if setting.long else 100)]
    cuts = sorted(setting.random.sample(range(len(good)), 200 if setting.long else 40))
    yield from ((f"bit {bit} of byte {at}", good[:at] + bytes([good[at] ^ 1 << bit]) + good[at + 1:]) for at, bit in flips)
    yield from ((f"cut to {n} of {len(good)} bytes", good[:n]) for n in cuts)


def put_back(out, files):
    shutil.rmtree(out)
    for name, bytes_ in files.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_bytes(bytes_)


def refused(outcome, out, files):
    complaints = [] if outcome.code == 2 else [f"exit code {outcome.code}, expected 2"]
    if str(out / "checkpoint.h5") not in outcome.err or "expected" not in outcome.err:
        complaints.append("the message names no checkpoint, or not what is wrong")
    return complaints + ([] if Result(out).files == files else ["the folder has changed"])


def gone_on(outcome, out, expected):
    complaints = [] if outcome.code == 0 else [f"exit code {outcome.code}, expected 0"]
    if "from the previous checkpoint" not in outcome.err:
        complaints.append("no word of the damage")
    found = Result(out)
    if isinstance(found.summary, dict):
        found.summary["warnings"] = expected.summary["warnings"]
    return complaints + differences(found, expected, "an uninterrupted run")
