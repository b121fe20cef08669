"""Copies of a journal beside it, made while it is written, for the day on which a disk damages the journal itself."""

from __future__ import annotations

import time
from contextlib import closing, suppress
from pathlib import Path

from .database import connect, found, look_at, why_unsound
from .errors import TROUBLE, JournalError
from .place import beside

KEPT = (".copy", ".copy-before")
"""The endings of the copies: the newest, and the one before."""

EVERY = 600.0
"""Seconds of real time between two copies."""


def copy(path: Path) -> None:
    """Copy a journal; the copy before is kept, too. Raises an error of the database or the disk.

    It reads by a connection of its own, so that what is written meanwhile waits for nothing.
    """
    newest, before = (beside(path, suffix) for suffix in KEPT)
    part = beside(path, ".copy-part")
    part.unlink(missing_ok=True)
    try:
        with (
            closing(connect(path, "mode=ro")) as journal,
            closing(connect(part, "mode=rwc")) as made,
        ):
            journal.backup(made)
            made.execute("PRAGMA journal_mode = DELETE")  # one file, which any program can open
        if newest.exists():
            newest.replace(before)
        part.replace(newest)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def newest_whole(path: Path) -> tuple[Path, str] | None:
    """Return the newest copy of a journal that is whole, and when it was made; None: there is none."""
    for suffix in KEPT:
        file = beside(path, suffix)
        try:
            look_at(file)
            with closing(connect(file, "mode=ro&immutable=1")) as database:
                if why_unsound(database) is not None:
                    continue
                found(file, database)
        except (JournalError, OSError, *TROUBLE):
            continue
        made = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(file.stat().st_mtime))
        return file, made
    return None
