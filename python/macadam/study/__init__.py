# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: computes a scene with many values of its keys (grids, Latin hypercubes, lists), on this machine or a
cluster.

The module itself can be called like its function `study`. Packages that only this function needs are imported when it
is used, because workers need few of them."""

from __future__ import annotations

import sys
import types
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from macadam.study.driver import Study, study
    from macadam.study.errors import StudyError

__all__ = ["Study", "StudyError", "study"]


# The module's type. It makes `macadam.study(...)` callable, and imports the other names when they are first used.
class _Callable(types.ModuleType):
    def __call__(self, *arguments: Any, **more: Any) -> Study:
        from macadam.study.driver import study

        return study(*arguments, **more)

    def __getattr__(self, name: str) -> Any:
        if name not in __all__:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        from macadam.study import driver, errors

        return getattr(errors if name == "StudyError" else driver, name)


sys.modules[__name__].__class__ = _Callable
