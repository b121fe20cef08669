"""Places in a text: ours in characters, the protocol's in lines and in units that a client chose."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from lsprotocol.types import (
    Position,
    PositionEncodingKind,
    Range,
    TextDocumentContentChangeEvent,
    TextDocumentContentChangePartial,
)

from plutoc.source import Span

_LINE_END = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True, kw_only=True)
class Places:
    """A text, with its lines as the protocol counts them."""

    text: str
    encoding: str = PositionEncodingKind.Utf16

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in _LINE_END.finditer(self.text))]

    def offset(self, position: Position) -> int:
        """Return the character at a position; one beyond a line or the text is its end."""
        if position.line >= len(self._starts):
            return len(self.text)
        line = self._line(position.line)
        return self._starts[position.line] + self._characters(line, position.character)

    def span(self, range: Range) -> Span:
        """Return a range as a stretch of characters."""
        start = self.offset(range.start)
        return Span(start, max(start, self.offset(range.end)))

    def position(self, offset: int) -> Position:
        """Return the position of a character."""
        at = min(max(offset, 0), len(self.text))
        number = bisect_right(self._starts, at) - 1
        start = self._starts[number]
        return Position(line=number, character=self._units(self.text[start:at]))

    def range(self, span: Span) -> Range:
        """Return a stretch of characters as a range."""
        return Range(start=self.position(span.start), end=self.position(span.end))

    def changed(self, changes: Iterable[TextDocumentContentChangeEvent]) -> Places:
        """Return the text after changes, each of which counts from the one before."""
        now = self
        for change in changes:
            text = change.text
            if isinstance(change, TextDocumentContentChangePartial):
                start, end = now.span(change.range)
                text = now.text[:start] + text + now.text[end:]
            now = Places(text=text, encoding=self.encoding)
        return now

    def length(self, span: Span) -> int:
        """Return how many units a stretch within a line has."""
        return self._units(self.text[span.start : span.end])

    def _line(self, number: int) -> str:
        last = number + 1 == len(self._starts)
        end = len(self.text) if last else self._starts[number + 1]
        line = self.text[self._starts[number] : end]
        return line if last else _LINE_END.sub("", line)

    def _units(self, text: str) -> int:
        if text.isascii() or self.encoding == PositionEncodingKind.Utf32:
            return len(text)
        if self.encoding == PositionEncodingKind.Utf8:
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text) + sum(char > "\uffff" for char in text)

    def _characters(self, line: str, units: int) -> int:
        if line.isascii() or self.encoding == PositionEncodingKind.Utf32:
            return min(units, len(line))
        left = units
        for i, char in enumerate(line):
            if left <= 0:
                return i
            left -= self._units(char)
        return len(line)
