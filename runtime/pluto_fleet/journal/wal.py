"""Detecting whether SQLite has ignored part of its write-ahead log.

After a crash SQLite uses the log up to the first unsound frame and silently ignores the rest. That is right
for a torn write, which is at most the last commit. If further commits follow, they were acknowledged, and
the log has been damaged since.
"""

from __future__ import annotations

import struct
from enum import Enum
from pathlib import Path
from typing import BinaryIO

from .place import beside

_HEADER, _FRAME = struct.Struct(">8I"), struct.Struct(">IIII8x")
_ANY, _USES = 0xFFFFFFFF, 1 << 20
"""The layout of the log's header: at each reset its first salt is incremented."""

_TAKEN = struct.Struct("=16xI")  # of the shared index, which is in the machine's own order


class Rest(Enum):
    """What is in a log beyond what SQLite uses."""

    NOTHING = "nothing"
    TORN = "torn"  # at most one commit, most likely not acknowledged
    LOST = "lost"  # acknowledged commits


def rest(path: Path) -> Rest:
    """Return what SQLite ignores of the log of an open database."""
    taken = _taken(beside(path, "-shm"))
    if taken is None:
        return Rest.NOTHING
    try:
        with beside(path, "-wal").open("rb") as log:
            return _rest(log, taken, path)
    except OSError:
        return Rest.NOTHING


def _rest(log: BinaryIO, taken: int, path: Path) -> Rest:
    header = log.read(_HEADER.size)
    if len(header) < _HEADER.size:
        return Rest.NOTHING
    numbers = _HEADER.unpack(header)
    page = numbers[2]
    salts: tuple[int, ...] | None = numbers[4:6]
    if not _is_sound(header, numbers):
        page, salts, taken = _page_size(path), None, 0
    number = commits = strange = 0
    while len(start := log.read(_FRAME.size)) == _FRAME.size:
        number += 1
        log.seek(page, 1)
        _, commit, *frames = _FRAME.unpack(start)
        if number <= taken or (salts and 0 < salts[0] - frames[0] & _ANY < _USES):
            continue  # used, or of an earlier generation that is in the database
        if commits:
            return Rest.LOST
        commits += commit > 0  # without a commit it was never acknowledged
        strange += salts is not None and salts[0] != frames[0] and salts[1] != frames[1]
    return Rest.TORN if commits or strange else Rest.NOTHING


def _taken(index: Path) -> int | None:
    """Return how many frames SQLite has found sound; None: unknown."""
    try:
        with index.open("rb") as file:
            start = file.read(_TAKEN.size)
    except OSError:
        return None
    return int(_TAKEN.unpack(start)[0]) if len(start) == _TAKEN.size else None


def _is_sound(header: bytes, numbers: tuple[int, ...]) -> bool:
    big = numbers[0] & 1
    first = second = 0
    words = struct.unpack((">" if big else "<") + "6I", header[:24])
    for one, other in zip(words[::2], words[1::2], strict=True):
        first = first + one + second & 0xFFFFFFFF
        second = second + other + first & 0xFFFFFFFF
    return numbers[0] >> 1 == 0x377F0682 >> 1 and (first, second) == numbers[6:]


def _page_size(path: Path) -> int:
    with path.open("rb") as file:
        size: int = struct.unpack(">16xH", file.read(18))[0]
    return 65536 if size == 1 else size
