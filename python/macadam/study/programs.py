# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs programs from threads of this process and keeps a list of them, so that they can be ended when the study is
stopped."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import threading
import time
from typing import Any

GRACE = 2.0  # seconds that a program has to write its checkpoint after SIGTERM; then it is killed
_running: dict[str, set[subprocess.Popen]] = {}  # running programs by folder of the study
_stopped: set[str] = set()  # folders of studies that were stopped
_change = threading.Lock()  # guards _running and _stopped


def error_line(message: str) -> str:
    """Returns the line of the program's messages that says what is wrong: the first one that begins with `macadam:` and
    is not a warning; without such a line the last line, or "" if the message is empty. The lines after an error are hints."""
    lines = message.strip().splitlines() or [""]
    errors = (line for line in lines if line.startswith("macadam:") and not line.startswith("macadam: warning:"))
    return next(errors, lines[-1])


def start(folder: str) -> None:
    """Allows programs of the study in this folder to start, also after an earlier stop()."""
    with _change:
        _stopped.discard(folder)


def stopped(folder: str) -> bool:
    """Whether the study in this folder was stopped, so that no program may start."""
    return folder in _stopped


def stop(folder: str) -> None:
    """Ends all programs of a study and prevents new ones from starting. Returns when they have ended."""
    with _change:
        _stopped.add(folder)
        left = list(_running.get(folder, ()))
    for program in left:
        _signal(program, signal.SIGTERM)
    end = time.monotonic() + GRACE
    for program in left:
        with contextlib.suppress(subprocess.TimeoutExpired):
            program.wait(max(0.0, end - time.monotonic()))
        _signal(program, signal.SIGKILL)


def _signal(program: subprocess.Popen, number: int) -> None:
    """Sends a signal to a program and its children; does nothing if they have ended."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(program.pid, number)


def run(folder: str, line: list[str], **how: Any) -> tuple[int, str]:
    """Runs a program for the study in `folder`. Returns its exit code (below 0: a signal) and its standard error."""
    with _change:
        if folder in _stopped:
            return -signal.SIGTERM, ""
        # The program gets its own session. A signal from the terminal then reaches only the study, which
        # decides what to do.
        program = subprocess.Popen(
            line, stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True, **how
        )
        _running.setdefault(folder, set()).add(program)
    try:
        _, said = program.communicate()
    finally:
        with _change:
            _running[folder].discard(program)
    return program.returncode, said
