"""The rules as a lexer of Pygments, which colours pages and terminals.

Pygments finds it by its entry point; the compiler itself needs no Pygments.
"""

from __future__ import annotations

import re
from typing import ClassVar

from pygments import token
from pygments.lexer import RegexLexer

from plutoc.highlight.rules import RULES, Kind

_TOKENS = {
    Kind.COMMENT: token.Comment.Single,
    Kind.TEXT: token.String.Double,
    Kind.NUMBER: token.Number,
    Kind.PARAMETER: token.Name.Attribute,
    Kind.DECLARED: token.Name.Variable,
    Kind.WORD: token.Keyword,
    Kind.CONSTANT: token.Keyword.Constant,
    Kind.STATUS: token.Name.Constant,
    Kind.TYPE: token.Keyword.Type,
    Kind.TERMINAL: token.Name.Builtin,
    Kind.BLOCK: token.Name.Class,
    Kind.ARROW: token.Operator,
}


class PlutoLexer(RegexLexer):
    """Colours Pluto sources."""

    name = "Pluto"
    aliases = ("pluto",)
    filenames = ("*.pluto",)
    flags = re.MULTILINE
    tokens: ClassVar = {
        "root": [
            *((rule.pattern, _TOKENS[rule.kind]) for rule in RULES),
            (r"\w+", token.Name),
            (r"\s+", token.Whitespace),
            (r"[=.:,(){}\[\]]", token.Punctuation),
            (r".", token.Error),
        ]
    }
