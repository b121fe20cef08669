"""What stands out in a source, as regular expressions: the first rule that fits a place wins.

The words, units, types and statuses are the compiler's own lists. The expressions keep to what
Python and Oniguruma, which editors use, both understand.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from json import dumps

from plutoc.block import IN_GRAPH
from plutoc.graph.model import END, START
from plutoc.syntax.tokens import HAS, OWNERS, REACTING, RESULT, SETTINGS, TAKES, WORDS
from plutoc_runtime.domain.quantities import UNITS, Type

_UNITS = "|".join(re.escape(unit) for unit in sorted(UNITS, key=len, reverse=True))


class Kind(Enum):
    """What a piece of a source is."""

    COMMENT = "comment"
    TEXT = "text"
    NUMBER = "number"
    PARAMETER = "the name before a colon"
    DECLARED = "the name before an equals sign"
    WORD = "a word of the language"
    CONSTANT = "a value, or how an action repeats"
    STATUS = "a status"
    TYPE = "a type of a parameter, a field or a result"
    TERMINAL = "start and end"
    BLOCK = "a kind of block"
    ARROW = "->"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A kind, and where it is found."""

    kind: Kind
    pattern: str


def _one_of(words: tuple[str, ...]) -> str:
    return rf"\b(?:{'|'.join(words)})\b"


RULES = (
    Rule(kind=Kind.COMMENT, pattern=r"#.*"),
    Rule(kind=Kind.TEXT, pattern=r'"(?:[^"\\\n]|\\.)*"?'),
    Rule(kind=Kind.NUMBER, pattern=rf"-?\b[0-9]+(?:\.[0-9]+)?(?:[ \t]*(?:{_UNITS})(?!\w))?"),
    Rule(kind=Kind.PARAMETER, pattern=r"\b[A-Za-z]\w*(?=[ \t]*:)"),
    Rule(kind=Kind.DECLARED, pattern=r"^[ \t]*[A-Za-z]\w*(?=[ \t]*=)"),
    Rule(kind=Kind.WORD, pattern=_one_of(WORDS)),
    Rule(kind=Kind.WORD, pattern=rf'(?<!app ){_one_of(SETTINGS)}(?=[ \t]*")'),
    Rule(kind=Kind.WORD, pattern=rf"{_one_of(OWNERS)}[ \t]+{HAS}\b(?=[ \t]+[A-Za-z])"),
    Rule(kind=Kind.WORD, pattern=rf"^[ \t]*{_one_of((RESULT,))}(?=[ \t]+[A-Za-z]\w*[ \t]+as\b)"),
    Rule(kind=Kind.WORD, pattern=rf"^[ \t]*{_one_of(REACTING)}(?=[ \t]+[A-Za-z])"),
    Rule(kind=Kind.WORD, pattern=rf"(?<=[\w)][ \t]){_one_of((TAKES,))}(?=[ \t]+\w)"),
    Rule(kind=Kind.CONSTANT, pattern=_one_of(("yes", "no", "safe", "once", "ask", "along"))),
    Rule(kind=Kind.STATUS, pattern=_one_of(tuple(status.value for status in IN_GRAPH))),
    Rule(kind=Kind.TYPE, pattern=_one_of(tuple(kind.value for kind in Type))),
    Rule(
        kind=Kind.TYPE, pattern=r"(?<=-> )\b(?:photo)\b(?=[ \t]*(?:$|#|safe|once|ask|along|takes))"
    ),
    Rule(kind=Kind.TERMINAL, pattern=_one_of((START, END))),
    Rule(kind=Kind.BLOCK, pattern=r"\b[A-Z]\w*"),
    Rule(kind=Kind.ARROW, pattern=r"->"),
)


SCOPES = {
    Kind.COMMENT: "comment.line.number-sign",
    Kind.TEXT: "string.quoted.double",
    Kind.NUMBER: "constant.numeric",
    Kind.PARAMETER: "variable.parameter",
    Kind.DECLARED: "entity.name.function",
    Kind.WORD: "keyword.other",
    Kind.CONSTANT: "constant.language",
    Kind.STATUS: "constant.other.status",
    Kind.TYPE: "support.type",
    Kind.TERMINAL: "variable.language",
    Kind.BLOCK: "entity.name.type",
    Kind.ARROW: "keyword.operator.arrow",
}


def grammar() -> str:
    """Return the grammar as the text of a `.tmLanguage.json` file."""
    patterns = [{"name": f"{SCOPES[rule.kind]}.pluto", "match": rule.pattern} for rule in RULES]
    whole = {
        "name": "Pluto",
        "scopeName": "source.pluto",
        "fileTypes": ["pluto"],
        "patterns": patterns,
    }
    return dumps(whole, indent=2) + "\n"
