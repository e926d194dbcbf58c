# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds parameters of a scene from measured moduli of the mixture (docs/calibration.md)."""
from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

from . import _core
from ._fit import Data, modulus_data
from ._scene import Scene
from ._simulation import SceneLike, _scene_and_specimen, result_folder

if TYPE_CHECKING:
    import pandas


class Calibration:
    """The result of a calibration, and the folder with its files: scene.toml, calibration.json, predicted.csv."""

    def __init__(self, scene: Scene, data: _core.ModulusData, out: str | PathLike[str] | None, **call: Any) -> None:
        self.folder = result_folder(out, self)
        found = _core.calibrate(scene, data, out=fspath(self.folder), **call)
        self.warnings: list[str] = found["warnings"]
        self._text: str = found["text"]

    @cached_property
    def json(self) -> dict[str, Any]:
        """The content of calibration.json: everything about the calibration."""
        return json.loads((self.folder / "calibration.json").read_text(encoding="utf-8"))

    @cached_property
    def parameters(self) -> pandas.DataFrame:
        """One row per parameter: name, unit, value, standard_deviation, start, low, high, at_bound."""
        import pandas
        return pandas.DataFrame(self.json["parameters"])

    @cached_property
    def table(self) -> pandas.DataFrame:
        """One row per measurement: measured, predicted, difference."""
        import pandas
        return pandas.read_csv(self.folder / "predicted.csv", comment="#")

    @cached_property
    def scene(self) -> Scene:
        """The scene with the calibrated values."""
        return Scene(self.folder / "scene.toml")

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        found = [f"{p['name']} {p['value']:.4g}{' ' + p['unit'] if p['unit'] else ''} ± {p['standard_deviation']:.2g}"
                 for p in self.json["parameters"]]
        return f"<macadam.Calibration: {', '.join(found)}>"


def calibrate(scene: SceneLike, target: Data, free: Sequence[str], *,
              bounds: Mapping[str, tuple[float, float]] | None = None,
              priors: Mapping[str, tuple[float, float]] | None = None, seeds: int = 1,
              misfit: str = "modulus-and-phase", e_star_deviation: float = 3, phase_deviation: float = 1,
              nearest: bool = False, out: str | PathLike[str] | None = None,
              progress: Callable[[str, float], object] | None = None, **overrides: Any) -> Calibration:
    """Finds parameters with which the scene's specimen has the measured moduli: `macadam calibrate`.

    target: a table in a file, a DataFrame or a dictionary of columns: frequency_hz, e_star_pa, phase_deg and, if known,
    temperature_c, e_star_std, phase_std. `Result.table` of a cyclic test or a sweep has these columns. A column of
    moduli or of phases that the misfit does not count is not needed.
    free: names of the parameters to find: "M-A.delta", "M-M.E_1", "inner.E", "A-A.alpha".
    bounds: lowest and highest value by name. priors: a value and the standard deviation of its natural logarithm (0.1:
    about 10 %) by name.
    seeds: number of specimens whose E* is averaged.
    misfit: the differences that count: "modulus-and-phase", "modulus", "phase" or "parts" (E' and E'').
    e_star_deviation [%], phase_deviation [degrees]: standard deviations of the measurements, if the target has none.
    nearest: if the target cannot be reached, return the nearest values and a warning.
    out: the folder of the files; a temporary one if it is not given. overrides: as for Scene.
    """
    given, _ = _scene_and_specimen(scene, None)
    if overrides:
        given = Scene(given, **overrides)
    needed = misfit if misfit in ("modulus", "phase") else "modulus-and-phase"
    return Calibration(given, modulus_data(target, needed=needed), out, free=[free] if isinstance(free, str) else list(free),
                       bounds=dict(bounds or {}), priors=dict(priors or {}), seeds=seeds, misfit=misfit,
                       e_star_deviation=e_star_deviation, phase_deviation=phase_deviation, nearest=nearest,
                       progress=progress)
