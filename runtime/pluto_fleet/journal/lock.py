"""Exclusive access to a journal: the lock ends with its process, however that ends."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path

from ..process import locks
from . import errors
from .place import beside

_TRIES, _PAUSE = 3, 0.02


class Lock:
    """The right to write a journal; its holder's process id is in the file `J.lock`."""

    def __init__(self, path: Path, descriptor: int) -> None:
        self._file, self._descriptor = beside(path, ".lock"), descriptor
        self._process = os.getpid()

    @classmethod
    def take(cls, path: Path) -> Lock:
        """Acquire it, or raise a `JournalError` that names its holder."""
        file, tries = beside(path, ".lock"), _TRIES
        while True:
            descriptor = locks.take(file)
            if descriptor is None:
                tries -= 1
                if not tries:
                    raise errors.in_use(path, locks.holder(file))
                time.sleep(_PAUSE)  # another process may be just checking it
            elif _is(file, descriptor):
                return cls(path, descriptor)
            else:
                os.close(descriptor)  # its last holder removed the file while we waited

    def release(self) -> None:
        """Release it; the file is removed while no other process can have acquired it."""
        if os.getpid() != self._process:
            return  # a forked child must not release it
        with suppress(OSError):
            self._file.unlink()
        os.close(self._descriptor)


def holder(path: Path) -> int | None:
    """Return the process that writes this journal, or None."""
    return locks.holder(beside(path, ".lock"))


def _is(file: Path, descriptor: int) -> bool:
    try:
        there, ours = file.stat(), os.fstat(descriptor)
    except FileNotFoundError:
        return False
    return (there.st_dev, there.st_ino) == (ours.st_dev, ours.st_ino)
