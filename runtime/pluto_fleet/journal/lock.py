"""One process a journal: the lock goes with the process, however that ends."""

from __future__ import annotations

import fcntl
import os
import time
from contextlib import suppress
from pathlib import Path

from ..process.forked import not_for_children
from . import errors
from .place import beside

_TRIES, _PAUSE = 3, 0.02


class Lock:
    """The right to write a journal; whoever holds it is named in the file `J.lock`."""

    def __init__(self, path: Path, descriptor: int) -> None:
        self._file, self._descriptor = beside(path, ".lock"), descriptor
        self._process = os.getpid()
        not_for_children(descriptor)

    @classmethod
    def take(cls, path: Path) -> Lock:
        """Take it, or raise a `JournalError` that names who has it."""
        file, tries = beside(path, ".lock"), _TRIES
        while True:
            descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
            if not _locked(descriptor):
                pid = _pid(descriptor)
                os.close(descriptor)
                tries -= 1
                if not tries:
                    raise errors.in_use(path, pid)
                time.sleep(_PAUSE)  # perhaps somebody only asks who has it
                continue
            if _is(file, descriptor):
                break
            os.close(descriptor)  # whoever had it took the file away while we waited for it
        lock = cls(path, descriptor)
        try:
            os.ftruncate(descriptor, 0)
            os.pwrite(descriptor, f"{os.getpid()}\n".encode(), 0)
        except OSError:
            lock.release()
            raise
        return lock

    def release(self) -> None:
        """Let others have it; the file goes while nobody else can have taken it."""
        if os.getpid() != self._process:
            return  # it is not a forked child's to release
        with suppress(OSError):
            self._file.unlink()
        os.close(self._descriptor)


def holder(path: Path) -> int | None:
    """Return the process that writes this journal; None: nobody does."""
    try:
        descriptor = os.open(beside(path, ".lock"), os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return None
    try:
        return None if _locked(descriptor) else _pid(descriptor)
    finally:
        os.close(descriptor)


def _locked(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _is(file: Path, descriptor: int) -> bool:
    try:
        there, ours = file.stat(), os.fstat(descriptor)
    except FileNotFoundError:
        return False
    return (there.st_dev, there.st_ino) == (ours.st_dev, ours.st_ino)


def _pid(descriptor: int) -> int | None:
    text = os.pread(descriptor, 32, 0).strip()
    return int(text) if text.isdigit() else None
