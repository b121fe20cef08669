"""The place where something is being written: what stands around it in its statement."""

from __future__ import annotations

import re
from dataclasses import dataclass

from lark import Token

from plutoc.source import Span
from plutoc.syntax.fragment import Marked, marked
from plutoc.syntax.tokens import CLOSING, OPENING

MARK = "_here_"
"""Stands in the place of what is written; no app has a name that begins so."""

_BOM = "\ufeff"
_DIGITS = re.compile(r"[0-9]+")
_NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+)?[ \t]*")
_UNIT = re.compile(r"(?:%|[^\W\d]\w*(?:/\w*)?)?")
_SIGNS = {"LPAR": ")", "LSQB": "]"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Hole:
    """What is written at a place, and what stands around it."""

    span: Span
    """The word that has been begun; empty where there is none yet."""
    prefix: str
    """What of it stands before the cursor."""
    statement: Span
    """All of the statement, as far as it is written."""
    before: tuple[Token, ...]
    behind: tuple[Token, ...]
    above: tuple[str, ...]
    """With which tokens the statements before it begin."""
    inside: bool
    """It stands in the braces of the app."""
    of_number: str
    """The number whose unit it is, with the blanks behind it; else empty."""

    @property
    def types(self) -> tuple[str, ...]:
        """The types of the tokens before it."""
        return tuple(token.type for token in self.before)

    @property
    def next(self) -> str:
        """The type of the token behind it, or nothing."""
        return self.behind[0].type if self.behind else ""

    @property
    def opened(self) -> tuple[int, ...]:
        """Which tokens before it are brackets that are still open."""
        return tuple(_open(self.before))

    @property
    def closers(self) -> str:
        """The brackets that are left open by the whole statement."""
        tokens = (*self.before, *self.behind)
        return "".join(_SIGNS[tokens[i].type] for i in reversed(_open(tokens)))


def _open(tokens: tuple[Token, ...]) -> list[int]:
    stack: list[int] = []
    for i, token in enumerate(tokens):
        if token.type in OPENING:
            stack.append(i)
        elif token.type in CLOSING and stack:
            stack.pop()
    return stack


def hole(text: str, offset: int) -> Hole | None:
    """Return the hole at a place; None where nothing can be completed: in a comment, in a text."""
    offset = min(max(offset, 0), len(text))
    plain = f" {text[1:]}" if text.startswith(_BOM) else text
    word = _word(plain, offset)
    found = marked(plain[: word.start] + MARK + plain[word.end :], MARK)
    if found is None:
        return None
    token = found.line.tokens[found.at]
    number = ""
    statement = _original(found, word)
    if token.type == "QUANTITY":
        matched = _NUMBER.match(plain, token.start_pos or 0)
        assert matched is not None, "a quantity begins with a number"
        number = matched[0]
        unit = _UNIT.match(plain, matched.end())
        assert unit is not None
        word = Span(*unit.span())
        statement = Span(statement.start, max(statement.end, word.end))
        if offset < word.start:  # within the number
            return None
    elif token != MARK:
        return None
    return Hole(
        span=word,
        prefix=plain[word.start : offset],
        statement=statement,
        before=found.line.tokens[: found.at],
        behind=found.line.tokens[found.at + 1 :],
        above=tuple(line.first for line in found.above),
        inside=found.inside,
        of_number=number,
    )


def _word(text: str, offset: int) -> Span:
    start = end = offset
    while start and (text[start - 1].isalnum() or text[start - 1] == "_"):
        start -= 1
    while end < len(text) and (text[end].isalnum() or text[end] == "_"):
        end += 1
    digits = _DIGITS.match(text, start)
    return Span(min(digits.end(), offset) if digits else start, end)


def _original(found: Marked, word: Span) -> Span:
    """Return the place of the statement in the text without the mark."""
    longer = len(MARK) - (word.end - word.start)
    span = found.line.span
    return Span(min(span.start, word.start), max(span.end - longer, word.end))
