"""A token: a piece of a source that means something, its type, and where it stands."""

from __future__ import annotations

from typing import Self

from plutoc.source import Span


class Token(str):
    """A text that knows its type and its place. A string: so nothing is copied to look at it."""

    __slots__ = ("end_pos", "line", "start_pos", "type")

    type: str
    start_pos: int
    end_pos: int
    line: int

    def __new__(cls, type: str, text: str, start_pos: int, end_pos: int, line: int) -> Self:
        """Return a token; `line` is the one that it begins on, from 1."""
        token = str.__new__(cls, text)
        token.type = type
        token.start_pos = start_pos
        token.end_pos = end_pos
        token.line = line
        return token

    def of_type(self, type: str) -> Token:
        """Return the same token as one of another type."""
        return Token(type, self, self.start_pos, self.end_pos, self.line)


def made_up(kind: str, text: str) -> Token:
    """Return a token that the source does not have, to stand where it should have it."""
    return Token(kind, text, 0, 0, 1)


def span(token: Token) -> Span:
    """Return the place of a token."""
    return Span(token.start_pos, token.end_pos)
