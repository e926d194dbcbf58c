# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the program macadam that computes the results, and its version."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

from macadam._program import own_program
from macadam.study.errors import StudyError

_BUILDS = ("local", "cuda-release", "cpu-release", "release")


def find_program() -> str:
    """Returns the program's path: MACADAM_PROGRAM if it is set, else the program that came with this package, else
    macadam in the search path, else a build of the source tree around this package. Raises StudyError if no
    program is found."""
    asked = os.environ.get("MACADAM_PROGRAM")
    if asked:
        if not os.access(asked, os.X_OK) or Path(asked).is_dir():
            raise StudyError(f"MACADAM_PROGRAM: found {asked}, expected a program that can be run")
        return str(Path(asked).resolve())
    found = own_program() or shutil.which("macadam")
    if found:
        return str(Path(found).resolve())
    tree = Path(__file__).resolve().parents[3]
    for build in _BUILDS:
        if os.access(tree / "build" / build / "macadam", os.X_OK):
            return str(tree / "build" / build / "macadam")
    raise StudyError(
        "macadam: found no such program, expected it in MACADAM_PROGRAM, in the search path or in a build of this source tree "
        f"({tree / 'build'})"
    )


def version_of(program: str) -> str:
    """Returns the output of `macadam --version`."""
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise StudyError(f"{program}: {error}") from None
    if done.returncode != 0 or not done.stdout.strip():
        raise StudyError(f"{program} --version: exit code {done.returncode}; {done.stderr.strip()}")
    return done.stdout.strip()
