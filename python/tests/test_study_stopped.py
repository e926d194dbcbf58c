# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies that are stopped by a signal: they end, leave no process, and write table and report of the results so
far."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import threading
from pathlib import Path

import pandas as pd
import pytest

from macadam.study import parsl_pool, programs
from study_faults import lines

psutil = pytest.importorskip("psutil")
pytest.importorskip("parsl")
from study_running import Running  # noqa: E402

LONG = 3600  # seconds after which a test fails; only something that never ends takes this long
BOUND = 5.0  # seconds in which a stopped study must end on a machine that does nothing else


@pytest.fixture(params=["local", "threads"])
def running(request: pytest.FixtureRequest, tmp_path: Path):
    study = Running(tmp_path, request.param)
    try:
        study.wait_for_work()
        yield study
    finally:
        study.kill()


def _processor_time_of_ended_processes() -> float:
    """Returns the processor time [s] of all child processes of this process that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.mark.parametrize("to_group", [False, True], ids=["process", "group"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_study(running: Running, number: int, to_group: bool) -> None:
    """The test does not measure wall time, which depends on the other programs of the machine. A stopped study waits
    for other processes once, for at most AFTER_INTERRUPT (Parsl) or GRACE (threads); a test below shows that the wait
    ends. The rest of the time it uses the processor. Therefore the test compares BOUND with the longest wait plus the
    processor time that the study's process uses after the signal."""
    ours = running.left()
    ended_before = _processor_time_of_ended_processes()
    at_signal = sum(psutil.Process(running.process.pid).cpu_times()[:4])
    for _ in range(2):  # the `timeout` of coreutils sends one signal to the process and one to its group
        (os.killpg if to_group else os.kill)(running.process.pid, number)
    _, said = running.process.communicate(timeout=LONG)
    worked = _processor_time_of_ended_processes() - ended_before - at_signal
    assert worked + max(parsl_pool.AFTER_INTERRUPT, programs.GRACE) <= BOUND
    assert running.process.returncode == 130 and "run the same command again to continue" in said
    assert "Traceback" not in said
    _, left = psutil.wait_procs(ours | running.left(), timeout=LONG)
    assert not left
    table = pd.read_csv(running.out / "table.csv")
    assert table["contacts.M-A.delta"].tolist() == [1.0] and table["e_star_pa"].tolist() == [1e9]
    page = (running.out / "report.html").read_text("utf-8")
    assert "2 of 3 results are missing: the study was stopped" in page
    assert not list((running.out / "failures").iterdir())  # a stopped point has not failed
    if to_group or number == signal.SIGTERM:
        return  # only one case continues the study, because that is slow
    running.go.touch()
    done = subprocess.run(running.line, capture_output=True, timeout=LONG, **running.how)
    assert done.returncode == 0 and "3 results, 0 failed" in done.stdout, done.stderr
    assert lines(running.log, "begin").count(1.0) == 1


@pytest.mark.parametrize("running", ["local"], indirect=True)
def test_a_study_whose_interchange_is_gone_ends_too(running: Running) -> None:
    """Parsl's shutdown would wait for an answer of the interchange forever."""
    names = ("interchange.py", "HTEX interchange")
    (interchange,) = [p for p in running.left() if any(w.endswith(names) for w in p.cmdline())]
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
