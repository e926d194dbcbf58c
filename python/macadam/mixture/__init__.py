# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixtures: computes |E*| and phase angle of an asphalt mixture from measurements of its binder and its mix design
(docs/mixture.md).

The module itself can be called like its function `mixture`. Packages that only this function needs are imported when it
is used."""

from __future__ import annotations

import sys
import types
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from macadam.mixture.driver import Mixture, mixture
    from macadam.mixture.errors import MixtureError

__all__ = ["Mixture", "MixtureError", "mixture"]


# The module's type. It makes `macadam.mixture(...)` callable, and imports the other names when they are first used.
class _Callable(types.ModuleType):
    def __call__(self, *arguments: Any, **more: Any) -> Mixture:
        from macadam.mixture.driver import mixture

        return mixture(*arguments, **more)

    def __getattr__(self, name: str) -> Any:
        if name not in __all__:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        from macadam.mixture import driver, errors

        return getattr(errors if name == "MixtureError" else driver, name)


sys.modules[__name__].__class__ = _Callable
