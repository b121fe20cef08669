"""Lock files: one process at a time has the lock, and loses it at its end, however it ends."""

from __future__ import annotations

import fcntl
import os
from contextlib import suppress
from pathlib import Path

from .forked import not_for_children


def take(file: Path) -> int | None:
    """Acquire a lock, and write this process's id into its file; return None if another has it.

    Closing the returned descriptor releases the lock.
    """
    flags = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
    descriptor = os.open(file, flags, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        return None
    not_for_children(descriptor)
    try:
        os.ftruncate(descriptor, 0)
        os.pwrite(descriptor, f"{os.getpid()}\n".encode(), 0)
    except OSError:  # the disk is full: nothing is left of the attempt
        with suppress(OSError):
            file.unlink()
        os.close(descriptor)
        raise
    return descriptor


def is_taken(file: Path) -> bool:
    """Return whether a process has the lock."""
    with suppress(OSError), file.open("rb") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False


def holder(file: Path) -> int | None:
    """Return the id of the process that has the lock; None: it is free, or cannot be read."""
    if is_taken(file):
        with suppress(OSError, ValueError):
            return int(file.read_bytes())
    return None
