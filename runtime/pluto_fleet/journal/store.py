"""A journal that is open for writing: an SQLite file that one process writes."""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from functools import cache
from pathlib import Path

from ..shared.domain.trace import Event
from . import errors
from .database import (
    APPLICATION,
    TABLES,
    VERSION,
    Row,
    connect,
    found,
    look_at,
    row_checksum,
    snapshot_checksum,
    sync_folder,
    tip_checksum,
)
from .errors import TROUBLE, JournalError
from .lock import Lock
from .place import beside
from .reader import Read, since_snapshot


@contextmanager
def made(path: Path, rows: Sequence[Row], epoch: int) -> Iterator[Path]:
    """Give a temporary file beside this path that holds these rows; it is removed unless renamed."""
    part = beside(path, f".{os.getpid()}.part")
    part.unlink(missing_ok=True)
    try:
        with closing(connect(part, "mode=rwc")) as database:
            database.execute("PRAGMA synchronous = FULL")
            database.execute(f"PRAGMA application_id = {APPLICATION}")
            database.execute(f"PRAGMA user_version = {VERSION}")
            database.execute("BEGIN IMMEDIATE")
            for table in TABLES.values():
                database.execute(table)
            database.executemany("INSERT INTO journal VALUES (?, ?, ?, ?, ?)", map(_columns, rows))
            last = rows[-1].seq
            tip = last, epoch, tip_checksum(last, epoch)
            database.execute("INSERT INTO tip VALUES (0, ?, ?, ?)", tip)
            database.execute("COMMIT")
            database.execute("PRAGMA journal_mode = WAL")
        yield part
    finally:
        part.unlink(missing_ok=True)


def _columns(row: Row) -> tuple[int, int, int, str, int]:
    wall = round(row.wall * 1000)
    checksum = row_checksum(row.seq, row.epoch, wall, row.text.encode())
    return row.seq, row.epoch, wall, row.text, checksum


RESERVE = 256 * 1024
"""Bytes."""


def keep_back(path: Path) -> None:
    """Reserve disk space beside a journal."""
    try:
        with beside(path, ".reserve").open("wb") as file:
            file.write(os.urandom(RESERVE))  # incompressible
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        give_back(path)
        raise


def give_back(path: Path) -> None:
    """Release the reserve."""
    with suppress(OSError):
        beside(path, ".reserve").unlink()


Identity = tuple[int, int]
"""The identity of a file: its device and inode."""

_OPEN = Path("/proc/self/fd")
_DELETED = " (deleted)"


def identity(path: Path) -> Identity | None:
    """Return the identity of the file of this name, or None."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino


def size(path: Path) -> int:
    """Return the size of the file of this name; 0 if it cannot be seen."""
    try:
        return os.stat(path).st_size
    except OSError:
        return 0


def moved_to(which: Identity) -> Path | None:
    """Return the present name of an open file; None: it has none, or it is unknown."""
    with suppress(OSError):
        for entry in _OPEN.iterdir():
            with suppress(OSError):
                name = os.readlink(entry)
                if identity(entry) == which and not name.endswith(_DELETED):
                    return Path(name) if identity(Path(name)) == which else None
    return None


SNAPSHOTS = 2
"""How many snapshots are kept, in case the newest is damaged."""

_COLUMNS, _AT_ONCE = 5, 500
"""Rows are inserted by few statements, as each one waits for the interpreter's lock."""

Clock = Callable[[], float]


class Store:
    """A journal that is open for writing, by this process and no other."""

    def __init__(
        self, path: Path, lock: Lock, database: sqlite3.Connection, header: Event, clock: Clock
    ) -> None:
        self.path, self.header = path, header
        self.epoch = 0
        """A fencing token that grows at each opening."""
        self.seq = 0
        """The number of the last row."""
        self.torn: str | None = None
        """What was wrong with the last row, which was dropped; None: nothing was."""
        self.failure: JournalError | None = None
        """Why no more rows are accepted, or None."""
        self._lock, self._database, self._clock = lock, database, clock
        self._files: dict[Path, Identity | None] = {}
        """The files that are written, with their identities when it was opened."""
        self._closed, self._process, self._least = False, os.getpid(), 0
        most = database.getlimit(sqlite3.SQLITE_LIMIT_VARIABLE_NUMBER)
        self._at_once = min(_AT_ONCE, most // _COLUMNS)

    @classmethod
    def create(cls, path: Path, header: Event, clock: Clock = time.time) -> Store:
        """Create a new journal, and open it."""
        path = _real(path)
        try:
            lock = Lock.take(path)
            try:
                keep_back(path)
                _make(path, header, clock())
                try:
                    return cls._opened(path, lock, clock)
                except BaseException:
                    _unmake(path)
                    raise
            except BaseException:
                _let_go(path, lock)
                raise
        except (OSError, ValueError, *TROUBLE) as error:  # ValueError: a NUL in the name
            raise errors.cannot_make(path, error) from None

    @classmethod
    def open(cls, path: Path, clock: Clock = time.time) -> Store:
        """Open a journal to resume it, with a new, durable epoch."""
        path = _real(path)
        look_at(path)
        try:
            lock = Lock.take(path)
            try:
                keep_back(path)
                return cls._opened(path, lock, clock)
            except BaseException:
                _let_go(path, lock)
                raise
        except (OSError, *TROUBLE) as error:
            raise errors.cannot_open(path, error) from None

    @classmethod
    def _opened(cls, path: Path, lock: Lock, clock: Clock) -> Store:
        with closing(connect(path, "mode=ro")) as database:  # the check must not change it
            state = found(path, database)
        if state.lost:
            raise errors.damaged(path, errors.lost_log())
        database = connect(path, "mode=rw")
        store = cls(path, lock, database, state.header, clock)
        try:
            store._begin(state.seq, state.epoch + 1, state.torn)
        except BaseException:
            database.close()
            raise
        return store

    def _begin(self, seq: int, epoch: int, torn: str | None) -> None:
        self.seq, self.epoch, self.torn = seq, epoch, torn
        database = self._database
        database.execute("PRAGMA journal_mode = WAL")
        database.execute(
            "PRAGMA synchronous = FULL"
        )  # with NORMAL a power failure loses acknowledged rows
        database.execute("BEGIN IMMEDIATE")
        database.execute("DELETE FROM journal WHERE seq > ?", (seq,))
        database.execute("DELETE FROM tip")
        database.execute(
            "INSERT INTO tip VALUES (0, ?, ?, ?)", (seq, epoch, tip_checksum(seq, epoch))
        )
        database.execute("COMMIT")
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        self._files = {file: identity(file) for file in (self.path, beside(self.path, "-wal"))}
        self._least = size(self.path)

    def look(self) -> None:
        """Raise a `JournalError` if the journal was deleted, renamed or truncated."""
        if self.failure is not None:
            raise self.failure
        for file, which in self._files.items():
            if which is not None and identity(file) != which:
                self.failure = errors.gone(file, moved_to(which), self.path)
                give_back(self.path)
                raise self.failure
        if size(self.path) < self._least:  # it never shrinks by itself
            self.failure = errors.cut_short(self.path)
            give_back(self.path)
            raise self.failure

    def append(self, rows: Sequence[str]) -> None:
        """Write rows, each the events of one instant; when this returns they are durable."""
        self.look()
        try:
            self._commit(rows)
        except (ValueError, *TROUBLE) as error:  # ValueError: a text that is none
            raise self._failed(error) from None

    def last_words(self, row: str) -> bool:
        """Try once to write a final row after a failure, such as why it failed."""
        try:
            self._commit([row])
        except TROUBLE:
            self._roll_back()
            return False
        return True

    def snapshot(self, state: str) -> None:
        """Store a snapshot of all rows so far; the rows stay."""
        if self.failure is not None:
            raise self.failure
        text, seq, wall = state.encode(), self.seq, _milliseconds(self._clock)
        checksum, database = snapshot_checksum(seq, self.epoch, wall, text), self._database
        try:
            database.execute("BEGIN IMMEDIATE")
            database.execute(
                "INSERT OR REPLACE INTO snapshot VALUES (?, ?, ?, ?, ?)",
                (seq, self.epoch, wall, state, checksum),
            )
            database.execute(
                "DELETE FROM snapshot WHERE seq NOT IN"
                " (SELECT seq FROM snapshot ORDER BY seq DESC LIMIT ?)",
                (SNAPSHOTS,),
            )
            database.execute("COMMIT")
        except TROUBLE as error:
            raise self._failed(error) from None

    def read(self) -> Read:
        """Return the newest sound snapshot and the rows after it."""
        return since_snapshot(self._database, self.seq)

    def close(self) -> None:
        """Close it and release the lock; everything acknowledged is durable already."""
        if self._closed or os.getpid() != self._process:
            return  # the files beside the journal may belong to another process by now
        self._closed = True
        with suppress(*TROUBLE):
            self._database.execute("PRAGMA wal_checkpoint(TRUNCATE)")  # even beside a reader
        with suppress(*TROUBLE):
            self._database.close()
        _let_go(self.path, self._lock)

    def _commit(self, rows: Sequence[str]) -> None:
        wall, epoch, seq = _milliseconds(self._clock), self.epoch, self.seq
        values: list[object] = []
        for text in rows:
            seq += 1
            values += (seq, epoch, wall, text, row_checksum(seq, epoch, wall, text.encode()))
        database, most = self._database, self._at_once * _COLUMNS
        database.execute("BEGIN IMMEDIATE")
        for start in range(0, len(values), most):
            part = values[start : start + most]
            database.execute(_insertion(len(part) // _COLUMNS), part)
        database.execute("UPDATE tip SET seq = ?, checksum = ?", (seq, tip_checksum(seq, epoch)))
        database.execute("COMMIT")
        self.seq = seq

    def _failed(self, error: Exception) -> JournalError:
        """Fail permanently: nothing later is acknowledged."""
        self._roll_back()
        give_back(self.path)
        self.failure = errors.cannot_write(self.path, error, self.seq)
        return self.failure

    def _roll_back(self) -> None:
        with suppress(*TROUBLE):
            if self._database.in_transaction:
                self._database.execute("ROLLBACK")


@cache
def _insertion(rows: int) -> str:
    return "INSERT INTO journal VALUES " + ", ".join(["(?, ?, ?, ?, ?)"] * rows)


def _make(path: Path, header: Event, wall: float) -> None:
    """Write a complete journal under a temporary name, and then publish it."""
    if path.is_dir():
        raise errors.is_folder(path)
    if os.path.lexists(path):
        raise errors.exists(path)
    with made(path, [Row(0, wall, json.dumps([header]), 0)], 0) as part:
        try:
            os.link(part, path)  # unlike a rename this never overwrites a file
        except FileExistsError:
            raise errors.exists(path) from None
        except OSError:  # a file system without links
            part.rename(path)
        sync_folder(path)


def _unmake(path: Path) -> None:
    """Remove a new journal that cannot be written."""
    for suffix in ("-wal", "-shm", ""):
        with suppress(OSError):
            beside(path, suffix).unlink()


def _let_go(path: Path, lock: Lock) -> None:
    give_back(path)
    lock.release()


def _real(path: Path) -> Path:
    """Resolve links: a journal with two names has one lock."""
    try:
        return Path(os.path.realpath(path))
    except ValueError as error:  # a NUL in the name
        raise errors.cannot_open(path, error) from None


def _milliseconds(clock: Clock) -> int:
    return round(clock() * 1000)
