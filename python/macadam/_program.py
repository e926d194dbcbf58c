# SPDX-License-Identifier: GPL-3.0-or-later
"""The program that comes with this package."""
from __future__ import annotations

import os
from pathlib import Path


def own_program() -> str | None:
    """Of an installed package its own; where the package runs from a build, that of the build."""
    here = Path(__file__).parent
    for file in (here / "bin" / "macadam", here.parent.parent / "macadam"):
        if file.is_file() and os.access(file, os.X_OK):
            return str(file)
    return None
