"""A piece of an app's text → its statements, as they stand at a place of a whole source."""

from __future__ import annotations

from dataclasses import dataclass

from lark import Token

from plutoc.source import Source, Span
from plutoc.syntax import build
from plutoc.syntax.grammar import lexed, tree_of
from plutoc.syntax.lines import Line, lines_of
from plutoc.syntax.tokens import END, NEWLINE, made_up, span
from plutoc.syntax.tree import Statement

_BEFORE = (
    *(("PLUTO", "pluto"), ("NUMBER", "1"), (NEWLINE, "")),
    *(("APP", "app"), ("NAME", ""), ("LBRACE", "{")),
)
_BEHIND = (("RBRACE", "}"), (NEWLINE, ""), (END, ""))


def statements_of(text: str, offset: int) -> tuple[Statement, ...] | None:
    """Return the statements of a text that stands at an offset; None where it cannot be read."""
    tokens = [_moved(token, offset) for token in lexed(text)]
    before, behind = ([made_up(*one) for one in each] for each in (_BEFORE, _BEHIND))
    node = tree_of([*before, *tokens, *behind])
    return None if node is None else build.file(Source("", ""), node).app.statements


def _moved(token: Token, by: int) -> Token:
    token.start_pos = (token.start_pos or 0) + by
    token.end_pos = (token.end_pos or 0) + by
    return token


@dataclass(frozen=True, slots=True, kw_only=True)
class Marked:
    """The statement in which a mark stands, and where that is in its source."""

    line: Line
    at: int
    """Which of its tokens holds the mark."""
    inside: bool
    """It stands in the braces of the app."""
    above: tuple[Line, ...]
    """What stands before it."""


def marked(text: str, mark: str) -> Marked | None:
    """Find the statement in which a mark stands; None where that is in a comment."""
    lines = lines_of([*lexed(text), made_up(END, "")])
    for i, line in enumerate(lines):
        for at, token in enumerate(line.tokens):
            if mark in token:
                opened = any(one.tokens[-1].type == "LBRACE" for one in lines[:i])
                closed = any(one.first == "RBRACE" for one in lines[:i])
                still = any(one.first == "RBRACE" for one in lines[i:])
                inside = opened and (still or not closed)
                return Marked(line=line, at=at, inside=inside, above=tuple(lines[:i]))
    return None


def tokens_of(text: str) -> list[Token]:
    """Return the words and signs of a whole source, comments left out."""
    if text.startswith("\ufeff"):
        text = f" {text[1:]}"
    return [token for token in lexed(text) if token.type != NEWLINE]


def word_at(text: str, offset: int) -> tuple[str, Span, str] | None:
    """Return the token in which a place lies, where it is and its type; None in blanks and comments."""
    for token in tokens_of(text):
        where = span(token)
        if where.start <= offset < where.end:
            return str(token), where, token.type
    return None
