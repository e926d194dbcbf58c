# SPDX-License-Identifier: GPL-3.0-or-later
"""Steppers with snapshots: the complete state of a stepper as one object, which can be kept, saved and restored."""
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core

_KEPT = ("step", "time", "dt")  # numbers of a snapshot that save() writes beside the arrays
_MOTION = ("displacement", "rotation", "velocity", "spin")  # its arrays of the particles
_PREFIX = "state/"  # in a file, begins the names of the stepper's own arrays


@dataclass(frozen=True, repr=False)
class Snapshot:
    """The state of a stepper after a step: Stepper.snapshot(). Pickling copies it completely.

    `step` and `time` [s] say when it was taken, `dt` [s] is the time step. `displacement` [m], `rotation` [rad], `velocity`
    [m/s] and `spin` [rad/s] of the particles are (n, 3), in the specimen's order. `arrays` is what Stepper.state()
    returned: everything that steps change, by name.
    """

    step: int
    time: float
    dt: float
    displacement: NDArray[np.float64]
    rotation: NDArray[np.float64]
    velocity: NDArray[np.float64]
    spin: NDArray[np.float64]
    arrays: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        """Number of particles."""
        return len(self.displacement)

    def save(self, file: str | PathLike[str]) -> None:
        """Writes the snapshot to a file of NumPy (.npz), which load() reads."""
        held: dict[str, Any] = {name: np.array(getattr(self, name)) for name in (*_KEPT, *_MOTION)}
        held |= {_PREFIX + name: array for name, array in self.arrays.items()}
        with open(file, "wb") as out:
            np.savez_compressed(out, **held)

    @classmethod
    def load(cls, file: str | PathLike[str]) -> Snapshot:
        """Reads a snapshot that save() wrote. Raises InputError if the file holds something else."""
        try:
            with np.load(file, allow_pickle=False) as found:
                held = {name: found[name] for name in found.files}
        except ValueError as error:
            raise _core.InputError(f"{fspath(file)}: found {error}, expected a snapshot (.npz)") from None
        arrays = {k.removeprefix(_PREFIX): v for k, v in held.items() if k.startswith(_PREFIX)}
        missing = [name for name in (*_KEPT, *_MOTION) if name not in held]
        if missing or not arrays:
            raise _core.InputError(f"{fspath(file)}: found no {missing[0] if missing else 'state'}, expected a snapshot")
        return cls(int(held["step"]), float(held["time"]), float(held["dt"]), held["displacement"], held["rotation"],
                   held["velocity"], held["spin"], arrays)

    def __repr__(self) -> str:
        largest = float(np.linalg.norm(self.displacement, axis=1).max(initial=0))
        return (f"<macadam.Snapshot: step {self.step}, {self.time:.6g} s, {len(self)} particles, displacement up to "
                f"{largest:.4g} m>")


class Stepper(_core.Stepper):
    """Steps a specimen in time: velocities at half steps, displacements at whole steps.

        >>> import macadam as mc
        >>> lattice = {"centre": [[5e-4, 5e-4, 5e-4], [5e-4, 5e-4, 1.5e-3]], "radius": [5e-4, 5e-4]}
        >>> laws = [{"pair": pair, "law": "elastic", "E": "10 GPa"} for pair in ("M-M", "M-W")]
        >>> scene = {"contacts": laws, "materials": {"mastic": {"density": 2400}}, "loading": {"kind": "cyclic", "frequencies": [10]}}
        >>> column = mc.specimen(scene, particles={**lattice, "box": [1e-3, 1e-3, 2e-3]})
        >>> dt = mc.critical_step(column) / 2
        >>> pull = mc.drives.Ramp(1e-8, ramp_steps=50, dt=dt)
        >>> stepper = mc.Stepper(column, mc.Boundary().move("+z", "z", pull), backend="cpu")
        >>> stepper.advance(20)
        >>> kept = stepper.snapshot()
        >>> stepper.advance(30)
        >>> stepper.restore(kept)
        >>> stepper.observe().step, kept.step, len(kept)
        (20, 20, 2)
    """

    def snapshot(self) -> Snapshot:
        """Returns a copy of the complete state: restore() continues from it, bit for bit."""
        now, motion = self.observe(), self.particles()
        parts = {name: np.array(getattr(motion, name)) for name in _MOTION}
        return Snapshot(step=now.step, time=now.time, dt=self.dt, arrays=self.state(), **parts)

    def restore(self, snapshot: Snapshot) -> None:
        """Sets the state that snapshot() returned, of this stepper or one of the same specimen, backend and options.
        Raises InputError if the snapshot does not fit."""
        particles = len(self.specimen)
        if len(snapshot) != particles:
            raise _core.InputError(f"snapshot: found {len(snapshot)} particles, expected {particles}, as the specimen has")
        if snapshot.dt != self.dt:
            raise _core.InputError(f"snapshot: found a time step of {snapshot.dt} s, expected {self.dt} s, the stepper's")
        self.set_state(dict(snapshot.arrays))
