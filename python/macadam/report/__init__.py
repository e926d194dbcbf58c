# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports: one self-contained HTML file from any result folders of macadam, and views in three dimensions beside it.

The module itself can be called like its function `report`. matplotlib is imported when a report is made."""

from __future__ import annotations

import sys
import types
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from macadam.report.document import report
    from macadam.report.folders import ReportError

__all__ = ["ReportError", "report"]


# The module's type. It makes `macadam.report(...)` callable, and imports the other names when they are first used.
class _Callable(types.ModuleType):
    def __call__(
        self,
        dirs: str | Path | Iterable[str | Path],
        out: str | Path,
        title: str | None = None,
        *,
        figures: str | Path | None = None,
        scene: str | None = None,
        view: bool = False,
    ) -> Path:
        from macadam.report.document import report

        return report(dirs, out, title, figures=figures, scene=scene, view=view)

    def __getattr__(self, name: str) -> Any:
        if name not in __all__:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        from macadam.report import document, folders

        return getattr(folders if name == "ReportError" else document, name)


sys.modules[__name__].__class__ = _Callable
