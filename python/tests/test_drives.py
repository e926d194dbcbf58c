# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives: one order of arguments, functions of the time, pickling, and numbers in their repr."""
from __future__ import annotations

import inspect
import pickle

import numpy as np
import pytest

import macadam as mc
from macadam import drives

DT = 1e-3
ALL = (drives.Cyclic(1e-6, 10, steps_per_period=100), drives.ConstantRate(1e-3, 1.0, dt=DT),
       drives.Ramp(1e-6, 5, 10, True, dt=DT), drives.Haversine(1e-6, 40, 60, 2, dt=DT),
       drives.Table([0, 1e-6, 0], [0, 0.1, 0.2], dt=DT), drives.Function(lambda t: 1e-6 * t, 0.2, dt=DT))


@pytest.mark.parametrize("drive", ALL, ids=lambda d: type(d).__name__)
def test_the_size_comes_first_and_the_time_step_last_by_name(drive):
    names = list(inspect.signature(type(drive)).parameters.values())
    assert names[0].name in ("amplitude", "speed", "height", "values", "function")
    assert names[-1].name == "dt" and names[-1].kind is inspect.Parameter.KEYWORD_ONLY
    assert isinstance(drive, mc.Drive) and drive.dt == pytest.approx(DT, rel=1e-15)  # 1/(10 Hz · 100) is rounded


@pytest.mark.parametrize("drive", ALL, ids=lambda d: type(d).__name__)
def test_a_pickled_drive_has_the_same_values(drive):
    again = pickle.loads(pickle.dumps(drive))
    assert np.array_equal(again.values(0, 300), drive.values(0, 300))
    assert repr(drive).startswith(f"{type(drive).__name__}(") and " object at " not in repr(drive)


def test_a_function_is_computed_at_every_step_and_keeps_its_last_value():
    drive = drives.Function(lambda t: np.sin(t), 0.5, dt=0.1)
    assert np.array_equal(drive.values(0, 8), np.sin(0.1 * np.array([0, 1, 2, 3, 4, 5, 5, 5])))


@pytest.mark.parametrize("call, message", [
    (lambda: drives.Function(lambda t: None, 1, dt=0.1), "function: found None at 0 s, expected a finite number"),
    (lambda: drives.Function(lambda t: 1 / (1.05 - t) ** 0.5 if t < 1 else np.nan, 2, dt=0.5), "function: found nan at 1 s"),
    (lambda: drives.Function(lambda t: t, 0.01, dt=0.1), "duration, dt: found 0.01 s and 0.1 s"),
    (lambda: drives.Cyclic(1e-6, 10, dt=3e-3), "dt: found 0.003 s, 33.3333333 steps per period, expected a whole number"),
    (lambda: drives.Cyclic(1e-6, 10), "steps_per_period, dt: found neither, expected one of them"),
    (lambda: drives.Cyclic(1e-6, 10, steps_per_period=4, dt=1e-3), "steps_per_period, dt: found both")])
def test_wrong_arguments_are_refused(call, message):
    with pytest.raises(mc.InputError, match=message):
        call()
