# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `python -m macadam …`, and the command `macadam` of an installed package. The commands mcp, mixture, report
and study are Python packages; every other command is passed to the program macadam that comes with the package."""
from __future__ import annotations

import importlib.util
import os
import runpy
import sys

from ._program import own_program

#: Commands that are Python packages.
_HERE = ("mcp", "mixture", "report", "study")
#: Python packages that these commands need.
_NEEDED = ("numpy", "pandas", "matplotlib")


def _check(command: str) -> None:
    """Ends the process with a message if this Python is too old for the command or lacks a package that the command
    needs."""
    missing = [name for name in _NEEDED if importlib.util.find_spec(name) is None]
    if sys.version_info < (3, 11):
        found, expected = "Python " + ".".join(map(str, sys.version_info[:2])), "3.11 or later"
    elif missing:
        found, expected = "no Python package " + ", ".join(missing), f"{'it' if len(missing) == 1 else 'them'}"
    else:
        return
    print(f"macadam {command}: {sys.executable}: found {found}, expected {expected}; install with `scripts/python report` "
          f"in the source tree or with `pip install 'macadam[{command}]'`, or let MACADAM_PYTHON name another Python",
          file=sys.stderr)
    sys.exit(2)


def main() -> None:
    """Runs the command line."""
    command = sys.argv[1] if len(sys.argv) > 1 else ""
    if command in _HERE:
        _check(command)
        del sys.argv[1]
        runpy.run_module(f"macadam.{command}", run_name="__main__", alter_sys=True)
        return
    program = own_program()
    if program is None:
        sys.exit("macadam: found no program macadam/bin/macadam, expected it in the installed Python package")
    os.execv(program, ["macadam", *sys.argv[1:]])


if __name__ == "__main__":
    main()
