"""A text that people wrote, and places in it."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

LARGEST = 1 << 20
"""So long a source is read: in bytes of UTF-8."""


class Span(NamedTuple):
    """A stretch of a source, in characters from its beginning; the end is not included."""

    start: int
    end: int

    def to(self, other: Span) -> Span:
        """Return the stretch from the start of this one to the end of the other."""
        return Span(self.start, other.end)


@dataclass(frozen=True)
class Source:
    """A file's text and the path to call it by in messages."""

    path: str
    text: str

    @cached_property
    def _starts(self) -> list[int]:
        """Offsets at which lines begin. A byte order mark is no part of the first one."""
        starts = [int(self.text.startswith("\ufeff"))]
        starts.extend(i + 1 for i, char in enumerate(self.text) if char == "\n")
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Return the line and column of an offset, both from 1, in characters."""
        line = bisect_right(self._starts, offset) or 1
        return line, max(offset - self._starts[line - 1], 0) + 1

    def line(self, number: int) -> str:
        """Return one line, counted from 1, without its end."""
        start = self._starts[number - 1]
        end = self._starts[number] if number < len(self._starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")

    def quote(self, span: Span) -> str:
        """Return the text of a span."""
        return self.text[span.start : span.end]
