"""A ledger in a file: a line for each change, on the disk before anybody relies on it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from zlib import crc32

from ..journal.values import value_data, value_of
from ..standing import Entry, JobState
from .ledger import Written

_SPARE = 1000
"""Lines that may be of no use any more before the file is written anew."""

_sync: Callable[[int], None] = getattr(os, "fdatasync", os.fsync)  # not every system has the former


class FileLedger:
    """Every line has a checksum: what a torn or damaged one said is not believed."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._entries: dict[str, Entry] = {}
        self.cut: dict[str, None] = {}
        """The drones whose motors are cut."""
        self.is_whole = True
        """Whether every line could be read, but for one at the end that was never finished."""
        self._lines = self._end = 0
        is_new = not path.exists()
        if not is_new:
            self._read(path.read_bytes())
        self._file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o600)
        os.ftruncate(self._file, self._end)
        os.lseek(self._file, 0, os.SEEK_END)
        if self.is_whole and self._lines > 2 * len(self._entries) + _SPARE:
            self._write_anew()
        if is_new:
            _sync_folder(path.parent)

    def entries(self) -> Iterator[Entry]:
        """Yield what is kept, in the order in which the jobs were given."""
        yield from self._entries.values()

    def write(self, job: Written) -> None:
        """Keep how a job stands; when this returns, it is on the disk."""
        self._append(_text(job))

    def forget(self, id: str) -> None:
        """Drop a job. Should that be lost, it is only known for longer than it need be."""
        with suppress(OSError):
            self._append({"forget": id}, sync=False)

    def write_cut(self, drone: str, is_cut: bool) -> None:
        """Keep whether a drone's motors are cut; if the computer dies, only after `make_sure`."""
        self._append(_motors(drone, is_cut), sync=False)
        self._turned(drone, is_cut)

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
            self._entries.pop(str(data["forget"]), None)
            return
        if "motors" in data:
            self._turned(str(data["motors"]), data["cut"] is True)
            return
        entry = _entry(data)
        self._entries[entry.id] = entry

    def _turned(self, drone: str, is_cut: bool) -> None:
        self.cut.pop(drone, None)
        if is_cut:
            self.cut[drone] = None

    def _write_anew(self) -> None:
        """Leave out what has been overtaken or forgotten: beside the file, then in its place."""
        part = self._path.with_name(f"{self._path.name}.part")
        kept = [_text(entry) for entry in self._entries.values()]
        text = b"".join(map(_line, [*kept, *(_motors(drone, True) for drone in self.cut)]))
        with suppress(OSError):
            part.write_bytes(text)
            file = os.open(part, os.O_WRONLY | os.O_CLOEXEC)
            os.fsync(file)
            part.replace(self._path)
            os.close(self._file)
            self._file, self._end = file, os.lseek(file, 0, os.SEEK_END)


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
