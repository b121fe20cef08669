"""A journal's file: an SQLite database with what has happened, and where everything stands.

The page `docs/journal.md` says the same for other programs.
"""

from __future__ import annotations

import json
import os
import sqlite3
import stat
import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from msgspec.json import encode

from . import errors
from .errors import TROUBLE
from .facts import Event, events_of, header_of, row_of
from .standing import Row, Standing

APPLICATION = 0x506C7574
"""`Plut`, as SQLite's application id."""

VERSION = 1
"""The version of the format, and of what its events and rows mean; a reader refuses any other."""

TABLES = {
    "event": """CREATE TABLE event (
  seq INTEGER PRIMARY KEY, -- 0 is the header; then no number is left out
  epoch INTEGER NOT NULL, -- how often the journal had been opened
  wall INTEGER NOT NULL, -- milliseconds since 1970
  text TEXT NOT NULL -- the events of one instant: a JSON list of objects
)""",
    "mission": """CREATE TABLE mission (
  name TEXT PRIMARY KEY,
  text TEXT NOT NULL -- where it stands: a JSON object
) WITHOUT ROWID""",
    "trip": """CREATE TABLE trip (
  mission TEXT NOT NULL,
  number INTEGER NOT NULL, -- among all trips that the mission has ever had
  text TEXT NOT NULL,
  PRIMARY KEY (mission, number)
) WITHOUT ROWID""",
    "drone": """CREATE TABLE drone (
  id TEXT PRIMARY KEY,
  text TEXT NOT NULL
) WITHOUT ROWID""",
    "result": """CREATE TABLE result (
  number INTEGER PRIMARY KEY, -- in the order in which actions were done
  text TEXT NOT NULL
)""",
    "happening": """CREATE TABLE happening (
  id TEXT PRIMARY KEY, -- of an event that was raised
  text TEXT NOT NULL
) WITHOUT ROWID""",
    "app": """CREATE TABLE app (
  fact TEXT PRIMARY KEY, -- epoch, clock, stopped, commands, joined, kept
  text TEXT NOT NULL
) WITHOUT ROWID""",
}

PUT = {
    "mission": "INSERT OR REPLACE INTO mission VALUES (?, ?)",
    "trip": "INSERT OR REPLACE INTO trip VALUES (?, ?, ?)",
    "drone": "INSERT OR REPLACE INTO drone VALUES (?, ?)",
    "result": "INSERT OR REPLACE INTO result VALUES (?, ?)",
    "happening": "INSERT OR REPLACE INTO happening VALUES (?, ?)",
    "app": "INSERT OR REPLACE INTO app VALUES (?, ?)",
}
"""How a row is put into each table in place of the one with its key."""

LARGEST_TEXT = 128 * 1024 * 1024
"""Bytes of one text, so that no file has its reader take more memory than there is."""

LATEST_WALL = 10**13
"""The largest plausible time, in milliseconds since 1970."""

PATIENCE = 5.0
"""Seconds that a commit waits for another program that reads the file."""

_MAGIC = b"SQLite format 3\0"
_SIZE_OF_HEAD = 100
_SANE = 1000
"""The largest plausible version: a larger one is damage."""


class Instant(NamedTuple):
    """The events of one instant."""

    seq: int
    wall: float
    """When it was written, in seconds since 1970."""
    text: str
    """A JSON list of events."""
    epoch: int
    """How often the journal had been opened by then."""

    @property
    def events(self) -> list[Event]:
        """Its events; raises `ValueError` if the text is no list of them."""
        return events_of(self.text)


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """The facts about a journal."""

    header: Event
    seq: int
    """The number of the last instant."""
    epoch: int


def connect(path: Path, how: str) -> sqlite3.Connection:
    """Open a database with these URI parameters, such as `mode=ro`."""
    database = sqlite3.connect(
        f"{path.absolute().as_uri()}?{how}",
        uri=True,
        isolation_level=None,
        check_same_thread=False,
        timeout=PATIENCE,
    )
    database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST_TEXT)
    database.execute("PRAGMA trusted_schema = OFF")
    database.execute("PRAGMA cell_size_check = ON")  # what is damaged is noticed early
    return database


def look_at(path: Path) -> None:
    """Raise unless a file is a journal, by its first bytes; nothing is changed."""
    try:
        kind = path.stat()
        if stat.S_ISDIR(kind.st_mode):
            raise errors.is_folder(path)
        if not stat.S_ISREG(kind.st_mode):
            raise errors.no_file(path)
        with path.open("rb") as file:
            start = file.read(_SIZE_OF_HEAD)
    except FileNotFoundError:
        raise errors.missing(path) from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise errors.cannot_open(path, error) from None
    if not start:
        raise errors.empty(path)
    if len(start) < _SIZE_OF_HEAD:
        raise errors.no_journal(path)
    version, application = struct.unpack_from(">60xI4xI", start)
    if application != APPLICATION:
        raise errors.no_journal(path)
    if version != VERSION and 0 < version < _SANE:
        raise errors.of_another_version(path, version, VERSION)
    if not start.startswith(_MAGIC) or version != VERSION:
        raise errors.damaged(path, errors.no_beginning())


def found(path: Path, database: sqlite3.Connection) -> Found:
    """Return the facts about a journal, or raise a `JournalError`."""
    try:
        tables = {str(sql) for (sql,) in database.execute("SELECT sql FROM sqlite_schema") if sql}
        if tables != set(TABLES.values()):
            raise errors.damaged(path, errors.other_tables())
        first = database.execute("SELECT text FROM event WHERE seq = 0").fetchone()
        ((last,),) = database.execute("SELECT max(seq) FROM event")
        epoch = database.execute("SELECT text FROM app WHERE fact = 'epoch'").fetchone()
        header = header_of(first[0])
        known = row_of("app", ("epoch",), epoch[0])["is"]
        if type(last) is not int:
            raise ValueError
        return Found(header=header, seq=last, epoch=known)
    except (LookupError, TypeError, ValueError):
        raise errors.damaged(path, errors.no_header()) from None
    except TROUBLE as error:
        raise errors.refused(path, error) from None


def why_unsound(database: sqlite3.Connection) -> str | None:
    """Return what is wrong with the pages of a database, by SQLite's own check; None: nothing."""
    try:
        ((first,),) = database.execute("PRAGMA quick_check(1)")
    except TROUBLE as error:
        return errors.why(error)
    return None if first == "ok" else str(first)


def put_rows(database: sqlite3.Connection, rows: Iterable[Row]) -> None:
    """Put rows in place of those with the same keys; within a transaction."""
    by_table: dict[str, list[tuple[object, ...]]] = {}
    for table, key, row in rows:
        by_table.setdefault(table, []).append((*key, written(row)))
    for table, found in by_table.items():
        database.executemany(PUT[table], found)


def written(row: Mapping[str, Any]) -> str:
    """Return what stands in a row of a table, for `row_of` to read."""
    try:
        return encode(row).decode()
    except (OverflowError, TypeError, ValueError):  # more than 64 bits, or half of a character
        return json.dumps(row, ensure_ascii=False).encode(errors="replace").decode()


def standing_in(path: Path, database: sqlite3.Connection) -> Standing:
    """Return where everything stands; raise a `JournalError` if that is not as this version writes it."""
    try:
        last = "SELECT text FROM event WHERE text != '[]' ORDER BY seq DESC LIMIT 1"
        ((text,),) = database.execute(last)
        time = float(events_of(text)[-1]["t"])
        return Standing(_rows_in(database), time)
    except ValueError as error:
        raise errors.strange(path, str(error)) from None
    except (LookupError, TypeError) as error:
        raise errors.strange(path, errors.odd_rows(error)) from None
    except TROUBLE as error:
        raise errors.refused(path, error) from None


def _rows_in(database: sqlite3.Connection) -> Iterator[Row]:
    for table in PUT:
        # results in their order, and missions before their trips
        for *key, text in database.execute(f"SELECT * FROM {table} ORDER BY 1"):
            yield table, tuple(key), row_of(table, key, text)


def sync_folder(path: Path) -> None:
    """Sync a folder, so that a file's name survives a power failure."""
    descriptor = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
