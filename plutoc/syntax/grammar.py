"""Lark's parser, made of the grammar once and kept in the user's own cache folder.

Only a source with a mistake needs it: what is in order is read with its tables alone (lalr.py).
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from io import BytesIO
from pkgutil import get_data

import lark
from lark.lark import PostLex
from lark.lexer import BasicLexer, Token

from plutoc.cache import cache_file, keep, kept
from plutoc.syntax.newlines import COMMENT, NEWLINE

START = "file"


class AllTokens(PostLex):
    """Makes Lark keep the terminals that no rule takes."""

    always_accept = (COMMENT, NEWLINE, "OPEN_TEXT", "UNKNOWN")

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        """Give the tokens as they are: what the newlines mean is said in newlines.py."""
        return stream


@cache
def parser() -> lark.Lark:
    """Return the parser of the language."""
    parser = _kept_or_made(_grammar())
    parser.lexer = BasicLexer(parser.lexer_conf)  # else it makes one for each text, however short
    return parser


def made() -> lark.Lark:
    """Return the parser, made of the grammar just now."""
    return _made(_grammar())


def _grammar() -> str:
    return (get_data("plutoc_grammar", "pluto.lark") or b"").decode()


def _kept_or_made(grammar: str) -> lark.Lark:
    python = ".".join(map(str, sys.version_info[:2]))
    file = cache_file(f"grammar-lark{lark.__version__}-py{python}")
    if file is None:
        return _made(grammar)
    made_of = repr((lark.__version__, sys.version, _OPTIONS, AllTokens, grammar)).encode()
    data = kept(file, made_of)
    if data is not None:
        return lark.Lark.load(BytesIO(data))
    made, text = _made(grammar), BytesIO()
    made.save(text)
    keep(file, made_of, text.getvalue())
    return made


_OPTIONS = (
    ("start", START),
    ("parser", "lalr"),
    ("lexer", "basic"),
    ("propagate_positions", True),
    ("maybe_placeholders", True),
)


def _made(grammar: str) -> lark.Lark:
    return lark.Lark(grammar, postlex=AllTokens(), **dict(_OPTIONS))
