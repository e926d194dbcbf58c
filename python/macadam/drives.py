# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives: displacements [m] or forces [N] of a wall along one axis, as functions of the step.

All drives take their arguments in one order: first the size [m] or [N], then its course in time, and last, by name, the
time step `dt` [s].

    >>> from macadam import drives
    >>> drives.Ramp(1e-6, ramp_steps=4, dt=1e-5).values(0, 6).tolist()
    [0.0, 2.5e-07, 5e-07, 7.5e-07, 1e-06, 1e-06]
"""
from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._core import Drive, InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["ConstantRate", "Cyclic", "Drive", "Function", "Haversine", "Ramp", "Table"]


# nanobind allows no second base class, so the drives share the following functions instead of a base class.
def _repr(drive: Any) -> str:
    """Returns the call that makes the drive, with arrays as their number of values."""
    words = [f"{name}={_short(value)}" for name, value in drive._given.items()]
    return f"{type(drive).__name__}({', '.join(words)})"


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"<{value.size} numbers from {value.min():.6g} to {value.max():.6g}>"
    return f"{value:.6g}" if isinstance(value, float) else repr(value)


def _reduce(drive: Any) -> tuple[Any, ...]:
    return _made_again, (type(drive), drive._given)


def _made_again(kind: type[Any], given: dict[str, Any]) -> Any:
    return kind(**given)


class Cyclic(_core.Cyclic):
    """-amplitude·sin(2πft), with a smooth start over `ramp_steps`. The top wall begins with compression.

    amplitude: [m] or [N]. frequency: [Hz]. A period is a whole number of steps: give either steps_per_period or dt [s],
    of which 1/frequency must be a multiple.

        >>> from macadam import drives
        >>> drives.Cyclic(2e-6, frequency=10, steps_per_period=4).values(0, 4).round(9).tolist()
        [-0.0, -2e-06, -0.0, 2e-06]
    """

    def __init__(self, amplitude: float, frequency: float, *, steps_per_period: int | None = None, ramp_steps: int = 0,
                 dt: float | None = None) -> None:
        if (steps_per_period is None) == (dt is None):
            found = "neither" if dt is None else "both"
            raise InputError(f"steps_per_period, dt: found {found}, expected one of them")
        steps = steps_per_period if steps_per_period is not None else _steps_of_period(frequency, dt or 0)
        super().__init__(amplitude, frequency, steps, ramp_steps)
        self._given = {"amplitude": amplitude, "frequency": frequency, "steps_per_period": steps,
                       "ramp_steps": ramp_steps}

    __repr__, __reduce__ = _repr, _reduce


def _steps_of_period(frequency: float, dt: float) -> int:
    """Returns the number of time steps `dt` [s] in a period. Raises InputError unless it is a whole number, up to
    rounding."""
    if not frequency > 0 or not dt > 0:
        raise InputError(f"frequency, dt: found {frequency} Hz and {dt} s, expected numbers above 0")
    steps = 1 / (frequency * dt)
    if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
        raise InputError(f"dt: found {dt} s, {steps:.9g} steps per period, expected a whole number of steps per period, for "
                         f"example dt = {1 / (frequency * max(1, np.ceil(steps))):.9g} s")
    return round(steps)


class ConstantRate(_core.ConstantRate):
    """speed·t, for a test that takes `duration`. speed: [m/s] or [N/s]. duration, dt: [s].

        >>> from macadam import drives
        >>> drives.ConstantRate(1e-3, duration=1, dt=0.25).values(0, 4).tolist()
        [0.0, 0.00025, 0.0005, 0.00075]
    """

    def __init__(self, speed: float, duration: float, *, dt: float) -> None:
        super().__init__(speed, dt, duration)
        self._given = {"speed": speed, "duration": duration, "dt": dt}

    __repr__, __reduce__ = _repr, _reduce


class Ramp(_core.Ramp):
    """Grows from 0 to `height` in `ramp_steps`, stays there for `hold_steps` (by default to the end), and returns to 0.

    height: [m] or [N]. smooth: as a half cosine in place of a straight line. dt: [s]. The module has an example.
    """

    def __init__(self, height: float, ramp_steps: int = 1, hold_steps: int | None = None, smooth: bool = False, *,
                 dt: float) -> None:
        hold = {} if hold_steps is None else {"hold_steps": hold_steps}
        super().__init__(height, dt, ramp_steps, smooth=smooth, **hold)
        self._given = {"height": height, "ramp_steps": ramp_steps, "hold_steps": hold_steps, "smooth": smooth, "dt": dt}

    __repr__, __reduce__ = _repr, _reduce


class Haversine(_core.Haversine):
    """Pulses height·sin²(πt/pulse) of `pulse_steps`, each followed by `rest_steps` of 0; by default without end.

    height: [m] or [N]. dt: [s].

        >>> from macadam import drives
        >>> drives.Haversine(1.0, pulse_steps=2, rest_steps=2, dt=0.1).values(0, 6).round(9).tolist()
        [0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    """

    def __init__(self, height: float, pulse_steps: int, rest_steps: int = 0, pulses: int | None = None, *,
                 dt: float) -> None:
        count = {} if pulses is None else {"pulses": pulses}
        super().__init__(height, dt, pulse_steps, rest_steps, **count)
        self._given = {"height": height, "pulse_steps": pulse_steps, "rest_steps": rest_steps, "pulses": pulses, "dt": dt}

    __repr__, __reduce__ = _repr, _reduce


class Table(_core.Table):
    """Values at ascending times, with linear interpolation between them.

    values: [m] or [N], (n,). times: [s], (n,). dt: [s].

        >>> from macadam import drives
        >>> drives.Table([0, 1e-6], times=[0, 0.2], dt=0.1).values(0, 3).tolist()
        [0.0, 5e-07, 1e-06]
    """

    def __init__(self, values: ArrayLike, times: ArrayLike, *, dt: float) -> None:
        super().__init__(dt, times, values)
        self._given = {"values": np.array(values, float), "times": np.array(times, float), "dt": dt}

    __repr__, __reduce__ = _repr, _reduce


class Function(Table):
    """A function of the time, computed once at each step from 0 to `duration`; it keeps its last value after that.

    function: called with the time [s] as a float, returns [m] or [N]. duration, dt: [s]. Raises InputError if a value is
    not a finite number. A pickled drive contains the values, not the function.

        >>> from macadam import drives
        >>> drives.Function(lambda t: 1e-6 * t**2, duration=2, dt=0.5).values(0, 6).tolist()
        [0.0, 2.5e-07, 1e-06, 2.25e-06, 4e-06, 4e-06]
    """

    def __init__(self, function: Callable[[float], float], duration: float, *, dt: float) -> None:
        if not dt > 0 or not duration >= dt:
            raise InputError(f"duration, dt: found {duration} s and {dt} s, expected a duration of at least one time step")
        times = dt * np.arange(int(np.ceil(duration / dt - 1e-9)) + 1)
        values = np.array([_number(function, t) for t in times.tolist()])
        super().__init__(values, times, dt=dt)

    def __reduce__(self) -> tuple[Any, ...]:
        return _made_again, (Table, self._given)


def _number(function: Callable[[float], float], time: float) -> float:
    """Returns the function's value at a time [s]. Raises InputError unless it is a finite number."""
    value = function(time)
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = float("nan")
    if not np.isfinite(number):
        raise InputError(f"function: found {value!r} at {time:.6g} s, expected a finite number")
    return number
