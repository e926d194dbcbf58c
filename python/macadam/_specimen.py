# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes specimens: particles, Laguerre cells and contacts, from a scene or from given particles."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._scene import Scene, tables_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Progress = Callable[[str, float], object]

#: Names of the arrays that the argument `particles` may have, and of those that it must have.
_ARRAYS, _NEEDED = ("centre", "radius", "phase", "body", "box"), ("centre", "radius")


def specimen(scene: _core.Scene | Mapping[str, Any] | str | PathLike[str], *,
             particles: Mapping[str, ArrayLike] | None = None, out: str | PathLike[str] | None = None,
             sections: Sequence[str] = (), progress: Progress | None = None) -> _core.Specimen:
    """Makes a scene's particles, their Laguerre cells and their contacts: `macadam specimen`.

    particles: arrays that replace the scene's particles; the scene then needs no source of particles. `centre` [m] (n,
    3), `radius` [m] (n,), `phase` (0 aggregate, 1 mastic; if it is not given, all are mastic), `body` (number of the
    aggregate, -1 for mastic), and `box` [m] (3,), if it differs from the scene's; with `box` the specimen is a box.
    out: a folder to write specimen.csv, aggregates.csv, summary.json and so on into, as the command does.
    sections: planes ("x=0.025", "z=40 mm") whose cross sections are written into `out`.
    progress: called with a stage and the fraction of it that is done, 0 to 1.

        >>> import macadam as mc
        >>> law = {"law": "elastic", "E": "10 GPa"}
        >>> scene = {"contacts": [{"pair": "M-M", **law}, {"pair": "M-W", **law}], "materials": {"mastic": {"density": 2400}},
        ...          "loading": {"kind": "cyclic", "frequencies": [10]}}
        >>> mc.specimen(scene, particles={"centre": [[5e-4, 5e-4, 5e-4], [5e-4, 5e-4, 1.5e-3]], "radius": [5e-4, 5e-4],
        ...                               "box": [1e-3, 1e-3, 2e-3]})
        <macadam.Specimen: 2 particles, 3 contacts, box 1 × 1 × 2 mm>
    """
    if particles is not None:
        return _specimen_of_particles(scene, particles)
    given = scene if isinstance(scene, _core.Scene) else Scene(scene)
    if out is None:
        return _core.prepare(given, progress)
    return _core.prepare_into(given, fspath(out), list(sections), progress)


# Makes a specimen from the caller's particles. Raises InputError for an unknown or missing array.
def _specimen_of_particles(scene: _core.Scene | Mapping[str, Any] | str | PathLike[str],
                           particles: Mapping[str, ArrayLike]) -> _core.Specimen:
    wrong = [name for name in particles if name not in _ARRAYS] or [name for name in _NEEDED if name not in particles]
    if wrong:
        found = f"{wrong[0]!r}" if wrong[0] in particles else f"no {wrong[0]}"
        raise _core.InputError(f"particles: found {found}, expected centre, radius and, if needed, phase, body, box")
    given = _scene_of_particles(scene, particles.get("box"))
    return _core.prepare_particles(given, particles.get("box", given.box), particles["centre"], particles["radius"],
                                   particles.get("phase"), particles.get("body"))


def _scene_of_particles(scene: _core.Scene | Mapping[str, Any] | str | PathLike[str], box: ArrayLike | None) -> Scene:
    """Returns the scene with the given particles as its source. The mixture is removed, because it does not describe
    these particles; the densities of a recipe are kept."""
    name, tables, options = tables_of(scene)
    section = tables.get("specimen", {})
    if "recipe" in section:  # the densities of aggregate and mastic follow from the recipe, which is removed below
        recipe: Any = Scene(scene).recipe
        for phase in ("aggregate", "mastic"):
            if recipe[f"{phase}_density"] > 0:
                tables.setdefault("materials", {})[phase] = {"density": recipe[f"{phase}_density"]}
    domain = {k: section[k] for k in ("domain", "box", "diameter", "height") if k in section}
    if box is not None:
        domain = {"box": np.asarray(box).tolist()}
    tables["specimen"] = {"file": _core.given_particles} | domain
    return Scene(tables, file=name, **{k: v for k, v in options.items() if k != "seed"})
