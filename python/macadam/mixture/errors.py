# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a wrong design or a failed run."""

from __future__ import annotations

from typing import Any, NoReturn


class MixtureError(Exception):
    """A design that is wrong, or a run that failed. code: exit code of the command, 2 for wrong input, 1 for a failed
    run."""

    def __init__(self, message: str, code: int = 2) -> None:
        super().__init__(message)
        self.code = code


def refuse(source: Any, key: str, found: Any, expected: str) -> NoReturn:
    """Raises MixtureError that names the file, the key, the value found and the value expected."""
    raise MixtureError(f"{source}: {key}: found {found}, expected {expected}")
