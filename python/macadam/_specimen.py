# SPDX-License-Identifier: GPL-3.0-or-later
"""Specimens: particles, Laguerre cells and contacts of a scene."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._scene import Scene

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Progress = Callable[[str, float], object]


def _flat(values: ArrayLike, kind: type) -> Any:
    return np.ascontiguousarray(values, dtype=kind)


def specimen(scene: _core.Scene | Mapping[str, Any] | str | PathLike[str], *,
             particles: Mapping[str, ArrayLike] | None = None, out: str | PathLike[str] | None = None,
             sections: Sequence[str] = (), progress: Progress | None = None) -> _core.Specimen:
    """Makes a scene's particles, their Laguerre cells and their contacts: `macadam specimen`.

    particles: in place of the scene's own: `centre` [m] (n, 3), `radius` [m], `phase` (0 aggregate, 1 mastic), `body`
    (number of the aggregate, -1 for mastic), and `box` [m], where it is not the scene's.
    out: a folder to write specimen.csv, aggregates.csv, summary.json and so on into, as the command does.
    sections: planes to cut ("x=0.025", "z=40 mm"), written into `out`.
    progress: called with a stage and the share of it that is done, 0 to 1.
    """
    given = scene if isinstance(scene, _core.Scene) else Scene(scene)
    if particles is None:
        if out is None:
            return _core.prepare(given, progress)
        return _core.prepare_into(given, fspath(out), list(sections), progress)
    n = len(particles["radius"])  # type: ignore[arg-type]
    return _core.prepare_particles(
        given, tuple(particles.get("box", given.box)), _flat(particles["centre"], np.float64),
        _flat(particles["radius"], np.float64), _flat(particles.get("phase", np.ones(n)), np.int32),
        _flat(particles.get("body", np.full(n, -1)), np.int32))
