"""A text that is changed in several steps, and the edits of the first text that come to the same."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from plutoc.diagnostic import Fix
from plutoc.edits import applied, without_statement
from plutoc.source import Source, Span
from plutoc.syntax.parse import read
from plutoc.syntax.tree import File, Statement

_COMMENT = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|(#[^\n]*)')
_INDENT = "  "


@dataclass(frozen=True, kw_only=True)
class Draft:
    """A text, and how it came about: pieces of the first one, and what was put between them.

    A step gives another draft; the places of a step are those of the draft that it is taken on.
    """

    source: Source
    pieces: tuple[Span | str, ...]

    @classmethod
    def of(cls, source: Source) -> Draft:
        """Return a text as it is."""
        return cls(source=source, pieces=(Span(0, len(source.text)),))

    @cached_property
    def file(self) -> File:
        """The tree of the text as it is now."""
        return read(self.source)[0]

    def changed(self, *fixes: Fix) -> Draft:
        """Return the text with changes made that do not overlap."""
        text = applied(self.source, fixes)
        crlf = "\r\n" in self.source.text[: self.source.text.find("\n") + 1]
        pieces = self.pieces
        for fix in sorted(fixes, key=lambda fix: fix.span, reverse=True):
            put = fix.text.replace("\n", "\r\n") if crlf else fix.text
            pieces = (*_before(pieces, fix.span.start), put, *_behind(pieces, fix.span.end))
        return Draft(source=Source(self.source.path, text), pieces=pieces)

    def edits(self, first: Source) -> tuple[Fix, ...]:
        """Return what makes this text of the first one: as little as its pieces allow."""
        found: list[Fix] = []
        at, put = 0, ""
        for piece in (*self.pieces, Span(len(first.text), len(first.text))):
            if isinstance(piece, str):
                put += piece
                continue
            if put or piece.start > at:
                found.append(_trimmed(first, Span(at, piece.start), put))
            at, put = piece.end, ""
        return tuple(fix for fix in found if fix.text or fix.span.end > fix.span.start)

    # Where statements stand

    def text(self, span: Span) -> str:
        """Return the text of a span, its lines ended as an edit writes them."""
        return self.source.quote(span).replace("\r\n", "\n")

    def comments(self, span: Span) -> list[str]:
        """Return the comments within a span."""
        text = self.source.quote(span)
        return [match[1].rstrip() for match in _COMMENT.finditer(text) if match[1]]

    def indent(self, statement: Statement) -> str:
        """Return the blanks before a statement, or two where something else stands there."""
        text = self.source.text
        before = text[text.rfind("\n", 0, statement.span.start) + 1 : statement.span.start]
        return before if not before.strip(" \t") else _INDENT

    def behind(self, end: int, text: str) -> Fix:
        """Return the edit that puts lines below the one where something ends."""
        line_end = self.line_end(end)
        tail = self.source.text[end:line_end].strip()
        if not tail or tail.startswith("#"):
            return Fix(span=Span(line_end, line_end), text=f"\n{text}")
        return Fix(span=Span(end, end), text=f"\n{text}\n")

    def line_end(self, at: int) -> int:
        """Return where the line of a place ends: before the sign that ends it."""
        end = self.source.text.find("\n", at)
        end = len(self.source.text) if end < 0 else end
        return end - self.source.text.startswith("\r\n", end - 1) if end > at else end

    def written(self, statement: Statement, text: str, left_out: Iterable[str] = ()) -> Fix:
        """Return the edit that puts text in a statement's place.

        Comments that stood within it, and have no place in the new text, come to stand above it.
        """
        indent = self.indent(statement)
        lines = [*left_out, *text.split("\n")] if text else list(left_out)
        before = self.source.text[: statement.span.start]
        alone = not before[before.rfind("\n") + 1 :].strip(" \t")
        if lines and lines[0].startswith("#") and not alone:
            lines.insert(0, "")
        behind = Span(statement.span.end, self.line_end(statement.span.end))
        if lines and lines[-1].startswith("#") and self.source.quote(behind).strip():
            lines.append("")
        return Fix(span=statement.span, text=f"\n{indent}".join(lines))

    def without(self, statement: Statement) -> Fix:
        """Return the edit that takes a statement out, and leaves every comment."""
        comments = self.comments(statement.span)
        whole = None if comments else without_statement(self.source, statement.span)
        return whole or self.written(statement, "", comments)


def _before(pieces: tuple[Span | str, ...], at: int) -> list[Span | str]:
    """Return what stands before a place of the text that the pieces make."""
    kept: list[Span | str] = []
    for piece in pieces:
        long = _length(piece)
        if at <= 0:
            break
        kept.append(piece if long <= at else _cut(piece, 0, at))
        at -= long
    return kept


def _behind(pieces: tuple[Span | str, ...], at: int) -> list[Span | str]:
    kept: list[Span | str] = []
    for piece in pieces:
        long = _length(piece)
        if at < long:
            kept.append(_cut(piece, max(at, 0), long))
        at -= long
    return kept


def _length(piece: Span | str) -> int:
    return len(piece) if isinstance(piece, str) else piece.end - piece.start


def _cut(piece: Span | str, start: int, end: int) -> Span | str:
    if isinstance(piece, str):
        return piece[start:end]
    return Span(piece.start + start, piece.start + end)


def _trimmed(first: Source, span: Span, put: str) -> Fix:
    """Return an edit without what it would put where it stands already."""
    old = first.quote(span)
    most = min(len(old), len(put))
    head = next((i for i in range(most) if old[i] != put[i]), most)
    most -= head
    tail = next((i for i in range(most) if old[-1 - i] != put[-1 - i]), most)
    # half of a line's end is no place to write at
    head -= put[:head].endswith("\r")
    if tail and put[len(put) - tail] == "\n" and put[: len(put) - tail].endswith("\r"):
        tail -= 1
    text = put[head : len(put) - tail].replace("\r\n", "\n")
    return Fix(span=Span(span.start + head, span.end - tail), text=text)
