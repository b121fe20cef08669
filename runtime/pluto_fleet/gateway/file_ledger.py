"""A ledger in a file: a line for each change, on the disk before anybody relies on it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from zlib import crc32

from ..jobs.reports import Entry, JobState
from ..journal.values import value_data, value_of
from .ledger import Written

_SPARE = 1000
"""Lines that may be of no use any more when a process begins; while it runs, twice as many."""

_sync: Callable[[int], None] = getattr(os, "fdatasync", os.fsync)  # not every system has the former


class FileLedger:
    """Every line has a checksum: what a torn or damaged one said is not believed."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._kept: dict[str, Mapping[str, object]] = {}
        """The last line of each job, in the order in which the jobs were given."""
        self.cut: dict[str, None] = {}
        """The drones whose motors are cut."""
        self.is_whole = True
        """Whether every line could be read, but for one at the end that was never finished."""
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

    def entries(self) -> Iterator[Entry]:
        """Yield what is kept, in the order in which the jobs were given."""
        yield from map(_entry, self._kept.values())

    def write(self, job: Written) -> None:
        """Keep how a job stands; when this returns, it is on the disk."""
        self._append(_text(job))

    def forget(self, id: str) -> None:
        """Drop a job. Should that be lost, it is only known for longer than it need be.

        What has been dropped takes room until there is much of it; here nobody waits for the disk.
        """
        with suppress(OSError):
            self._append({"forget": id}, sync=False)
            self._compact(2 * _SPARE)

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Keep whether a drone's motors are cut; if the computer dies, only after `make_sure`."""
        self._append(_motors(drone, is_cut), sync=False)

    def make_sure(self) -> None:
        """Return when all is on the disk."""
        _sync(self._file)

    def close(self) -> None:
        """Leave the file as it is."""
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
            self._kept.pop(str(data["forget"]), None)
            return
        if "motors" in data:
            self._turned(str(data["motors"]), data["cut"] is True)
            return
        self._kept[_entry(data).id] = data

    def _turned(self, drone: str, is_cut: bool) -> None:
        self.cut.pop(drone, None)
        if is_cut:
            self.cut[drone] = None

    def _compact(self, spare: int) -> None:
        """Write the file anew if most of it is of no use; what was damaged stays for whoever looks."""
        needed = len(self._kept) + len(self.cut)
        if self.is_whole and self._lines > max(2 * needed, self._tried) + spare:
            self._tried = self._lines  # on a full disk: not again at once
            with suppress(OSError):
                self._write_anew()
                self._lines, self._tried = needed, 0

    def _write_anew(self) -> None:
        """Leave out what has been overtaken or forgotten: beside the file, then in its place.

        Until the folder knows of the new file the old one is whole; nothing is added to either.
        """
        part = self._path.with_name(f"{self._path.name}.part")
        text = b"".join(map(_line, [*self._kept.values(), *(_motors(id, True) for id in self.cut)]))
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


def _text(job: Written) -> dict[str, object]:
    return {
        "id": job.id,
        "drone": job.drone,
        "state": job.state.value,
        "boot": job.boot,
        "value": value_data(job.value),
        "failure": job.failure,
        "reason": job.reason,
    }


def _motors(drone: str, is_cut: bool) -> dict[str, object]:
    return {"motors": drone, "cut": is_cut}


def _entry(data: Mapping[str, object]) -> Entry:
    match data:
        case {
            "id": str(id),
            "drone": str(drone),
            "state": str(state),
            "boot": int(boot),
            "value": value,
            "failure": str(failure),
            "reason": str(reason),
        }:
            return Entry(
                id=id,
                drone=drone,
                state=JobState(state),
                boot=boot,
                value=value_of(value),
                failure=failure,
                reason=reason,
            )
    raise ValueError("that is no entry")


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
    """Let a new file's name be on the disk, too."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    with suppress(OSError):
        os.fsync(descriptor)
    os.close(descriptor)
