"""Tokens: which types there are, where each stands, and how they are called in messages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
OWNERS = ("mission", "trip")
HAS = "has"
RESULT = "result"
TAKES = "takes"
REACTING = ("event", "creator")
SOFT_WORDS = (*SETTINGS, *OWNERS, HAS, RESULT, TAKES, *REACTING)
"""Words too, but only in statements of theirs: elsewhere they are names like any other."""

SETTING_KINDS = frozenset(word.upper() for word in SETTINGS)
OWNER_KINDS = frozenset(word.upper() for word in OWNERS)
REACTING_KINDS = frozenset(word.upper() for word in REACTING)
SOFT_KINDS = frozenset(word.upper() for word in SOFT_WORDS)
BEGINNERS = SETTING_KINDS | OWNER_KINDS | REACTING_KINDS | {"RESULT"}
BEGINNERS |= {"CATEGORY", "ACTION", "EVALUATOR", "MODIFIER", "POLICY"}

_NAMED = {
    "NAME": "a name",
    "NUMBER": "a number",
    "QUANTITY": "a quantity",
    "TEXT": "a text in quotes",
    "_ARROW": "`->`",
    "EQUAL": "`=`",
    "DOT": "`.`",
    "COLON": "`:`",
    "COMMA": "`,`",
    "LPAR": "`(`",
    "RPAR": "`)`",
    "LSQB": "`[`",
    "RSQB": "`]`",
    "LBRACE": "`{`",
    "RBRACE": "`}`",
    **{word.upper(): f"`{word}`" for word in (*WORDS, *SOFT_WORDS)},
    NEWLINE: "the end of the line",
    END: "the end of the file",
}

_GROUPS = (
    (frozenset({"NAME", "CATEGORY", "MODIFIER", "LSQB"}), "a declaration or an edge"),
    (frozenset({"NUMBER", "QUANTITY", "TEXT", "NAME", "LSQB"}), "a value"),
)
"""What is too long to tell one by one."""

_IN_A_STATEMENT = SETTING_KINDS | OWNER_KINDS | REACTING_KINDS
_IN_A_STATEMENT |= {"RESULT", "ACTION", "EVALUATOR", "POLICY"}


def made_up(kind: str, text: str) -> Token:
    """Return a token that the source does not have, to stand where it should have it."""
    return Token(kind, text, 0, 1, 1, 1, 1, 0)


def span(token: Token) -> Span:
    """Return the place of a token."""
    return Span(token.start_pos or 0, token.end_pos or 0)


def expected(types: Iterable[str], name: str = "a name") -> str:
    """Say what could stand here: "`,` or `)`"; `name` is what a name would be."""
    left = set(types)
    said = []
    for group, words in _GROUPS:
        if group <= left:
            said.append(words)
            left -= group | _IN_A_STATEMENT
    for kind, words in _NAMED.items():
        if kind in left:
            said.append(name if kind == "NAME" else words)
    return joined(said, "or")


def found(token: Token) -> str:
    """Say what stands here instead."""
    return _NAMED[token.type] if token.type in (NEWLINE, END) else f"`{shortened(token)}`"


def shortened(text: str, longest: int = 30) -> str:
    """Cut a long text, so that it does not fill the message."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def joined(words: Sequence[str], last: str) -> str:
    """Join with commas, and with `last`, an "or" or an "and", before the last one."""
    return f" {last} ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
