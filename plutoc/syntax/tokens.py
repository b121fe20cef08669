"""Tokens: which types there are, and where each stands."""

from __future__ import annotations

from lark import Token

from plutoc.source import Span

COMMENT, NEWLINE, END = "COMMENT", "_NL", "$END"
NAME, ARROW, EQUAL = "NAME", "_ARROW", "EQUAL"
OPENING = {"LPAR": "RPAR", "LSQB": "RSQB"}
CLOSING = frozenset(OPENING.values())

WORDS = (
    *("pluto", "use", "as", "app", "category", "can", "action", "evaluator", "modifier", "policy"),
    *("emits", "writes", "when", "otherwise"),
)
"""The language's own words. Each is a terminal of the grammar, named in capitals."""

SETTINGS = ("version", "requires")
"""Words too, but only where they begin a statement: elsewhere they are names like any other."""

SETTING_KINDS = frozenset(word.upper() for word in SETTINGS)
BEGINNERS = SETTING_KINDS | {"CATEGORY", "ACTION", "EVALUATOR", "MODIFIER", "POLICY"}


def made_up(kind: str, text: str) -> Token:
    """Return a token that the source does not have, to stand where it should have it."""
    return Token(kind, text, 0, 1, 1, 1, 1, 0)


def span(token: Token) -> Span:
    """Return the place of a token."""
    return Span(token.start_pos or 0, token.end_pos or 0)
