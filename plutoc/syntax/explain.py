"""Why the parser cannot go on here: the diagnostic of one mistake."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.newlines import CLOSING, END, EQUAL, NAME, NEWLINE, OPENING, WORDS
from plutoc.syntax.state import State, made_up, span, would_feed
from plutoc.syntax.words import expected, found

_LINE_WORDS = ("use", "app")
_STATEMENT_WORDS = ("category", "action", "evaluator", "modifier", "policy")
_TAIL_WORDS = frozenset({"WHEN", "OTHERWISE", "CAN", "EMITS", "WRITES", "AS"})
_ADDABLE = {
    "COLON": ":",
    "COMMA": ",",
    EQUAL: "=",
    "_ARROW": "->",
    "LPAR": "(",
    "RPAR": ")",
    "LSQB": "[",
    "RSQB": "]",
    "LBRACE": "{",
}
"""Tokens whose lack can be mended by writing them: the first that fits is proposed."""


def explain(
    source: Source,
    state: State,
    tokens: Sequence[Token],
    line: int,
    i: int,
    apps: Sequence[Token],
) -> Diagnostic:
    """Say what is wrong with the i-th token; its line begins at `line`."""
    token, here = tokens[i], _place(tokens, i)
    accepts = state.accepts()
    if token.type == "OPEN_TEXT":
        return errors.open_text(source, here)
    if token.type == "UNKNOWN":
        return errors.unknown_character(source, here)
    if token.type == END and "APP" in accepts:
        return errors.no_app(source, here)
    if token.type in (NEWLINE, END, "RBRACE"):
        left_open = _left_open(tokens, line, i)
        if left_open is not None:
            return errors.never_closed(source, span(left_open), here)
    if token.type == "APP" and len(apps) > 1:
        return errors.second_app(source, here, span(apps[0]))
    if token.type == "USE" and i == line:
        return errors.late_use(source, here)
    if _is_reserved(tokens, line, i, accepts):
        return errors.reserved_word(source, here)
    first = tokens[line]
    if i == line + 1 and first.type.lower() in _STATEMENT_WORDS and token.type in (EQUAL, "_ARROW"):
        return errors.reserved_word(source, span(first))
    help, fix = _help(state, tokens, line, i, accepts)
    return errors.unexpected(source, here, expected(accepts), found(token), help, fix)


def _is_reserved(tokens: Sequence[Token], line: int, i: int, accepts: set[str]) -> bool:
    """Say whether one of the language's words stands where only a name can."""
    kind = tokens[i].type
    if kind.lower() not in WORDS or NAME not in accepts:
        return False
    return i > line or tokens[i + 1].type in (EQUAL, "_ARROW")


def _left_open(tokens: Sequence[Token], line: int, i: int) -> Token | None:
    """Return the innermost bracket of this line, or else brace of this file, left open."""
    start = 0 if tokens[i].type == END else line
    left: list[Token] = []
    for token in tokens[start:i]:
        if token.type in OPENING or token.type == "LBRACE":
            left.append(token)
        elif (token.type in CLOSING or token.type == "RBRACE") and left:
            left.pop()
        elif token.type == NEWLINE:
            left = [token for token in left if token.type == "LBRACE"]
    return left[-1] if left else None


def _help(
    state: State, tokens: Sequence[Token], line: int, i: int, accepts: set[str]
) -> tuple[str | None, Fix | None]:
    """Say how to mend it, where that is clear."""
    token, first = tokens[i], tokens[line]
    if token.type == NAME:
        possible = [word for word in WORDS if word.upper() in accepts]
        near = difflib.get_close_matches(token.casefold(), possible, 1, 0.7)
        if near:
            return _meant(token, near[0])
    if i == line + 1 and first.type == NAME:
        possible = [*_STATEMENT_WORDS, *_LINE_WORDS]
        near = difflib.get_close_matches(first.casefold(), possible, 1, 0.7)
        if near and (token.type == NAME or near[0].upper() == token.type):
            return _meant(first, near[0])
    if token.type.upper() in _TAIL_WORDS and i == line:
        return f"`{token}` goes on the line of the statement that it belongs to", None
    if token.type == NEWLINE and i > line and tokens[i - 1].type == "_ARROW":
        return "to go on in the next line, begin that one with `->`", None
    if token.type == "QUANTITY" and NAME in accepts:
        return "a name begins with a letter", None
    arrow = token.type == NAME and token[:1].islower()  # a block, where a kind may be meant, too
    for kind, text in _ADDABLE.items():
        if kind == EQUAL and arrow:
            continue
        if kind in accepts and would_feed(state, [made_up(kind, text), *tokens[i : i + 2]]):
            at = tokens[i - 1].end_pos or 0
            return f"write `{text}` before it", Fix(span=Span(at, at), text=text)
    return None, None


def _meant(token: Token, word: str) -> tuple[str, Fix]:
    return f"did you mean `{word}`?", Fix(span=span(token), text=word)


def _place(tokens: Sequence[Token], i: int) -> Span:
    """Return where to point. What ends a line or the file is missed behind the token before it."""
    token = tokens[i]
    if token.type in (NEWLINE, END) and i:
        end = tokens[i - 1].end_pos or 0
        if tokens[i - 1].type == NEWLINE and i > 1:
            end = tokens[i - 2].end_pos or 0
        return Span(end, end)
    return span(token)
