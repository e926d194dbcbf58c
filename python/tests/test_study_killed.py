# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies whose driver or workers are killed at random moments: all results are computed in the end, and none twice."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from report_folders import ENVIRONMENT, PROGRAM
from study_faults import lines, scene, stand_in

psutil = pytest.importorskip("psutil")
pytest.importorskip("parsl")

WORKERS = 2
LONG = 3600  # seconds after which a test fails; only something that never ends takes this long
STUDY = """
scene = "scene.toml"
[grid]
"contacts.M-A.delta" = VALUES
[run]
workers = WORKERS
"""


def processes(driver: subprocess.Popen, folder: Path) -> list[psutil.Process]:
    """Returns the driver and all processes that it or earlier drivers started, directly or indirectly."""
    found = {driver.pid: psutil.Process(driver.pid)} if driver.poll() is None else {}
    for process in psutil.process_iter():
        try:
            if str(folder) in " ".join(process.cmdline()):
                for one in (process, *process.children(recursive=True)):
                    found[one.pid] = one
        except psutil.Error:
            continue
    found.pop(os.getpid(), None)
    return list(found.values())


def is_worker(process: psutil.Process) -> bool:
    """Returns whether the process belongs to the workers: a worker itself, or the program that it runs. Parsl's manager is neither."""
    try:
        line, above = " ".join(process.cmdline()), process.parent()
        if "macadam.study.manager" in line:  # the process that watches the manager
            return False
        return "macadam-1" in line or (above is not None and "process_worker_pool.py" in " ".join(above.cmdline()[:2]))
    except psutil.Error:
        return False


def killed(process: psutil.Process) -> bool:
    """Kills the process. Returns whether it was alive before."""
    try:
        process.kill()
    except psutil.Error:
        return False
    return True


def published(out: Path) -> dict[str, tuple[int, int]]:
    """Returns the existing results with inode and time of their records, which would change if a result were computed
    again."""
    there = {}
    for result in (out / "results").glob("*"):
        state = (result / "study.json").stat()
        there[result.name] = (state.st_ino, state.st_mtime_ns)
    return there


@pytest.mark.skipif(PROGRAM is None, reason="no program macadam: build it, or set MACADAM_PROGRAM")
@pytest.mark.parametrize("points, kills", [(30, 3), pytest.param(200, 10, marks=pytest.mark.long)])
def test_drivers_and_workers_are_killed(points: int, kills: int, tmp_path: Path) -> None:
    program, log = stand_in(tmp_path, pause=0.15, real="5.0")  # every tenth value is computed by macadam itself
    scene(tmp_path)
    values = [100.0 + k for k in range(points)]
    (tmp_path / "study.toml").write_text(STUDY.replace("VALUES", str(values)).replace("WORKERS", str(WORKERS)))
    out = tmp_path / "out"
    chance = random.Random(7)
    # numbers of results after which a driver or worker is killed
    moments = sorted(chance.sample(range(2, points - 5), kills))
    line = [sys.executable, "-m", "macadam.study", "study.toml", "--out", str(out)]
    environment = {**ENVIRONMENT, "MACADAM_PROGRAM": program}
    kept: dict[str, tuple[int, int]] = {}
    driver, drivers, workers, moved = None, 0, 0, time.monotonic()
    seen: set[psutil.Process] = set()
    try:
        while driver is None or driver.poll() is None or driver.returncode != 0:
            assert time.monotonic() < moved + LONG, f"no result more than {len(kept)} for {LONG} s"
            if driver is None or driver.poll() is not None:
                assert driver is None or driver.returncode == -signal.SIGKILL, driver.stderr.read()
                driver = subprocess.Popen(line, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True)
            there = published(out)
            assert {key: there.get(key) for key in kept} == kept, "a result was made anew"
            moved = time.monotonic() if len(there) > len(kept) else moved
            kept = there
            if moments and len(there) >= moments[0]:
                all_of_them = processes(driver, out)
                seen |= set(all_of_them)
                busy = [p for p in all_of_them if p.pid != driver.pid and is_worker(p)]
                if len(moments) % 3:
                    if busy and killed(chance.choice(busy)):
                        workers += 1
                        moments.pop(0)
                else:
                    driver.kill()
                    driver.wait()
                    drivers += 1
                    moments.pop(0)
            time.sleep(0.02)
        # processes that a killed driver left behind must end by themselves
        _, left = psutil.wait_procs(seen, timeout=LONG)
        assert not left, left
    finally:
        for process in {*processes(driver, out), *seen}:
            killed(process)
    assert not moments and drivers == kills // 3 and workers == kills - drivers
    assert len(published(out)) == points
    table = pd.read_csv(out / "table.csv")
    assert set(table["contacts.M-A.delta"]) == set(values) and table["key"].nunique() == points
    assert len(table) == points + 2 * (points // 10)  # a result that macadam itself computed has three frequencies
    # only computations that were running at a kill start again: at most one per worker
    assert len(lines(log, "begin")) <= points + kills * WORKERS
    assert set(lines(log, "end")) == set(values)
    assert not (out / "failures.csv").exists() and not (out / "running").exists()
    before = len(lines(log, "begin"))
    again = subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=LONG)
    assert again.returncode == 0 and len(lines(log, "begin")) == before, "a finished study computes nothing"


def test_a_manager_that_waits_for_ever_ends_with_its_study() -> None:
    """If a worker is killed while it holds the queue of results, Parsl's manager of workers waits forever. In this test
    a program that only waits takes the place of the manager."""
    study = subprocess.Popen(["sleep", "3600"])
    line = [sys.executable, "-m", "macadam.study.manager", str(study.pid), "1", "sleep", "3600"]
    manager = subprocess.Popen(line, env=ENVIRONMENT)
    try:
        process = psutil.Process(manager.pid)
        while process.cmdline() != ["sleep", "3600"]:  # until the process has become the command
            assert manager.poll() is None
            time.sleep(0.01)
        (watcher,) = process.children()
        looked = watcher.num_ctx_switches().voluntary
        while watcher.num_ctx_switches().voluntary < looked + 3:  # until the watcher process has checked at least twice
            time.sleep(0.01)
        assert manager.poll() is None
        study.kill()
        study.wait()
        assert manager.wait(timeout=LONG) == -signal.SIGKILL
        _, left = psutil.wait_procs([watcher], timeout=LONG)
        assert not [p for p in left if p.status() != psutil.STATUS_ZOMBIE], left
    finally:
        for process in (study, manager):  # does nothing to a process that has ended
            process.kill()
