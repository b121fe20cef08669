"""Tokens that are in order and yet not read: numbers that are too long, brackets that are too deep."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from plutoc.syntax.newlines import CLOSING, NEWLINE, OPENING
from plutoc.syntax.tokens import Token

DEEPEST = 64
"""How deep brackets are nested at most."""
MOST_DIGITS = 15
"""How many digits a number has at most: what a 64-bit float keeps."""


def marked(tokens: Iterable[Token]) -> Iterator[Token]:
    """Give each such token a type of its own, which no rule of the grammar takes."""
    depth = 0
    for token in tokens:
        if token.type in OPENING:
            depth += 1
            if depth > DEEPEST:
                token = token.of_type("TOO_DEEP")
        elif token.type in CLOSING:
            depth = max(depth - 1, 0)
        elif token.type == NEWLINE:
            depth = 0
        elif token.type in ("NUMBER", "QUANTITY") and digits(token) > MOST_DIGITS:
            token = token.of_type("LONG_NUMBER")
        yield token


def digits(token: Token) -> int:
    """Return how many digits a number has, its unit apart."""
    unit = token.lstrip("-0123456789.")
    return sum(map(str.isdigit, token[: len(token) - len(unit)]))
