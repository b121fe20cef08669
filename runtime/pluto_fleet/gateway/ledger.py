"""The durable record of jobs and of motors that were cut, which survives a kill of the gateway."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from errno import EIO, ENOSPC
from pathlib import Path

from ..jobs.reports import Entry, entry_data, entry_of
from ..shared.domain.errors import FlightFailed


class Ledger:
    """The state of each job whose action has begun: a SQLite database, with SQLite's own guarantees.

    A damaged one is moved aside, for inspection; then the drones are asked what they have done.
    """

    def __init__(self, path: Path | None = None) -> None:
        """Without a path it is in memory: it outlives a simulated gateway, but not the process."""
        self.is_whole = True
        """Whether everything that was ever stored can be read."""
        with _errors_of_the_disk():
            try:
                self._open(path)
            except _Damaged:
                assert path is not None
                self.is_whole = False
                for end in ("", "-wal", "-shm"):
                    with suppress(FileNotFoundError):
                        os.replace(f"{path}{end}", f"{path}{end}.damaged")
                self._open(path)

    def _open(self, path: Path | None) -> None:
        if path is not None:
            os.close(os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600))
        self._database = sqlite3.connect(path or ":memory:", isolation_level=None)
        try:
            self._database.executescript(_BEGIN)
            if self._read("PRAGMA quick_check(1)") != ["ok"]:
                raise _Damaged
            list(self.entries())
        except (sqlite3.DatabaseError, ValueError, KeyError, TypeError) as error:
            self.close()
            if isinstance(error, sqlite3.OperationalError):
                raise
            raise _Damaged from error

    def _read(self, question: str) -> list[str]:
        return [value for (value,) in self._database.execute(question)]

    def entries(self) -> Iterator[Entry]:
        """Yield the stored jobs, in the order in which they were given."""
        for text in self._read("SELECT entry FROM job ORDER BY rowid"):
            yield entry_of(json.loads(text))

    @property
    def cut(self) -> list[str]:
        """The drones whose motors are cut."""
        return self._read("SELECT drone FROM cut ORDER BY rowid")

    def write(self, entry: Entry) -> None:
        """Store a job's state; when this returns, it is on the disk. Raises `OSError` if that fails."""
        text = json.dumps(entry_data(entry))
        change = "INSERT INTO job VALUES (?, ?) ON CONFLICT DO UPDATE SET entry = excluded.entry"
        self._change(change, (entry.id, text), sync=True)

    def forget(self, id: str) -> None:
        """Drop a job. If that is lost in a crash, the job is merely kept longer."""
        with suppress(OSError):
            self._change("DELETE FROM job WHERE id = ?", (id,))

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Store whether a drone's motors are cut; durable against a power failure only after `make_sure`.

        Does not wait for the disk, as motors are cut right after that. Raises `OSError` if it fails.
        """
        if is_cut:
            self._change("INSERT OR IGNORE INTO cut VALUES (?)", (drone,))
        else:
            self._change("DELETE FROM cut WHERE drone = ?", (drone,))

    def make_sure(self) -> None:
        """Return when all is on the disk; raise `OSError` if that may have failed."""
        with _errors_of_the_disk():
            self._database.execute("PRAGMA wal_checkpoint(FULL)").fetchall()

    def close(self) -> None:
        """Close the file."""
        self._database.close()

    def _change(self, change: str, facts: Sequence[str], *, sync: bool = False) -> None:
        """Make a change, whole or not at all; without `sync` a power failure may take it back."""
        with _errors_of_the_disk():
            self._database.execute(f"PRAGMA synchronous = {'FULL' if sync else 'NORMAL'}")
            self._database.execute(change, facts)


class _Damaged(Exception):
    """The file is no ledger any more."""


_BEGIN = """
PRAGMA journal_mode = WAL;
CREATE TABLE IF NOT EXISTS job (id TEXT PRIMARY KEY, entry TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS cut (drone TEXT PRIMARY KEY);
"""


@contextmanager
def _errors_of_the_disk() -> Iterator[None]:
    """Raise `OSError` for an error of the database."""
    try:
        yield
    except sqlite3.Error as error:
        full = error.sqlite_errorcode == sqlite3.SQLITE_FULL
        raise OSError(ENOSPC if full else EIO, str(error)) from error


class CutMotors:
    """Records cut motors before they are cut, as the process may be killed at any moment.

    So an earlier gateway may have died in between: then the drone flies, and is to be landed.
    """

    def __init__(self, ledger: Ledger | None, flies: Callable[[str], bool]) -> None:
        self._ledger = ledger
        self._flies = flies
        self._cut = dict.fromkeys(() if ledger is None else ledger.cut, False)
        """By drone: whether its motors were cut by this gateway, and not by an earlier one."""

    def __contains__(self, drone: str) -> bool:
        here = self._cut.get(drone)
        return here is not None and (here or not self._flies(drone))

    @contextmanager
    def recording_cut(self, drone: str) -> Iterator[None]:
        """Record a cut within this context; undo it if the drone cannot be reached, so that it can come home."""
        before = self._cut.get(drone)
        self._cut[drone] = True
        if before is None:
            self._write(drone, True)
        try:
            yield
        except FlightFailed:
            if before is None:
                self.mended(drone)
            else:
                self._cut[drone] = before
            raise
        self._make_sure()

    def mended(self, drone: str) -> None:
        """Called when a drone has been repaired."""
        if self._cut.pop(drone, None) is not None:
            self._write(drone, False)
            self._make_sure()

    def _write(self, drone: str, is_cut: bool) -> None:
        """Record it if possible: a full disk must not keep motors from being cut."""
        with suppress(OSError):
            if self._ledger is not None:
                self._ledger.write_cut(drone, is_cut)

    def _make_sure(self) -> None:
        with suppress(OSError):
            if self._ledger is not None:
                self._ledger.make_sure()
