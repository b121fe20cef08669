"""Reading a journal without writing it: beside a running app, and on a disk that may only be read."""

from __future__ import annotations

import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path

from . import copies, errors
from .database import (
    LATEST_WALL,
    Found,
    Instant,
    connect,
    found,
    look_at,
    standing_in,
)
from .errors import TROUBLE, Damaged
from .facts import Event, check
from .lock import holder
from .place import beside
from .standing import Standing

_AT_ONCE = 100
"""Instants that are read at once: each time by a query of its own, so that a slow reader does not
block a writer's checkpoints."""


class Reader:
    """A journal that is open for reading; raises a `JournalError` if it is none."""

    def __init__(self, path: Path, *, follows: bool = False) -> None:
        self.path = path
        self.damaged: str | None = None
        """Why no more can be read, after all that could be; None: that was everything."""
        self.header: Event = {}
        """The first event, as far as that can be read."""
        self._seen = -1
        self._follows = follows
        self._copy: tempfile.TemporaryDirectory[str] | None = None
        self._database: sqlite3.Connection | None = None
        try:
            look_at(path)
            self._database, state = self._opened()
            self.header = state.header
        except Damaged as error:
            self._trouble(error.what)

    def instants(self) -> Iterator[Instant]:
        """Yield the events of each instant since the last one, the header first."""
        database = self._database
        if database is None:
            return
        try:
            ((last,),) = database.execute("SELECT max(seq) FROM event")
            while last is not None and self._seen < last:
                until = min(last, self._seen + _AT_ONCE)
                some = database.execute(_QUERY, (self._seen + 1, until)).fetchall()
                for seq, epoch, wall, text in some:
                    if seq != self._seen + 1 or not _is_sound(epoch, wall, text):
                        self._trouble(errors.missing_instants(self._seen + 1))
                        return
                    self._seen = seq
                    yield Instant(seq, wall / 1000, text, epoch)
                if self._seen < until:
                    self._trouble(errors.missing_instants(self._seen + 1))
                    return
        except TROUBLE as error:
            self._trouble(errors.why(error))

    def events(self) -> Iterator[tuple[Instant, Event]]:
        """Yield the events, each with its instant; raise a `JournalError` at one that is not as it must be."""
        for instant in self.instants():
            try:
                for event in instant.events:
                    check(event)
                    yield instant, event
            except ValueError as error:
                raise errors.strange(self.path, errors.unfit(instant.seq, error)) from None

    def standing(self) -> Standing:
        """Return where everything stands; raise `Damaged` if that cannot be read."""
        if self._database is None or self.damaged is not None:
            raise Damaged(self.path, self.damaged or "", copies.newest_whole(self.path))
        return standing_in(self.path, self._database)

    def close(self) -> None:
        """Close it."""
        if self._database is not None:
            self._database.close()
        if self._copy is not None:
            self._copy.cleanup()

    def _trouble(self, what: str) -> None:
        if self.damaged is None:
            self.damaged = what

    def _opened(self) -> tuple[sqlite3.Connection, Found]:
        try:
            logged = beside(self.path, "-wal").stat().st_size > 0
        except OSError:
            logged = False
        at_rest = not logged and holder(self.path) is None
        if at_rest and not self._follows:
            return _opened(self.path, "mode=ro&immutable=1")  # creates no file beside it
        try:
            return _opened(self.path, "mode=ro")
        except Damaged:
            raise
        except errors.JournalError:
            # SQLite wants to write beside a database that has a log, if only to read it
            if at_rest:
                return _opened(self.path, "mode=ro&immutable=1")
            return _opened(self._copied(), "mode=ro")

    def _copied(self) -> Path:
        self._copy = tempfile.TemporaryDirectory(prefix="pluto-journal-")
        copied = Path(self._copy.name) / "journal"
        try:
            for suffix in ("", "-wal"):
                shutil.copyfile(beside(self.path, suffix), beside(copied, suffix))
        except OSError as error:
            self._copy.cleanup()
            raise errors.cannot_open(self.path, error) from None
        return copied


_QUERY = "SELECT seq, epoch, wall, text FROM event WHERE seq BETWEEN ? AND ? ORDER BY seq"


def _is_sound(epoch: object, wall: object, text: object) -> bool:
    return (
        type(epoch) is int and type(wall) is int and 0 <= wall <= LATEST_WALL and type(text) is str
    )


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


def standing_of(path: Path) -> Standing:
    """Return where everything stands, by a journal that may be being written."""
    with closing(Reader(path)) as reader:
        return reader.standing()
