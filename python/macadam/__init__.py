# SPDX-License-Identifier: GPL-3.0-or-later
"""Macadam: discrete elements for bituminous mixtures and other bonded granular solids.

    import macadam as mc
    scene = mc.Scene("examples/demo/scene.toml", seed=3)
    result = mc.harmonic(scene, frequencies=[2, 5, 10, 20])
    print(result.table)

All numbers are in SI units (m, kg, s, Pa), angles of results in degrees. docs/python.md shows everything.

Names are loaded when they are first used, so that the parts in plain Python (macadam.mixture, macadam.report,
macadam.study) also work if the compiled library is not installed.
"""
from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

# OpenMP reads OMP_WAIT_POLICY once, when the compiled library is loaded. By default, threads of OpenMP spin while they
# wait. If other programs use the cores, spinning makes the work several times slower.
if "OMP_WAIT_POLICY" not in os.environ and "GOMP_SPINCOUNT" not in os.environ:
    os.environ["OMP_WAIT_POLICY"] = "passive"

#: The public names of the package, by the module that defines them.
_HOMES = {
    "_core": ("Error", "InputError", "RunError", "InterruptedError", "DivergenceError", "info", "experiments", "pair_names",
              "Specimen", "Contacts", "Cells", "Section", "Boundary", "Drive", "FieldSeries", "Step", "Observation",
              "ParticleState", "ContactState", "HarmonicSolver", "SteadyState", "StartState", "steady_start",
              "Spectrum", "PronySeries", "CreepSeries", "spectrum", "evaluate_cyclic", "critical_step", "__version__"),
    "_stepper": ("Stepper", "Snapshot"),
    "_scene": ("Scene",),
    "_specimen": ("specimen",),
    "_simulation": ("run", "test", "harmonic", "sweep", "relaxation", "creep", "monotonic"),
    "_result": ("Result",),
    "_fit": ("fit", "Fit"),
    "_calibration": ("calibrate", "Calibration"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
_MODULES = ("ct", "drives", "shapes", "mixture", "report", "study")

if TYPE_CHECKING:
    from . import ct, drives, shapes
    from ._calibration import Calibration, calibrate
    from ._core import (Boundary, Cells, Contacts, ContactState, CreepSeries, DivergenceError, Drive, Error,
                        FieldSeries, HarmonicSolver, InputError, Observation, ParticleState,
                        PronySeries, RunError, Section, Specimen, Spectrum, StartState, SteadyState, Step,
                        critical_step, evaluate_cyclic, experiments, info, pair_names, spectrum, steady_start)
    from ._core import InterruptedError as InterruptedError
    from ._fit import Fit, fit
    from ._result import Result
    from ._scene import Scene
    from ._simulation import creep, harmonic, monotonic, relaxation, run, sweep, test
    from ._specimen import specimen
    from ._stepper import Snapshot, Stepper
    from .mixture.driver import mixture
    from .report.document import report
    from .study.driver import study
    __version__: str

#: All public names except InterruptedError: `from macadam import *` would hide Python's exception of that name.
__all__ = [name for name in _HOME_OF if name != "InterruptedError" and not name.startswith("_")] + list(_MODULES)


def __getattr__(name: str) -> Any:
    if name in _HOME_OF:
        value = getattr(importlib.import_module(f"{__name__}.{_HOME_OF[name]}"), name)
        globals()[name] = value
        return value
    if name in _MODULES:
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*_HOME_OF, *_MODULES, *(name for name in globals() if name.startswith("__"))})
