"""What is read of a journal: rows in order, up to the first that is not what was written."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Generator, Iterator, Sequence
from typing import Any, NamedTuple

from . import errors
from .database import is_sound, newest_snapshot
from .errors import TROUBLE

_AT_ONCE = 100
"""Rows that are read together: more would no longer fit into the processor's cache."""


class Row(NamedTuple):
    """The events of one instant."""

    seq: int
    wall: float
    """Seconds since 1970: when it was written."""
    text: str
    """A JSON list of events."""
    epoch: int
    """How often the journal had been opened by then."""


Chunks = Generator[list[Row], None, str | None]
"""Rows in order; at the end, why there are no more although there should be."""


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
        """The state after the row of this number, which is the last that is not read."""
        self.warnings = tuple(warnings)
        """What is damaged and does not matter."""
        self.damaged: str | None = None
        """Why nothing more can be read, once all that can be was; None: that was everything."""
        self.written = written
        """When what was read last was written, in seconds since 1970."""
        self._chunks = chunks

    @property
    def rows(self) -> Iterator[Row]:
        """The rows, in order; never a wrong one."""
        for chunk in self._sound():
            yield from chunk

    @property
    def events(self) -> Iterator[dict[str, Any]]:
        """The events of all rows, in order."""
        for chunk in self._sound():
            for events in json.loads("[" + ",".join([row.text for row in chunk]) + "]"):
                yield from events

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
    """Read what is needed to go on: the newest sound snapshot, and the rows after it."""
    newest = newest_snapshot(database)
    rows = _rows(database, newest.seq + 1, last)
    return Read(rows, newest.text, newest.seq, written=newest.wall, warnings=newest.damaged)


def rows_between(database: sqlite3.Connection, first: int, last: int) -> Read:
    """Read some of the rows; the header is row 0."""
    return Read(_rows(database, first, last), None, first - 1)


def _rows(database: sqlite3.Connection, seq: int, last: int) -> Chunks:
    while seq <= last:
        # each chunk is a query of its own: who waits in between keeps no writer from tidying up
        until = min(last, seq + _AT_ONCE - 1)
        rows, trouble = _fetched(database, seq, until)
        sound: list[Row] = []
        for row in rows:
            if row[0] != seq or not is_sound(row):
                yield sound
                missing = errors.missing_rows(seq, row[0] - 1, last) if row[0] > seq else None
                return missing or errors.unsound_row(seq, last)
            sound.append(Row(seq, row[2] / 1000, row[3].decode(), row[1]))
            seq += 1
        yield sound
        if trouble is not None:
            return errors.unreadable_from(seq, last, errors.why(trouble))
        if seq <= until:
            return errors.missing_rows(seq, until, last)
    return None


def _fetched(
    database: sqlite3.Connection, first: int, last: int
) -> tuple[list[tuple[Any, ...]], Exception | None]:
    """Return rows as they are, and what keeps the database from giving more."""
    rows: list[tuple[Any, ...]] = []
    try:
        rows.extend(database.execute(_QUERY, (first, last)))
    except TROUBLE as error:
        return rows, error
    return rows, None


_QUERY = (
    "SELECT seq, epoch, wall, text, checksum FROM journal WHERE seq BETWEEN ? AND ? ORDER BY seq"
)
