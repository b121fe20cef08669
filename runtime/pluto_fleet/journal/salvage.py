"""Salvaging rows of a damaged journal without the database, from any page that still has some.

A row's checksum shows whether it is sound. So every page is tried, even if its header is damaged, and also
every page in the write-ahead log.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from .database import Row, row_of
from .place import beside

_SIZES = {1 << power for power in range(9, 17)}
_LOG_HEADER, _FRAME_HEADER = 32, 24
_MOST = 1 << 30
"""The largest row in bytes: a larger number is damage."""

_Pages = dict[int, bytes]
_Found = dict[int, Row]


def salvage(path: Path, after: int) -> list[Row]:
    """Return all sound rows after one, in order, with possible gaps."""
    content = path.read_bytes()
    size = _page_size(content)
    newest: _Pages = {}
    pages: list[bytes] = []
    for start in range(0, len(content), size):
        newest[start // size + 1] = page = content[start : start + size]
        pages.append(page)
    for number, page in _logged(path, size):
        newest[number] = page
        pages.append(page)
    found: _Found = {}
    for page in pages:
        for cell in _cells(page):
            with suppress(LookupError, ValueError):
                _keep(cell, page, newest, found)
    return [found[seq] for seq in sorted(found) if seq > after]


def _page_size(content: bytes) -> int:
    size: int = struct.unpack_from(">H", content.ljust(18, b"\0"), 16)[0]
    size = 65536 if size == 1 else size
    return size if size in _SIZES else 4096


def _logged(path: Path, size: int) -> Iterator[tuple[int, bytes]]:
    try:
        log = beside(path, "-wal").read_bytes()
    except OSError:
        return
    for start in range(_LOG_HEADER, len(log), _FRAME_HEADER + size):
        page = log[start + _FRAME_HEADER : start + _FRAME_HEADER + size]
        if len(page) == size:
            yield int.from_bytes(log[start : start + 4], "big"), page


def _cells(page: bytes) -> Iterator[int]:
    """Yield the offsets of a page's cells, which are listed before the first of them."""
    place, lowest = 8, len(page)
    while place + 2 <= lowest:
        cell = int.from_bytes(page[place : place + 2], "big")
        if 8 < cell < len(page):
            yield cell
            if cell > place:
                lowest = min(lowest, cell)
        place += 2


def _keep(cell: int, page: bytes, pages: _Pages, found: _Found) -> None:
    """Add the row of a cell, if it is sound, and none of a later epoch is known."""
    length, place = _number(page, cell)
    seq, place = _number(page, place)
    if not 0 < length < _MOST:
        return
    payload = _payload(page, place, length, pages)
    _, epoch, wall, text, checksum = _record(payload)
    row = row_of((seq, epoch, wall, text, checksum))
    if row is not None and (seq not in found or found[seq].epoch <= row.epoch):
        found[seq] = row


def _payload(page: bytes, place: int, length: int, pages: _Pages) -> bytes:
    """Return a row's payload, which may continue in overflow pages."""
    usable = len(page)
    most, least = usable - 35, (usable - 12) * 32 // 255 - 23
    if length <= most:
        return page[place : place + length]
    here = least + (length - least) % (usable - 4)
    here = here if here <= most else least
    parts, left = [page[place : place + here]], length - here
    following = int.from_bytes(page[place + here : place + here + 4], "big")
    while left > 0:
        more = pages.get(following)
        if more is None:
            raise ValueError
        parts.append(more[4 : 4 + left])
        left -= usable - 4
        following = int.from_bytes(more[:4], "big")
    return b"".join(parts)


def _record(payload: bytes) -> tuple[object, ...]:
    """Return the five columns of a row."""
    head, place = _number(payload, 0)
    kinds = []
    while place < head:
        kind, place = _number(payload, place)
        kinds.append(kind)
    columns: list[object] = []
    for kind in kinds:
        if kind >= 13:
            width = (kind - 13) // 2
            columns.append(payload[place : place + width])
        else:
            width = _WIDTHS[kind]
            number = int.from_bytes(payload[place : place + width], "big", signed=True)
            columns.append(number if width else _WITHOUT_WIDTH.get(kind))
        place += width
    if len(columns) != 5 or place != len(payload):
        raise ValueError
    return tuple(columns)


_WIDTHS = {0: 0, 1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 8: 0, 9: 0}
_WITHOUT_WIDTH = {8: 0, 9: 1}


def _number(data: bytes, place: int) -> tuple[int, int]:
    """Read one of SQLite's numbers of one to nine bytes; return it and where it ends."""
    number = 0
    for _ in range(8):
        byte = data[place]
        place += 1
        number = number << 7 | byte & 0x7F
        if byte < 0x80:
            return number, place
    return number << 8 | data[place], place + 1
