"""A source as words, each with what stands between it and the next one.

The parser's tokens say where statements end; the text between two of them is blanks, newlines and
comments, for a source that was parsed holds nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from lark import Token

from plutoc.syntax.grammar import end_of, lexed
from plutoc.syntax.tokens import NEWLINE, span

COMMA, LBRACE, RBRACE = "COMMA", "LBRACE", "RBRACE"

_BLANKS = " \t\r"


@dataclass(frozen=True, slots=True, kw_only=True)
class Word:
    """A token as it is to be written, and what follows it."""

    kind: str
    text: str
    beside: str | None
    """The comment behind it on its line."""
    below: tuple[str, ...]
    """Comments on the lines below, up to the next word; an empty one stands for a blank line."""
    comma: bool = False
    """A comma follows; commas are no words."""
    last: bool = False
    """It ends a statement."""


def read(text: str) -> tuple[tuple[str, ...], Iterator[tuple[Word, ...]]]:
    """Return the comments before the first word of a sound source, and its words in lines.

    A line is a statement, or ends with a brace. An empty comment stands for a blank line.
    """
    tokens = lexed(text)
    before = text[: span(tokens[0]).start].split("\n")[:-1]
    return _stripped(before), _lines(_without_commas(_words(text, tokens)))


def _lines(words: Iterator[Word]) -> Iterator[tuple[Word, ...]]:
    line: list[Word] = []
    for word in words:
        line.append(word)
        if word.last or word.kind in (LBRACE, RBRACE):
            yield tuple(line)
            line = []
    assert not line, "the last word of a sound source is a brace"


def _words(text: str, tokens: Sequence[Token]) -> Iterator[Word]:
    beyond = end_of(text)
    words = [token for token in tokens if token.type != NEWLINE]
    ends = {id(token) for token, then in pairwise(tokens) if then.type == NEWLINE}
    for token, then in pairwise([*words, beyond]):
        gap = text[span(token).end : span(then).start].split("\n")
        if len(gap) > 1 and then is not beyond:
            gap.pop()  # the blanks before the next word
        beside, *below = _stripped(gap)
        yield Word(
            kind=token.type,
            text=_spaced(token) if token.type == "QUANTITY" else str(token),
            beside=beside or None,
            below=tuple(below),
            last=id(token) in ends,
        )


def _stripped(lines: Sequence[str]) -> tuple[str, ...]:
    return tuple(line.strip(_BLANKS) for line in lines)


def _spaced(quantity: str) -> str:
    """Write one blank between a number and its unit."""
    unit = quantity.lstrip("-0123456789.")
    return f"{quantity.removesuffix(unit)} {unit.strip(_BLANKS)}"


def _without_commas(words: Iterator[Word]) -> Iterator[Word]:
    """Make of each comma a mark at the word before it, which gets the comma's comments too."""
    before: Word | None = None
    for word in words:
        if word.kind == COMMA and before is not None:
            before = _with_comma(before, word)
            continue
        if before is not None:
            yield before
        before = word
    if before is not None:
        yield before


def _with_comma(word: Word, comma: Word) -> Word:
    below: Sequence[str] = comma.below
    beside = word.beside
    if beside is None and not any(word.below):
        beside = comma.beside
    elif comma.beside is not None:  # a line has one comment: this one moves to the next
        below = (comma.beside, *below)
    return replace(
        word, beside=beside, below=(*word.below, *below), comma=True, last=comma.last or word.last
    )
