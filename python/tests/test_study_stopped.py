# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies that Ctrl-C or SIGTERM stops: they end, leave no process, and write table and report of what is done."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pandas as pd
import pytest

from macadam.study import parsl_pool, programs
from report_folders import ENVIRONMENT
from study_faults import lines, scene, stand_in

psutil = pytest.importorskip("psutil")
pytest.importorskip("parsl")

LONG = 300  # s after which a test fails; nothing is expected to take that long
STUDY = """
scene = "scene.toml"
[grid]
"contacts.M-A.delta" = [1.0, 2.0, 3.0]
[run]
workers = 2
"""


class Running:
    """A study of which one point is done and two never are, in a session of its own."""

    def __init__(self, folder: Path, place: str) -> None:
        self.folder, self.out, self.go = folder, folder / "out", folder / "go"
        program, self.log = stand_in(folder, go=self.go)
        scene(folder)
        (folder / "study.toml").write_text(STUDY)
        self.line = [sys.executable, "-m", "macadam", "study", "study.toml", "--out", str(self.out), "--on", place]
        self.how = {"cwd": folder, "env": {**ENVIRONMENT, "MACADAM_PROGRAM": program}, "text": True}
        self.process = subprocess.Popen(self.line, stderr=subprocess.PIPE, start_new_session=True, **self.how)

    def wait_for_work(self) -> None:
        """Returns when the first point is done and two programs run that never end."""
        while len(list((self.out / "results").glob("*"))) < 1 or len(lines(self.log, "begin")) < 3:
            assert self.process.poll() is None, self.process.stderr.read()
            time.sleep(0.01)

    def left(self) -> set[psutil.Process]:
        """The processes that this study started, by the names in their command lines, and their children."""
        found = set()
        for process in psutil.process_iter():
            try:
                if process.pid != self.process.pid and str(self.folder) in " ".join(process.cmdline()):
                    found |= {process, *process.children(recursive=True)}
            except psutil.Error:
                continue
        return found | set(psutil.Process(self.process.pid).children(recursive=True) if self.alive() else ())

    def alive(self) -> bool:
        return self.process.poll() is None

    def kill(self) -> None:
        for process in self.left():
            try:
                process.kill()
            except psutil.Error:
                continue
        if self.alive():
            self.process.kill()
        self.process.wait()


@pytest.fixture(params=["local", "threads"])
def running(request: pytest.FixtureRequest, tmp_path: Path):
    study = Running(tmp_path, request.param)
    try:
        study.wait_for_work()
        yield study
    finally:
        study.kill()


@pytest.mark.parametrize("to_group", [False, True], ids=["process", "group"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_study(running: Running, number: int, to_group: bool) -> None:
    ours = running.left()
    for _ in range(2):  # coreutils' timeout sends one to the process and one to its group
        (os.killpg if to_group else os.kill)(running.process.pid, number)
    _, said = running.process.communicate(timeout=LONG)
    assert running.process.returncode == 130 and "the same command goes on from here" in said
    assert "Traceback" not in said
    _, left = psutil.wait_procs(ours | running.left(), timeout=LONG)
    assert not left
    table = pd.read_csv(running.out / "table.csv")
    assert table["contacts.M-A.delta"].tolist() == [1.0] and table["e_star_pa"].tolist() == [1e9]
    page = (running.out / "report.html").read_text("utf-8")
    assert "2 of 3 results are missing: the study was stopped" in page
    assert not list((running.out / "failures").iterdir())  # what was stopped has not failed
    running.go.touch()
    done = subprocess.run(running.line, capture_output=True, timeout=LONG, **running.how)
    assert done.returncode == 0 and "3 results, 0 failed" in done.stdout, done.stderr
    assert lines(running.log, "begin").count(1.0) == 1


@pytest.mark.parametrize("running", ["local"], indirect=True)
def test_a_study_whose_interchange_is_gone_ends_too(running: Running) -> None:
    """Parsl's shutdown would wait for an answer of the interchange forever."""
    (interchange,) = [p for p in running.left() if any(w.endswith(("interchange.py", "HTEX interchange")) for w in p.cmdline())]
    ours = running.left()
    interchange.kill()
    running.process.terminate()
    running.process.communicate(timeout=LONG)
    assert running.process.returncode == 130 and (running.out / "report.html").is_file()
    _, left = psutil.wait_procs(ours | running.left(), timeout=LONG)
    assert not left


def test_a_shutdown_that_never_ends_is_left_after_a_bounded_time() -> None:
    forever = threading.Event()
    worker = subprocess.Popen(["sleep", "3600"], start_new_session=True)
    interchange = subprocess.Popen(["sleep", "3600"])

    class Pool:
        def shutdown(self, wait: bool) -> None:
            forever.wait()

    class Executor:
        interchange_proc = interchange

        class provider:
            resources = {"1": {"remote_pid": worker.pid}}

    try:
        parsl_pool._end(Pool(), Executor(), None, 0.01)
        assert worker.wait(LONG) == -signal.SIGKILL and interchange.wait(LONG) == -signal.SIGKILL
    finally:
        forever.set()
        worker.kill()
        interchange.kill()
    # what a stopped study waits for at most is well below the five seconds that users are promised
    assert parsl_pool.AFTER_INTERRUPT <= 2 and programs.GRACE <= 2
