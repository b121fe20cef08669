"""A journal that is open for writing: an SQLite file that one process writes."""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from ..shared.domain.trace import Event
from . import copies, errors
from .database import (
    APPLICATION,
    TABLES,
    VERSION,
    connect,
    found,
    look_at,
    put_rows,
    standing_in,
    sync_folder,
    why_unsound,
)
from .errors import TROUBLE, Damaged, JournalError
from .lock import Lock
from .place import beside
from .standing import Row, Standing, inherited

RESERVE = 256 * 1024
"""Bytes of disk space that are kept back for the last words."""

Clock = Callable[[], float]


class Entry(NamedTuple):
    """What is written at once: the events of one instant, and the rows that these have changed."""

    events: str
    """A JSON list of objects."""
    rows: Sequence[Row] = ()


class Store:
    """A journal that is open for writing, by this process and no other."""

    def __init__(
        self,
        path: Path,
        lock: Lock,
        database: sqlite3.Connection,
        header: Event,
        seq: int,
        clock: Clock,
    ) -> None:
        self.path = path
        self.header = header
        self.epoch = 0
        """A fencing token that grows at each opening."""
        self.seq = seq
        """The number of the last entry."""
        self.failure: JournalError | None = None
        """Why nothing more is accepted, or None."""
        self._lock = lock
        self._database = database
        self._clock = clock
        self._files: dict[Path, Identity | None] = {}
        """The files that are written, with their identities when it was opened."""
        self._closed = False
        self._process = os.getpid()
        self._least = 0

    @classmethod
    def create(cls, path: Path, header: Event, clock: Clock = time.time) -> Store:
        """Create a new journal, and open it."""
        path = _real(path)
        try:
            lock = Lock.take(path)
            try:
                _keep_back(path)
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
        try:
            look_at(path)
            lock = Lock.take(path)
            try:
                _keep_back(path)
                return cls._opened(path, lock, clock)
            except BaseException:
                _let_go(path, lock)
                raise
        except Damaged as error:
            raise errors.damaged(path, error.what, copies.newest_whole(path)) from None
        except (OSError, *TROUBLE) as error:
            raise errors.cannot_open(path, error) from None

    @classmethod
    def _opened(cls, path: Path, lock: Lock, clock: Clock) -> Store:
        database = connect(path, "mode=rw")
        try:
            why = why_unsound(database)
            if why is not None:
                raise errors.damaged(path, why)
            state = found(path, database)
            store = cls(path, lock, database, state.header, state.seq, clock)
            store._begin(state.epoch + 1)
        except BaseException:
            database.close()
            raise
        return store

    def _begin(self, epoch: int) -> None:
        self.epoch = epoch
        database = self._database
        database.execute("PRAGMA journal_mode = WAL")
        # with NORMAL a power failure loses acknowledged entries
        database.execute("PRAGMA synchronous = FULL")
        database.execute("BEGIN IMMEDIATE")
        put_rows(database, [("app", ("epoch",), {"is": epoch})])
        database.execute("COMMIT")
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        self._files = {file: identity(file) for file in (self.path, beside(self.path, "-wal"))}
        self._least = _size(self.path)

    def look(self) -> None:
        """Raise a `JournalError` if the journal was deleted, renamed or truncated."""
        if self.failure is not None:
            raise self.failure
        for file, which in self._files.items():
            if which is not None and identity(file) != which:
                self.failure = errors.gone(file, _moved_to(which), self.path)
                _give_back(self.path)
                raise self.failure
        if _size(self.path) < self._least:  # it never shrinks by itself
            self.failure = errors.cut_short(self.path)
            _give_back(self.path)
            raise self.failure

    def append(self, entries: Sequence[Entry]) -> None:
        """Write entries in one transaction; when this returns they are durable."""
        self.look()
        try:
            self._commit(entries)
        except (ValueError, *TROUBLE) as error:  # ValueError: a text that is none
            raise self._failed(error) from None

    def last_words(self, events: str) -> bool:
        """Try once to write a final entry after a failure, such as why it failed."""
        try:
            self._commit([Entry(events)])
        except TROUBLE:
            self._roll_back()
            return False
        return True

    def standing(self) -> Standing:
        """Return where everything stands."""
        return standing_in(self.path, self._database)

    @property
    def written(self) -> float:
        """When its last entry was written, in seconds since 1970."""
        ((wall,),) = self._database.execute("SELECT wall FROM event ORDER BY seq DESC LIMIT 1")
        return float(wall) / 1000

    def copy(self) -> None:
        """Make a copy of the whole journal beside it; of earlier copies the newest is kept."""
        copies.copy(self.path)

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

    def _commit(self, entries: Sequence[Entry]) -> None:
        wall = round(self._clock() * 1000)
        numbered = [
            (number, self.epoch, wall, entry.events)
            for number, entry in enumerate(entries, self.seq + 1)
        ]
        latest = {(table, key): row for entry in entries for table, key, row in entry.rows}
        database = self._database
        database.execute("BEGIN IMMEDIATE")
        database.executemany("INSERT INTO event VALUES (?, ?, ?, ?)", numbered)
        put_rows(database, ((table, key, row) for (table, key), row in latest.items()))
        database.execute("COMMIT")
        self.seq += len(entries)

    def _failed(self, error: Exception) -> JournalError:
        """Fail permanently: nothing later is acknowledged."""
        self._roll_back()
        _give_back(self.path)
        self.failure = errors.cannot_write(self.path, error, self.seq)
        return self.failure

    def _roll_back(self) -> None:
        with suppress(*TROUBLE):
            if self._database.in_transaction:
                self._database.execute("ROLLBACK")


# Its files

Identity = tuple[int, int]
"""The identity of a file: its device and inode."""

_OPEN = Path("/proc/self/fd")
_DELETED = " (deleted)"


def identity(path: Path) -> Identity | None:
    """Return the identity of the file of this name, or None."""
    try:
        known = os.stat(path)
    except OSError:
        return None
    return known.st_dev, known.st_ino


def _size(path: Path) -> int:
    try:
        return os.stat(path).st_size
    except OSError:
        return 0


def _moved_to(which: Identity) -> Path | None:
    """Return the present name of an open file; None: it has none, or it is unknown."""
    with suppress(OSError):
        for entry in _OPEN.iterdir():
            with suppress(OSError):
                name = os.readlink(entry)
                if identity(entry) == which and not name.endswith(_DELETED):
                    return Path(name) if identity(Path(name)) == which else None
    return None


def _make(path: Path, header: Event, wall: float) -> None:
    """Write a complete journal under a temporary name, and then publish it."""
    if path.is_dir():
        raise errors.is_folder(path)
    if os.path.lexists(path):
        raise errors.exists(path)
    with _made(path, header, wall) as part:
        try:
            os.link(part, path)  # unlike a rename this never overwrites a file
        except FileExistsError:
            raise errors.exists(path) from None
        except OSError:  # a file system without links
            part.rename(path)
        sync_folder(path)


@contextmanager
def _made(path: Path, header: Event, wall: float) -> Iterator[Path]:
    """Give a temporary file beside this path, a journal with its header; it is removed unless renamed."""
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
            first = (0, 0, round(wall * 1000), json.dumps([header]))
            database.execute("INSERT INTO event VALUES (?, ?, ?, ?)", first)
            put_rows(database, [("app", ("epoch",), {"is": 0}), *inherited(header)])
            database.execute("COMMIT")
            database.execute("PRAGMA journal_mode = WAL")
        yield part
    finally:
        part.unlink(missing_ok=True)


def _unmake(path: Path) -> None:
    """Remove a new journal that cannot be written."""
    for suffix in ("-wal", "-shm", ""):
        with suppress(OSError):
            beside(path, suffix).unlink()


def _keep_back(path: Path) -> None:
    """Reserve disk space beside a journal."""
    try:
        with beside(path, ".reserve").open("wb") as file:
            file.write(os.urandom(RESERVE))  # incompressible
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        _give_back(path)
        raise


def _give_back(path: Path) -> None:
    """Release the reserve."""
    with suppress(OSError):
        beside(path, ".reserve").unlink()


def _let_go(path: Path, lock: Lock) -> None:
    _give_back(path)
    lock.release()


def _real(path: Path) -> Path:
    """Resolve links: a journal with two names has one lock."""
    try:
        return Path(os.path.realpath(path))
    except ValueError as error:  # a NUL in the name
        raise errors.cannot_open(path, error) from None
