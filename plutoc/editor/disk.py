"""The files of an app that is being edited: read, noticed when others change them, and saved whole.

A file is saved beside its place and renamed, so that it is the earlier text or the new one at any
time. Nothing is written through a link, and nothing over a change that was not looked at.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path

from plutoc.project.reading import UsageError, decoded, shown, why
from plutoc.source import LARGEST

_ASIDE = ".plutoc-"


class CannotSave(Exception):
    """A file cannot be written. The message is a sentence for a person."""


class ChangedOutside(Exception):
    """A file is not what it was when it was last looked at."""


class Kept:
    """One file, and what was last seen in it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.seen: bytes | None = None
        """What was last read there, or written; None: there was no file."""
        self._mark: tuple[int, ...] | None = None

    def read(self) -> str | None:
        """Read the file afresh; None where there is none; raise `UsageError` if it is no text."""
        data = self.read_bytes()
        return None if data is None else decoded(data, shown(self.path))

    def read_bytes(self) -> bytes | None:
        """Read the file afresh, text or not; None where there is none."""
        self.seen, self._mark = self._now()
        return self.seen

    def is_changed(self) -> bool:
        """Return whether others have changed, made or removed the file since it was last seen."""
        if self._mark == _mark_of(self.path):
            return False
        data, mark = self._now()
        if data == self.seen:
            self._mark = mark
        return data != self.seen

    def save(self, data: bytes | None) -> None:
        """Write the file wholly or not at all; None removes it.

        Raise `ChangedOutside` if others have changed it, else `CannotSave` with the reason.
        """
        try:
            if self.is_changed():
                raise ChangedOutside
            if data == self.seen:
                return
            if data is None:
                self.path.unlink(missing_ok=True)
                mark = None
            else:
                mark = self._replace(data)
        except UsageError as error:
            raise CannotSave(str(error)) from None
        except OSError as error:
            raise CannotSave(f"{shown(self.path)} cannot be written: {why(error)}") from None
        self.seen, self._mark = data, mark

    def _replace(self, data: bytes) -> tuple[int, ...]:
        """Write the file, and return what it is known by: not to be asked when others can have it."""
        mode = None
        with suppress(FileNotFoundError):
            mode = self.path.lstat().st_mode
        if mode is not None and not (mode & 0o222 and os.access(self.path, os.W_OK)):
            # a rename would replace a read-only file, too
            raise CannotSave(f"{shown(self.path)} is read-only and was not changed")
        aside = self.path.with_name(f"{_ASIDE}{os.getpid()}-{self.path.name}")
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0)
        with suppress(FileNotFoundError):
            aside.unlink()  # of an earlier process of the same number, that was killed
        try:
            with open(os.open(aside, flags, 0o666), "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            if mode is not None:
                os.chmod(aside, stat.S_IMODE(mode))
            mark = _mark(aside.lstat())
            os.replace(aside, self.path)
            return mark
        finally:
            with suppress(OSError):
                aside.unlink()

    def _now(self) -> tuple[bytes | None, tuple[int, ...] | None]:
        """Return what is there now; refuse what is no ordinary file, a link before all."""
        mark = _mark_of(self.path)
        if mark is None:
            return None, None
        if not stat.S_ISREG(mark[0]):
            raise UsageError(f"{shown(self.path)} is {_kind(mark[0])}: only a file can be edited")
        flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
        try:
            with open(os.open(self.path, flags), "rb") as file:
                return file.read(LARGEST + 1), mark
        except FileNotFoundError:
            return None, None
        except OSError as error:
            raise UsageError(f"{shown(self.path)} cannot be read: {why(error)}") from None


def _mark_of(path: Path) -> tuple[int, ...] | None:
    """Return what tells whether a file was touched; the first number is its mode."""
    try:
        now = path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise UsageError(f"{shown(path)} cannot be read: {why(error)}") from None
    return _mark(now)


def _mark(now: os.stat_result) -> tuple[int, ...]:
    return now.st_mode, now.st_ino, now.st_size, now.st_mtime_ns


def _kind(mode: int) -> str:
    if stat.S_ISLNK(mode):
        return "a symbolic link"
    return "a folder" if stat.S_ISDIR(mode) else "a pipe, a socket or a device"
