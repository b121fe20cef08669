"""Whether SQLite has left out part of its write-ahead log.

After a crash SQLite takes the log up to the first frame that is not sound and silently forgets the
rest. That is right for what a crash has torn, which is the last commit at most. If further commits
follow, they had been acknowledged, and something has damaged the log since.
"""

from __future__ import annotations

import struct
from pathlib import Path

from .place import beside

_HEADER, _FRAME = struct.Struct(">8I"), struct.Struct(">IIII8x")
_TAKEN = struct.Struct("=16xI")  # of the shared index, which is in the machine's own order


def lost_commits(path: Path) -> bool:
    """Say whether the log of an open database holds commits that SQLite does not see."""
    taken = _taken(beside(path, "-shm"))
    if taken is None:
        return False
    try:
        with beside(path, "-wal").open("rb") as log:
            header = log.read(_HEADER.size)
            if len(header) < _HEADER.size:
                return False
            _, _, page, _, salt_1, salt_2, *_ = numbers = _HEADER.unpack(header)
            whole = _is_sound(header, numbers)
            if not whole:
                page, taken = _page_size(path), 0
            commits, frames, number = 0, 0, 0
            while len(frame := log.read(_FRAME.size)) == _FRAME.size:
                number += 1
                log.seek(page, 1)
                _, size, first, second = _FRAME.unpack(frame)
                if number <= taken:
                    continue
                if whole and (first, second) != (salt_1, salt_2):
                    continue  # of an earlier use of the log: all that is in the database
                frames += 1
                if commits:
                    return True
                commits += size > 0
    except OSError:
        return False
    return False


def _taken(index: Path) -> int | None:
    """Return how many frames SQLite has found sound; None: it has not looked."""
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
