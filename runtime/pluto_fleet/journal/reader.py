"""Reading a journal without writing it, up to the first damaged row.

This works beside a running app, on a read-only disk, and with a damaged journal.
"""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from collections.abc import Generator, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from . import errors
from .database import (
    Found,
    Row,
    connect,
    found,
    last_row,
    look_at,
    newest_snapshot,
    row_of,
)
from .errors import TROUBLE, Damaged
from .facts import Event
from .lock import holder
from .place import beside
from .salvage import salvage

_AT_ONCE = 100
"""Rows that are read at once: more would not fit into the processor's cache."""

_LARGE = 8 * 1024 * 1024
"""Bytes of rows after which no more are read at once."""


Chunks = Generator[list[Row], None, str | None]
"""Rows in order; at the end, why further ones cannot be read, if so."""


class Read:
    """A snapshot and the rows after it; iterate over `rows` or `events`, one of them and once."""

    def __init__(
        self,
        chunks: Chunks,
        snapshot: str | None,
        after: int,
        *,
        written: float | None = None,
        warnings: Sequence[str] = (),
    ) -> None:
        self.snapshot, self.after = snapshot, after
        """The snapshot, and the number of the last row that it covers."""
        self.warnings = tuple(warnings)
        """Harmless damage."""
        self.damaged: str | None = None
        """Why nothing more can be read, after all readable rows; None: that was everything."""
        self.written = written
        """When the last row read was written, in seconds since 1970."""
        self._chunks = chunks

    @property
    def rows(self) -> Iterator[Row]:
        """The rows in order, without damaged ones."""
        for chunk in self._sound():
            yield from chunk

    @property
    def events(self) -> Iterator[Event]:
        """The events of all rows, in order."""
        for row in self.rows:
            yield from row.events

    def _sound(self) -> Iterator[list[Row]]:
        while True:
            try:
                chunk = next(self._chunks)
            except StopIteration as end:
                self.damaged = end.value
                return
            if chunk:
                self.written = chunk[-1].wall
                yield chunk


def since_snapshot(database: sqlite3.Connection, last: int) -> Read:
    """Read what is needed to resume: the newest sound snapshot, and the rows after it."""
    newest = newest_snapshot(database)
    rows = _rows(database, newest.seq + 1, last)
    return Read(rows, newest.text, newest.seq, written=newest.wall, warnings=newest.damaged)


def rows_between(database: sqlite3.Connection, first: int, last: int) -> Read:
    """Read some of the rows; the header is row 0."""
    return Read(_rows(database, first, last), None, first - 1)


def _rows(database: sqlite3.Connection, seq: int, last: int) -> Chunks:
    while seq <= last:
        # each chunk is a query of its own, so that a slow reader does not block a writer's checkpoints
        rows, until, trouble = _fetched(database, seq, min(last, seq + _AT_ONCE - 1))
        sound: list[Row] = []
        for unchecked in rows:
            row = row_of(unchecked)
            if row is None or row.seq != seq:
                yield sound
                found = unchecked[0]
                missing = errors.missing_rows(seq, found - 1, last) if found > seq else None
                return missing or errors.unsound_row(seq, last)
            sound.append(row)
            seq += 1
        yield sound
        if trouble is not None:
            return errors.unreadable_from(seq, last, errors.why(trouble))
        if seq <= until:
            return errors.missing_rows(seq, until, last)
    return None


def _fetched(
    database: sqlite3.Connection, first: int, last: int
) -> tuple[list[tuple[Any, ...]], int, Exception | None]:
    """Return unchecked rows up to a number, and the error that keeps the database from returning more."""
    rows: list[tuple[Any, ...]] = []
    size = 0
    try:
        for row in database.execute(_QUERY, (first, last)):
            rows.append(row)
            size += len(row[3]) if isinstance(row[3], bytes) else 0
            if size >= _LARGE:
                return rows, row[0], None
    except TROUBLE as error:
        return rows, last, error
    return rows, last, None


_QUERY = (
    "SELECT seq, epoch, wall, text, checksum FROM journal WHERE seq BETWEEN ? AND ? ORDER BY seq"
)


class Reader:
    """A journal that is open for reading."""

    def __init__(self, path: Path, *, follows: bool = False, locked: bool = False) -> None:
        self.damaged: str | None = None
        """What is wrong with it, after all readable rows; None: nothing."""
        self.torn: str | None = None
        """What is wrong with the last commit, which is left out; None: nothing."""
        self.header: Event = {}
        """The first event, as far as that can be read."""
        self._path, self._seen, self._follows = path, -1, follows
        self._copy: tempfile.TemporaryDirectory[str] | None = None
        self._database: sqlite3.Connection | None = None
        try:
            look_at(path)
            self._database, state = self._opened()
            self.header = state.header
            if locked or holder(path) is None:  # a log that is being written is not always complete
                self.torn = state.torn
                if state.lost:
                    self.damaged = str(errors.damaged(path, errors.lost_log()))
        except Damaged as error:
            self.damaged = str(error)

    def rows(self) -> Iterator[Row]:
        """Yield all sound rows, the header first."""
        yield from self.more()
        if self.damaged is not None:
            for row in salvage(self._path, self._seen):
                self._seen = row.seq
                yield row

    def more(self) -> Iterator[Row]:
        """Yield the rows that were added since the last one."""
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
        """Close it."""
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
            return _opened(self._path, "mode=ro&immutable=1")  # creates no file beside it
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
            self._copy.cleanup()
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
