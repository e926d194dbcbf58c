# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts Parsl's manager of workers on this machine, and kills it if it does not end after its study has ended.

`python -m macadam.study.manager STUDY SECONDS COMMAND ...` forks a process that watches, and then becomes COMMAND, the
manager. STUDY is the process number of the study. The watcher is needed because a worker that is killed while it holds
the lock of the results' queue makes the manager wait forever for that queue, even after the manager has noticed that
the study is gone. So the manager is killed SECONDS after the study has ended.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path


def start_time_of(process: int) -> str | None:
    """Returns the start time of a process, which distinguishes it from a later process with the same number; None if
    the process has ended."""
    try:
        state, *fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    return None if state == "Z" else fields[18]


def watch(study: int, manager: int, seconds: float) -> None:
    """Returns when the manager, which is the parent of this process, has ended. Kills the manager if it still runs
    `seconds` after the study has ended."""
    since, gone = start_time_of(study), None
    while os.getppid() == manager:
        time.sleep(1)
        if since is not None and start_time_of(study) == since:
            continue
        gone = gone or time.monotonic()
        if time.monotonic() > gone + seconds and os.getppid() == manager:
            os.kill(manager, signal.SIGKILL)


# Forks one process, which runs watch(). This process then becomes the manager, by executing the manager's command.
def main() -> None:
    study, seconds, command = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
    manager = os.getpid()
    if os.fork() == 0:
        watch(study, manager, seconds)
        os._exit(0)
    os.execvp(command[0], command)


if __name__ == "__main__":
    main()
