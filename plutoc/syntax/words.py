"""The parser's tokens in words for a person."""

from __future__ import annotations

from collections.abc import Iterable

from lark import Token

from plutoc.syntax.tokens import END, NEWLINE, SETTING_KINDS, SETTINGS, WORDS

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
    **{word.upper(): f"`{word}`" for word in (*WORDS, *SETTINGS)},
    NEWLINE: "the end of the line",
    END: "the end of the file",
}

_GROUPS = (
    (frozenset({"NAME", "CATEGORY", "MODIFIER", "LSQB"}), "a declaration or an edge"),
    (frozenset({"NUMBER", "QUANTITY", "TEXT", "NAME", "LSQB"}), "a value"),
)
"""What is too long to tell one by one."""

_IN_A_STATEMENT = SETTING_KINDS | {"ACTION", "EVALUATOR", "POLICY"}


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
    return alternatives(said)


def found(token: Token) -> str:
    """Say what stands here instead."""
    return _NAMED[token.type] if token.type in (NEWLINE, END) else f"`{shortened(token)}`"


def shortened(text: str, longest: int = 30) -> str:
    """Cut a long text, so that it does not fill the message."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def alternatives(words: list[str]) -> str:
    """Join with commas and an "or" before the last one."""
    return " or ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
