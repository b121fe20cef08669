"""The parser, made of the grammar once and kept in the user's own cache folder."""

from __future__ import annotations

import sys
from functools import cache
from io import BytesIO
from pkgutil import get_data

import lark
from lark.lexer import BasicLexer

from plutoc.syntax.cache import cache_file, keep, kept
from plutoc.syntax.newlines import Newlines


@cache
def parser() -> lark.Lark:
    """Return the parser of the language."""
    grammar = (get_data("plutoc_grammar", "pluto.lark") or b"").decode()
    parser = _kept_or_made(grammar)
    parser.lexer = BasicLexer(parser.lexer_conf)  # else it makes one for each text, however short
    return parser


def _kept_or_made(grammar: str) -> lark.Lark:
    python = ".".join(map(str, sys.version_info[:2]))
    file = cache_file(f"grammar-lark{lark.__version__}-py{python}")
    if file is None:
        return _made(grammar)
    made_of = repr((lark.__version__, sys.version, _OPTIONS, grammar)).encode()
    data = kept(file, made_of)
    if data is not None:
        return lark.Lark.load(BytesIO(data))
    made, text = _made(grammar), BytesIO()
    made.save(text)
    keep(file, made_of, text.getvalue())
    return made


_OPTIONS = (
    ("start", "file"),
    ("parser", "lalr"),
    ("lexer", "basic"),
    ("propagate_positions", True),
    ("maybe_placeholders", True),
)


def _made(grammar: str) -> lark.Lark:
    return lark.Lark(grammar, postlex=Newlines(), **dict(_OPTIONS))
