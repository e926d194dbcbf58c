# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the program macadam that comes with this package."""
from __future__ import annotations

import os
from pathlib import Path


def own_program() -> str | None:
    """Returns the path of the program in the installed package or, if the package runs from a build folder, of the
    build's program; None if there is neither."""
    here = Path(__file__).parent
    for file in (here / "bin" / "macadam", here.parent.parent / "macadam"):
        if file.is_file() and os.access(file, os.X_OK):
            return str(file)
    return None
