# SPDX-License-Identifier: GPL-3.0-or-later
"""Locks of a file that end with their process, however it ends. POSIX locks: children do not inherit them, and shared
file systems know them."""

from __future__ import annotations

import contextlib
import fcntl
import os
import threading
from collections.abc import Iterator
from pathlib import Path

_own: set[str] = set()  # such a lock does not keep threads of one process apart; this does
_change = threading.Condition()


class Taken(Exception):
    """Another process or thread has the lock."""


@contextlib.contextmanager
def locked(file: Path, wait: bool) -> Iterator[None]:
    """The lock of this file while the block runs. wait: until another one ends; else it is Taken."""
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


def taken(file: Path) -> bool:
    """Whether another process has the lock of this file."""
    try:
        handle = os.open(file, os.O_RDWR)
    except FileNotFoundError:
        return False
    try:
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)  # for a moment; who wants it then waits for it
        return False
    except (BlockingIOError, PermissionError):
        return True
    finally:
        os.close(handle)
