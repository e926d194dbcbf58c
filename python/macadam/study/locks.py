# SPDX-License-Identifier: GPL-3.0-or-later
"""File locks that are released when their process ends, in whatever way. They are POSIX locks, which child processes do
not inherit and which work on shared file systems."""

from __future__ import annotations

import contextlib
import fcntl
import os
import threading
from collections.abc import Iterator
from pathlib import Path

# files that this process has locked; needed because a POSIX lock does not exclude other threads of the same process
_own: set[str] = set()
_change = threading.Condition()  # guards _own


class Taken(Exception):
    """Another process or thread has the lock."""


@contextlib.contextmanager
def locked(file: Path, wait: bool) -> Iterator[None]:
    """Holds the lock of this file while the block runs. wait: if the lock is held elsewhere, wait for it; otherwise
    raise Taken."""
    name = str(file.resolve())
    with _change:
        while name in _own:
            if not wait:
                raise Taken(name)
            _change.wait()
        _own.add(name)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(file, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            try:
                fcntl.lockf(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
            except (BlockingIOError, PermissionError):
                raise Taken(name) from None
            yield
        finally:
            os.close(handle)
    finally:
        with _change:
            _own.discard(name)
            _change.notify_all()


def is_locked(file: Path) -> bool:
    """Whether another process holds the lock of this file."""
    try:
        handle = os.open(file, os.O_RDWR)
    except FileNotFoundError:
        return False
    try:
        # this lock is held until the handle is closed below; other processes wait until then
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return False
    except (BlockingIOError, PermissionError):
        return True
    finally:
        os.close(handle)
