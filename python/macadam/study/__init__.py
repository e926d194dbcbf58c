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
    import concurrent.futures
    from collections.abc import Callable
    from pathlib import Path

    from macadam.study.driver import Study, study
    from macadam.study.errors import StudyError

__all__ = ["Study", "StudyError", "study"]


# The module's type. It makes `macadam.study(...)` callable, and imports the other names when they are first used.
class _Callable(types.ModuleType):
    def __call__(
        self,
        source: str | Path | dict[str, Any],
        out: str | Path,
        *,
        executor: concurrent.futures.Executor | None = None,
        on: str | None = None,
        workers: int | None = None,
        program: str | None = None,
        retry_failed: bool = False,
        progress: Callable[[int, int, int], None] | None = None,
    ) -> Study:
        """Computes a study; macadam.study.study describes the arguments."""
        from macadam.study.driver import study

        return study(
            source,
            out,
            executor=executor,
            on=on,
            workers=workers,
            program=program,
            retry_failed=retry_failed,
            progress=progress,
        )

    def __getattr__(self, name: str) -> Any:
        if name not in __all__:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        from macadam.study import driver, errors

        return getattr(errors if name == "StudyError" else driver, name)


sys.modules[__name__].__class__ = _Callable
