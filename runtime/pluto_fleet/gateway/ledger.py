"""The durable record of jobs and of motors that were cut, which survives a kill of the gateway."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from zlib import crc32

from ..jobs.reports import Entry, entry_data, entry_of
from ..shared.domain.errors import FlightFailed


class Ledger:
    """Stores the state of each job whose action has begun.

    This one stores it in memory, for simulations and tests: it outlives a simulated gateway, but not
    the process.
    """

    def __init__(self) -> None:
        self._kept: dict[str, Entry] = {}
        """The state of each job, in the order in which the jobs were given."""
        self.cut: dict[str, None] = {}
        """The drones whose motors are cut."""
        self.is_whole = True
        """Whether everything that was ever stored can be read."""

    def entries(self) -> Iterator[Entry]:
        """Yield the stored jobs, in the order in which they were given."""
        yield from self._kept.values()

    def write(self, entry: Entry) -> None:
        """Store a job's state durably; raise `OSError` if that fails."""
        self._kept[entry.id] = replace(entry, flies=False)

    def forget(self, id: str) -> None:
        """Drop a job: it will not be asked for any more."""
        self._kept.pop(id, None)

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Store whether a drone's motors are cut; durable against a power failure only after `make_sure`.

        Does not wait for the disk, as motors are cut right after that. Raises `OSError` if it fails.
        """
        self.cut.pop(drone, None)
        if is_cut:
            self.cut[drone] = None

    def make_sure(self) -> None:
        """Make everything durable; raise `OSError` if that may have failed."""


_SPARE = 1000
"""How many obsolete lines are left when a process starts; twice as many while it runs."""

_sync: Callable[[int], None] = getattr(os, "fdatasync", os.fsync)  # not every system has the former


class FileLedger(Ledger):
    """A durable ledger in a file; each line has a checksum, and damaged ones are ignored.

    It is whole even if its last line is incomplete.
    """

    def __init__(self, path: Path) -> None:
        super().__init__()
        self._path = path
        self._lines = self._end = self._tried = 0
        is_new = not path.exists()
        if not is_new:
            self._read(path.read_bytes())
        self._file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o600)
        os.ftruncate(self._file, self._end)
        os.lseek(self._file, 0, os.SEEK_END)
        self._compact(_SPARE)
        if is_new:
            _sync_folder(path.parent)

    def write(self, entry: Entry) -> None:
        """Store a job's state; when this returns, it is on the disk."""
        self._append(entry_data(entry))

    def forget(self, id: str) -> None:
        """Drop a job. If that is lost in a crash, the job is merely kept longer.

        The file is compacted when there is much to drop; this does not wait for the disk.
        """
        with suppress(OSError):
            self._append({"forget": id}, sync=False)
            self._compact(2 * _SPARE)

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Store whether a drone's motors are cut; durable against a power failure only after `make_sure`."""
        self._append(_motors(drone, is_cut), sync=False)

    def make_sure(self) -> None:
        """Return when all is on the disk."""
        _sync(self._file)

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)

    def _append(self, data: Mapping[str, object], *, sync: bool = True) -> None:
        """Write a line whole, or not at all."""
        line = _line(data)
        try:
            if os.write(self._file, line) < len(line):
                raise OSError("no space is left")
            if sync:
                _sync(self._file)
        except OSError:
            with suppress(OSError):
                os.ftruncate(self._file, self._end)
                os.lseek(self._file, self._end, os.SEEK_SET)
            raise
        self._end += len(line)
        self._lines += 1
        self._take(data)

    def _read(self, told: bytes) -> None:
        *lines, _torn = told.split(b"\n")
        for line in lines:
            self._end += len(line) + 1
            self._lines += 1
            try:
                self._take(_read(line))
            except (ValueError, KeyError, TypeError):
                self.is_whole = False

    def _take(self, data: Mapping[str, object]) -> None:
        if "forget" in data:
            super().forget(str(data["forget"]))
        elif "motors" in data:
            super().write_cut(str(data["motors"]), data["cut"] is True)
        else:
            super().write(entry_of(data))

    def _compact(self, spare: int) -> None:
        """Rewrite the file if most of it is obsolete; a damaged one is kept for inspection."""
        needed = len(self._kept) + len(self.cut)
        if self.is_whole and self._lines > max(2 * needed, self._tried) + spare:
            self._tried = self._lines  # on a full disk, do not retry at once
            with suppress(OSError):
                self._write_anew()
                self._lines, self._tried = needed, 0

    def _write_anew(self) -> None:
        """Write what is still valid into a new file, and replace the old one.

        Until the folder is synced the old file is complete; nothing is added to either.
        """
        part = self._path.with_name(f"{self._path.name}.part")
        kept = [*map(entry_data, self._kept.values()), *(_motors(id, True) for id in self.cut)]
        text = b"".join(map(_line, kept))
        part.write_bytes(text)
        file = os.open(part, os.O_WRONLY | os.O_CLOEXEC)
        try:
            os.fsync(file)
            part.replace(self._path)
        except OSError:
            os.close(file)
            raise
        os.close(self._file)
        self._file, self._end = file, os.lseek(file, 0, os.SEEK_END)
        _sync_folder(self._path.parent)


def _motors(drone: str, is_cut: bool) -> dict[str, object]:
    return {"motors": drone, "cut": is_cut}


def _line(data: Mapping[str, object]) -> bytes:
    text = json.dumps(data).encode()
    return b"%08x %s\n" % (crc32(text), text)


def _read(line: bytes) -> Mapping[str, object]:
    checksum, _, text = line.partition(b" ")
    data = json.loads(text)
    if int(checksum, 16) != crc32(text) or not isinstance(data, dict):
        raise ValueError("it was damaged")
    return data


def _sync_folder(folder: Path) -> None:
    """Sync the folder, so that a new file's name is durable."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    with suppress(OSError):
        os.fsync(descriptor)
    os.close(descriptor)


class CutMotors:
    """Records cut motors before they are cut, as the process may be killed at any moment.

    So an earlier gateway may have died in between: then the drone flies, and is to be landed.
    """

    def __init__(self, ledger: Ledger | None, flies: Callable[[str], bool]) -> None:
        self._ledger, self._flies = ledger or Ledger(), flies
        self._cut = dict.fromkeys(self._ledger.cut, False)
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
            self._ledger.write_cut(drone, is_cut)

    def _make_sure(self) -> None:
        with suppress(OSError):
            self._ledger.make_sure()
