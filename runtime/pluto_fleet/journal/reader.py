"""Reads a journal without writing it.

Beside a running app, on a disk that may only be read, and one that is damaged: whatever is readable.
"""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from . import errors
from .database import Found, connect, found, last_row, look_at
from .errors import TROUBLE, Damaged
from .lock import holder
from .place import beside
from .reading import Row, rows_between
from .salvage import salvage


class Reader:
    """A journal that is open for reading; close it when nothing more is wanted."""

    def __init__(self, path: Path, *, follows: bool = False, locked: bool = False) -> None:
        self.damaged: str | None = None
        """What is wrong with it, once all rows that can be read were; None: nothing is."""
        self.torn: str | None = None
        """What is wrong with what was written last and is left out; None: nothing is."""
        self._path, self._seen, self._follows = path, -1, follows
        self._copy: tempfile.TemporaryDirectory[str] | None = None
        self._database: sqlite3.Connection | None = None
        try:
            look_at(path)
            self._database, state = self._opened()
            if locked or holder(path) is None:  # a log that grows is not whole at every moment
                self.torn = state.torn
                if state.lost:
                    self.damaged = str(errors.damaged(path, errors.lost_log()))
        except Damaged as error:
            self.damaged = str(error)

    def rows(self) -> Iterator[Row]:
        """Yield all rows that are what was written, the header first; of damaged ones none."""
        yield from self.more()
        if self.damaged is not None:
            for row in salvage(self._path, self._seen):
                self._seen = row.seq
                yield row

    def more(self) -> Iterator[Row]:
        """Yield the rows that have come since the last one."""
        database = self._database
        if database is None:
            return
        try:
            last = last_row(database)
        except TROUBLE as error:
            self._trouble(errors.why(error))
            return
        read = rows_between(database, self._seen + 1, last)
        for row in read.rows:
            self._seen = row.seq
            yield row
        if read.damaged is not None:
            self._trouble(read.damaged)

    def close(self) -> None:
        """Let go of it."""
        if self._database is not None:
            self._database.close()
        if self._copy is not None:
            self._copy.cleanup()

    def _trouble(self, what: str) -> None:
        if self.damaged is None:
            self.damaged = str(errors.damaged(self._path, what))

    def _opened(self) -> tuple[sqlite3.Connection, Found]:
        try:
            logged = beside(self._path, "-wal").stat().st_size > 0
        except OSError:
            logged = False
        at_rest = not logged and holder(self._path) is None
        if at_rest and not self._follows:
            return _opened(self._path, "mode=ro&immutable=1")  # it leaves nothing beside the file
        try:
            return _opened(self._path, "mode=ro")
        except Damaged:
            raise
        except errors.JournalError:
            # SQLite wants to write beside a database that has a log, if only to read it
            if at_rest:
                return _opened(self._path, "mode=ro&immutable=1")
            return _opened(self._copied(), "mode=ro")

    def _copied(self) -> Path:
        self._copy = tempfile.TemporaryDirectory(prefix="pluto-journal-")
        copy = Path(self._copy.name) / "journal"
        try:
            for suffix in ("", "-wal"):
                shutil.copyfile(beside(self._path, suffix), beside(copy, suffix))
        except OSError as error:
            raise errors.cannot_open(self._path, error) from None
        return copy


def _opened(path: Path, how: str) -> tuple[sqlite3.Connection, Found]:
    try:
        database = connect(path, how)
    except TROUBLE as error:
        raise errors.refused(path, error) from None
    try:
        return database, found(path, database)
    except BaseException:
        with suppress(*TROUBLE):
            database.close()
        raise
