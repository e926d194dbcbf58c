# SPDX-License-Identifier: GPL-3.0-or-later
"""Long calls: Ctrl-C ends them, and other threads run at the same time."""
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import macadam as mc

LONG = {"loading.frequencies": [0.5], "solver.tolerance": None, "solver.density_scaling": 1.0, "loading.start": "rest",
        "loading.cycles": 1}


def interrupted(work, said, tmp_path):
    """Runs `work` in a new Python process. The process prints `ready` during the call, and is then interrupted as by
    Ctrl-C."""
    code = "import macadam as mc, numpy as np, sys\n" + textwrap.dedent(work)
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                             cwd=tmp_path, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    before = child.stdout.readline()
    assert before.startswith("ready"), before + child.stdout.read()
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=3600)  # only a call that never ends takes this long
    assert "KeyboardInterrupt" in out and said in out, out


def test_ctrl_c_ends_a_run_with_a_checkpoint(scene, small_file, tmp_path):
    interrupted(f"""
        told = []
        def tell(*step):
            if not told:
                told.append(print("ready"))
        mc.run({str(small_file)!r}, out="out", on_step=tell, every=1, **{LONG!r})""", "checkpoint", tmp_path)
    assert (tmp_path / "out" / "checkpoint.h5").exists()


def test_ctrl_c_ends_what_prepares(scene, small_file, tmp_path):
    interrupted(f"""
        scene = mc.Scene({str(small_file)!r}, **{{"specimen.box": ["80 mm", "80 mm", "120 mm"]}})  # minutes
        told = []
        def tell(stage, share):
            if not told:
                told.append(print("ready"))
        mc.specimen(scene, progress=tell)""", "nothing was written", tmp_path)


def test_ctrl_c_leaves_a_stepper_that_goes_on(small_file, tmp_path):
    interrupted(f"""
        specimen = mc.specimen({str(small_file)!r})
        stepper = mc.Stepper(specimen, mc.Boundary(), backend="cpu")
        import threading, time
        begin = time.process_time()
        def tell():  # nothing but the steps takes the processor
            while time.process_time() < begin + 0.2:
                time.sleep(0.001)
            print("ready")
        threading.Thread(target=tell).start()
        try:
            stepper.advance(10**9)
        except KeyboardInterrupt as error:
            stepper.advance(1)
            print("KeyboardInterrupt", error)""", "can continue", tmp_path)


def test_python_runs_beside_a_long_call(specimen):
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)
    beside = threading.Thread(target=count)
    stepper = mc.Stepper(specimen, mc.Boundary(), backend="cpu", threads=1)
    beside.start()
    before, calls = counted[0], 0
    # If advance() held the lock of Python, the second thread could count at most once between two
    # calls.
    while counted[0] - before <= 3 * calls + 20 and calls < 300:
        stepper.advance(5000)
        calls += 1
    done.set()
    beside.join()
    assert calls < 300


def test_threads_get_the_numbers_of_one(scene):
    def one(seed):
        return mc.harmonic(mc.Scene(scene, seed=seed, threads=1), frequencies=[10]).table.e_star_pa[0]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(one, [1, 2, 3, 1])) == [one(s) for s in (1, 2, 3, 1)]


def test_a_stepper_serves_one_thread_at_a_time(specimen):
    stepper = mc.Stepper(specimen, mc.Boundary(), backend="cpu", threads=1)
    other = threading.Thread(target=stepper.advance, args=(3000,))
    other.start()
    time.sleep(0.02)
    try:
        stepper.advance(1)
    except mc.RunError as error:
        assert "another thread" in str(error)  # observe() and similar functions report it too
    other.join()
    assert stepper.observe().step in (3000, 3001)
    assert np.isfinite(stepper.particles().velocity).all()


def test_a_solver_serves_threads_in_turn(specimen):
    solver = mc.HarmonicSolver(specimen)
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda f: solver.solve([f])[0].e_star_pa, [5.0, 10.0, 5.0, 10.0]))
    assert found[:2] == found[2:] and found[0] < found[1]


def test_what_the_last_callback_raises_is_raised(specimen):
    def fail(stage, share):
        if stage == "contact network":  # the last stage
            raise LookupError("too late to stop")
    with pytest.raises(LookupError, match="too late"):
        mc.specimen(specimen.scene, progress=fail)


def test_a_run_in_another_thread_may_raise_there(specimen):
    def fail(step):
        raise OSError("from a thread")
    with ThreadPoolExecutor(1) as pool, pytest.raises(OSError, match="from a thread"):
        pool.submit(mc.run, specimen, on_step=fail, every=100).result()
