# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers for the tests of studies: a stand-in for the program macadam, which is quick and logs its runs, and the scene
that it reads."""

from __future__ import annotations

import stat
from pathlib import Path

import report_folders

# The stand-in's result: |E*| in GPa is the scene's delta, the phase angle is ten degrees. Each run logs its start
# and its end in LOG. Delta 13 fails with a message, delta 17 kills the program.
_PROGRAM = """#!/bin/sh
case $1 in
  --version) echo "macadam stand-in VERSION"; exit ;;
  check) exit ;;
esac
value=$(sed -n 's/^delta = //p' "$2" | head -n 1)
value=${value:-1.0}
echo "begin $value" >> "LOG"
WAIT
REAL
case $value in
  13.0) echo "macadam: $2: found 13, expected better luck" >&2; exit 1 ;;
  17.0) kill -9 $$ ;;
esac
sleep PAUSE
printf '{"status": "done", "macadam": "stand-in", "particles": 7, "warnings": [], ' > "$4/summary.json"
printf '"results": [{"frequency_hz": 10.0, "e_star_pa": %se9, "phase_deg": 10.0}]}' "$value" >> "$4/summary.json"
echo "end $value" >> "LOG"
"""
_REAL = 'case $value in *REAL) PROGRAM "$@" && echo "end $value" >> "LOG"; exit ;; esac'


_WAIT = 'case $value in 1.0) ;; *) [ -e "FILE" ] || exec sleep 3600 ;; esac  # until it is killed'


def stand_in(
    folder: Path, pause: float = 0.0, version: str = "1", real: str = "", go: Path | None = None
) -> tuple[str, Path]:
    """Writes the stand-in. Returns its path and the path of its log. real: values that end with this text are computed
    by macadam itself. go: until this file exists, runs with values other than 1 never end."""
    log = folder / "log"
    lines = _REAL.replace("REAL", real).replace("PROGRAM", str(report_folders.PROGRAM)) if real else ""
    text = (
        _PROGRAM.replace("REAL", lines)
        .replace("WAIT", _WAIT.replace("FILE", str(go)) if go else "")
        .replace("LOG", str(log))
        .replace("PAUSE", str(pause))
        .replace("VERSION", version)
    )
    file = folder / f"macadam-{version}"
    file.write_text(text, encoding="utf-8")
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    log.touch()
    return str(file), log


def lines(log: Path, of: str) -> list[float]:
    """Returns the values of all runs that began (of="begin") or ended (of="end"), from the log."""
    return [float(line.split()[1]) for line in log.read_text().splitlines() if line.startswith(of)]


def scene(folder: Path) -> Path:
    """Writes the scene of the 8 mm specimen, in which only the pair M-A has a `delta`, and returns its path."""
    text = report_folders.scene("file").replace('pair = "M-A"\n', 'pair = "M-A"\ndelta = 1.0\n')
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return file
