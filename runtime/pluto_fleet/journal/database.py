"""A journal's file: three tables with a checksum in every row, which is checked before a row is used.

The page `docs/journal.md` says the same for other programs.
"""

from __future__ import annotations

import os
import sqlite3
import stat
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeGuard
from zlib import crc32

from . import errors, wal
from .errors import TROUBLE
from .facts import Event, events_of, header_of

APPLICATION = 0x506C7574
"""`Plut`, as SQLite's application id."""

VERSION = 1
"""The version of the format, and of what its events mean; a reader refuses any other."""

TABLES = {
    "journal": """CREATE TABLE journal (
  seq INTEGER PRIMARY KEY, -- 0 is the header; then no number is left out
  epoch INTEGER NOT NULL, -- how often the journal had been opened
  wall INTEGER NOT NULL, -- milliseconds since 1970
  text TEXT NOT NULL, -- the events of one instant: a JSON list of objects
  checksum INTEGER NOT NULL
)""",
    "snapshot": """CREATE TABLE snapshot (
  seq INTEGER PRIMARY KEY, -- it stands for all rows up to this one
  epoch INTEGER NOT NULL,
  wall INTEGER NOT NULL,
  text TEXT NOT NULL,
  checksum INTEGER NOT NULL
)""",
    "tip": """CREATE TABLE tip (
  id INTEGER PRIMARY KEY, -- 0: there is one row
  seq INTEGER NOT NULL, -- of the journal's last row
  epoch INTEGER NOT NULL,
  checksum INTEGER NOT NULL
)""",
}


def row_checksum(seq: object, epoch: object, wall: object, text: bytes) -> int:
    """Return the checksum of a row: of its numbers and its text."""
    return crc32(text, crc32(f"journal {seq} {epoch} {wall} ".encode()))


def snapshot_checksum(seq: object, epoch: object, wall: object, text: bytes) -> int:
    """Return the checksum of a snapshot."""
    return crc32(text, crc32(f"snapshot {seq} {epoch} {wall} ".encode()))


def tip_checksum(seq: object, epoch: object) -> int:
    """Return the checksum of the tip, without which the last rows could be gone unnoticed."""
    return crc32(f"tip {seq} {epoch} ".encode())


LARGEST_TEXT = 128 * 1024 * 1024
"""Bytes of one text, so that no file has its reader take more memory than there is."""

LATEST_WALL = 10**13
MOST = 2**53
"""The largest plausible time, in milliseconds since 1970, and the largest plausible other number."""

PATIENCE = 5.0
"""Seconds that a commit waits for another program that reads the file."""

_MAGIC = b"SQLite format 3\0"
_LOOKED_AT, _SIZE_OF_HEAD = 4096, 100
_SANE = 1000
"""The largest plausible version: a larger one is damage."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """The facts about a journal."""

    header: Event
    seq: int
    """The number of the last row."""
    epoch: int
    torn: str | None
    """What is wrong with the last commit, if it is torn: it is left out."""
    lost: bool
    """Whether later rows exist that cannot be read."""


class Row(NamedTuple):
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


class Snapshot(NamedTuple):
    """The state after the rows up to one."""

    text: str | None
    """None: there is none."""
    seq: int
    wall: float | None
    """When it was made."""
    damaged: tuple[str, ...]
    """What is wrong with newer snapshots."""


def connect(path: Path, how: str) -> sqlite3.Connection:
    """Open a database with these URI parameters, such as `mode=ro`; texts come as bytes."""
    database = sqlite3.connect(
        f"{path.absolute().as_uri()}?{how}",
        uri=True,
        isolation_level=None,
        check_same_thread=False,
        timeout=PATIENCE,
    )
    database.text_factory = bytes
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
            start = file.read(_LOOKED_AT)
    except FileNotFoundError:
        raise errors.missing(path) from None
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise errors.cannot_open(path, error) from None
    if not start:
        raise errors.empty(path)
    if len(start) < _SIZE_OF_HEAD:
        raise errors.no_journal(path)
    version, application = struct.unpack_from(">60xI4xI", start)
    if application != APPLICATION and TABLES["journal"].encode() not in start:
        raise errors.no_journal(path)
    if version != VERSION and 0 < version < _SANE:
        raise errors.of_another_version(path, version, VERSION)
    if not start.startswith(_MAGIC) or version != VERSION or application != APPLICATION:
        raise errors.damaged(path, errors.no_beginning())


def found(path: Path, database: sqlite3.Connection) -> Found:
    """Return the facts about a journal, or raise a `JournalError`; its rows are not checked here."""
    try:
        if _schema(database) != set(TABLES.values()):
            raise errors.damaged(path, errors.other_tables())
        header = _header(database)
        seq, epoch = _tip(database)
    except TROUBLE as error:
        raise errors.refused(path, error) from None
    if header is None:
        raise errors.damaged(path, errors.no_header())
    rest = wal.rest(path)
    torn = errors.torn_log() if rest is wal.Rest.TORN else None
    last_is_bad = seq > 0 and not _sound(database, seq) and _sound(database, seq - 1)
    if last_is_bad and newest_snapshot(database).seq < seq:  # else the row is not needed
        torn = errors.torn(seq)
        seq -= 1
    lost = rest is wal.Rest.LOST
    return Found(header=header, seq=seq, epoch=epoch, torn=torn, lost=lost)


def _schema(database: sqlite3.Connection) -> set[str]:
    return {
        sql.decode(errors="replace") if isinstance(sql, bytes) else str(sql)
        for (sql,) in database.execute("SELECT sql FROM sqlite_schema")
    }


def _header(database: sqlite3.Connection) -> Event | None:
    if not _sound(database, 0):
        return None
    ((text,),) = database.execute("SELECT text FROM journal WHERE seq = 0")
    try:
        return header_of(text.decode())
    except ValueError:
        return None


def _tip(database: sqlite3.Connection) -> tuple[int, int]:
    """Return the number of the last row, and the epoch."""
    for seq, epoch, checksum in database.execute("SELECT seq, epoch, checksum FROM tip"):
        if checksum == tip_checksum(seq, epoch) and _is_number(seq) and _is_number(epoch):
            return seq, epoch
    # Then it is salvaged page by page, without the database.
    if [fault for (fault,) in database.execute("PRAGMA quick_check(1)")] != [b"ok"]:
        raise sqlite3.DatabaseError("database disk image is malformed")
    query = "SELECT seq, epoch FROM journal ORDER BY seq DESC LIMIT 1"
    for seq, epoch in database.execute(query):
        if _is_number(seq) and _is_number(epoch):
            return seq, epoch + SURELY_LESS_OPENINGS
    raise sqlite3.DatabaseError("no row can be the last one")


SURELY_LESS_OPENINGS = 1_000
"""Added to an epoch if it is unknown how often the journal was opened since: it only has to grow."""


def _sound(database: sqlite3.Connection, seq: int) -> bool:
    query = "SELECT seq, epoch, wall, text, checksum FROM journal WHERE seq = ?"
    try:
        row = database.execute(query, (seq,)).fetchone()
    except TROUBLE:
        return False
    return row is not None and is_sound(row)


def last_row(database: sqlite3.Connection) -> int:
    """Return the number of the last row at present."""
    return _tip(database)[0]


def is_sound(row: tuple[object, ...]) -> bool:
    """Whether a row's checksum is right, and it holds what a row can hold."""
    seq, epoch, wall, text, checksum = row
    if not isinstance(text, bytes) or row_checksum(seq, epoch, wall, text) != checksum:
        return False
    return _is_number(seq) and _is_number(epoch) and _is_number(wall, LATEST_WALL)


def _is_number(value: object, most: int = MOST) -> TypeGuard[int]:
    return type(value) is int and 0 <= value <= most


def row_of(row: tuple[Any, ...]) -> Row | None:
    """Return a row that was read; None: it is not sound."""
    if not is_sound(row):
        return None
    seq, epoch, wall, text, _ = row
    try:
        return Row(seq, wall / 1000, text.decode(), epoch)
    except UnicodeDecodeError:
        return None


def newest_snapshot(database: sqlite3.Connection) -> Snapshot:
    """Return the newest sound snapshot."""
    damaged: list[str] = []
    try:
        query = "SELECT seq, epoch, wall, text, checksum FROM snapshot ORDER BY seq DESC"
        for seq, epoch, wall, text, checksum in database.execute(query):
            sound = isinstance(text, bytes) and _is_number(wall, LATEST_WALL) and _is_number(seq)
            if sound and checksum == snapshot_checksum(seq, epoch, wall, text):
                return Snapshot(text.decode(), seq, wall / 1000, tuple(damaged))
            damaged.append(errors.bad_snapshot(seq))
    except TROUBLE:
        damaged.append(errors.unreadable_snapshots())
    return Snapshot(None, 0, None, tuple(damaged))


def sync_folder(path: Path) -> None:
    """Sync a folder, so that a file's name survives a power failure."""
    descriptor = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
