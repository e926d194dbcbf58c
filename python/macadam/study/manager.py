# SPDX-License-Identifier: GPL-3.0-or-later
"""Begins Parsl's manager of workers on this machine, and ends it where it cannot do so itself.

`python -m macadam.study.manager STUDY SECONDS COMMAND ...` becomes the command, and leaves a process that watches it. A
worker that is killed while it holds the queue of results lets the manager wait for that queue for ever, also when it
has missed the process STUDY. So, once that is gone, the manager has so many seconds.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path


def begun(process: int) -> str | None:
    """When a process began, which tells it from a later one of its number; nothing where it has ended."""
    try:
        state, *fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return None if state == "Z" else fields[18]


def watch(study: int, manager: int, seconds: float) -> None:
    """Returns when the manager, of which this process is a child, has ended; ends it where the study is gone."""
    since, gone = begun(study), None
    while os.getppid() == manager:
        time.sleep(1)
        if since is not None and begun(study) == since:
            continue
        gone = gone or time.monotonic()
        if time.monotonic() > gone + seconds and os.getppid() == manager:
            os.kill(manager, signal.SIGKILL)


def main() -> None:
    study, seconds, command = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
    manager = os.getpid()
    if os.fork() == 0:
        watch(study, manager, seconds)
        os._exit(0)
    os.execvp(command[0], command)


if __name__ == "__main__":
    main()
