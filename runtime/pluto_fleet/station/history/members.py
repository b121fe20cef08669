"""The members of a recording's file: each is read whole, or up to where it was cut off."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

GZIP = 31
"""What zlib calls the format of gzip."""

LARGEST_READ = 64 * 1024 * 1024
"""Bytes of one member's lines: a larger one was not written by a station."""

_BEGIN = b"\x1f\x8b\x08\x00"
"""How each member begins."""

_AT_ONCE = 64 * 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """One member of the file, with its whole lines."""

    begins: int
    ends: int
    """Where it stands in the file, in bytes."""
    lines: list[bytes]
    """None of an unsound one: what is said there may be anything."""
    torn: bool = False
    """Whether the file ends before it does."""
    sound: bool = True


def members(file: BinaryIO, begins: int = 0) -> Iterator[Member]:
    """Yield the members that begin here or later; unsound ones end where the next one begins."""
    while True:
        file.seek(begins)
        inflater, text, sound = zlib.decompressobj(GZIP), bytearray(), True
        while not inflater.eof and sound and (packed := file.read(_AT_ONCE)):
            try:
                text += inflater.decompress(packed, LARGEST_READ - len(text))
            except zlib.error:
                sound = False
            sound &= len(text) < LARGEST_READ
        if not sound:
            ends = _next_begin(file, begins + 1)
            yield Member(begins=begins, ends=ends, lines=[], sound=False)
        elif inflater.eof:
            ends = file.tell() - len(inflater.unused_data)
            yield Member(begins=begins, ends=ends, lines=_lines(text))
        else:
            if (ends := file.tell()) > begins:
                yield Member(begins=begins, ends=ends, lines=_lines(text), torn=True)
            return
        begins = ends


def kept(path: Path) -> tuple[int | None, list[bytes], list[bytes]]:
    """Return how many bytes of a file to keep, the lines to write anew, and the last lines of both.

    Those to write anew are of a last member that was cut off. The number is None if there is no
    such file.
    """
    try:
        with path.open("rb") as file:
            ends, last = 0, list[bytes]()
            for member in members(file):
                last = member.lines or last
                if member.torn:
                    return member.begins, [line + b"\n" for line in member.lines], last
                ends = member.ends
            return ends, [], last
    except FileNotFoundError:
        return None, [], []


def _lines(text: bytearray) -> list[bytes]:
    return bytes(text[: text.rfind(b"\n") + 1]).splitlines()


def _next_begin(file: BinaryIO, begins: int) -> int:
    """Return where the next member may begin, or the end of the file."""
    while True:
        file.seek(begins)
        packed = file.read(_AT_ONCE)
        found = packed.find(_BEGIN)
        if found >= 0:
            return begins + found
        if len(packed) < _AT_ONCE:
            return begins + len(packed)
        begins += len(packed) - len(_BEGIN) + 1
