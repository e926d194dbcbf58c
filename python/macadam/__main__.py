# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m macadam …`, and the command `macadam` of an installed package: reports and studies in Python, all else by the
program that comes with the package."""
from __future__ import annotations

import importlib.util
import os
import runpy
import sys
from pathlib import Path

#: Commands that are packages of their own.
_HERE = ("report", "study")


def _program() -> str | None:
    """The C++ program: of this package, or, where the package runs from a build, that of the build."""
    here = Path(__file__).parent
    for file in (here / "bin" / "macadam", here.parent.parent / "macadam"):
        if file.is_file() and os.access(file, os.X_OK):
            return str(file)
    return None


def main() -> None:
    """Runs the command line."""
    command = sys.argv[1] if len(sys.argv) > 1 else ""
    if command in _HERE:
        if importlib.util.find_spec(f"macadam.{command}") is None:
            sys.exit(f"macadam: {command}: found a package without macadam.{command}, expected one that has it")
        del sys.argv[1]
        runpy.run_module(f"macadam.{command}", run_name="__main__", alter_sys=True)
        return
    program = _program()
    if program is None:
        sys.exit("macadam: found no program macadam/bin/macadam, expected it in an installed package")
    os.execv(program, ["macadam", *sys.argv[1:]])


if __name__ == "__main__":
    main()
