"""From text to the parser's tokens.

The patterns are those of the grammar, in the order in which Lark would try them (tables.py): one
alternation, of which the first that fits is taken. Every text has tokens: what no rule takes is a
token too.
"""

from __future__ import annotations

import re

from plutoc.syntax.newlines import COMMENT, NEWLINE, ended
from plutoc.syntax.tokens import Token
from plutoc_grammar.tables import IGNORED, TERMINALS, WORDS

_TOKEN = re.compile("|".join(f"(?P<{name}>{pattern})" for name, pattern in TERMINALS))


def lexed(text: str) -> list[Token]:
    """Return the tokens that the parser is to see."""
    return list(ended([token for token in scanned(text) if token.type != COMMENT]))


def scanned(text: str) -> list[Token]:
    """Return all tokens of a text, comments and every newline too."""
    tokens = []
    line = 1
    for match in _TOKEN.finditer(text):
        kind = match.lastgroup or ""
        if kind in IGNORED:
            continue
        found = match[0]
        start, end = match.span()
        kind = WORDS.get(found, kind)
        tokens.append(Token(kind, found, start, end, line))
        if kind == NEWLINE:
            line += 1  # no other token goes on in the next line
    return tokens
