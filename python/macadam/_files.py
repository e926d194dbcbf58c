# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes files that are never incomplete."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path


def write_with(file: Path, fill: Callable[[Path], object]) -> None:
    """Replaces a file by one that `fill` writes to the path it gets; after an error the old file is unchanged."""
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        fill(part)
        part.replace(file)
    finally:
        part.unlink(missing_ok=True)


def write_text(file: Path, text: str) -> None:
    """Replaces a file by one with this text; after an error the old file is unchanged."""
    write_with(file, lambda part: part.write_text(text, encoding="utf-8"))
