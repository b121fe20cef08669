"""What can be told of a statement that cannot be read."""

from __future__ import annotations

import re

from plutoc.source import Source
from plutoc.syntax.lines import Line
from plutoc.syntax.newlines import BEGINNERS, EQUAL, NAME, SETTING_KINDS
from plutoc.syntax.tokens import Token, span
from plutoc.syntax.tree import BadStatement, Name

_IN_A_FLOW = frozenset({NAME, "_ARROW", "COMMA", "LSQB", "RSQB", "WHEN", "OTHERWISE", "UNKNOWN"})

_UP_TO_BLANK = re.compile(r"\w[^\s(]*")
_EQUAL_SIGN = "="


def bad_statement(source: Source, line: Line) -> BadStatement:
    """Return what is left of a line: what it was to be, and what it declares."""
    kind, name, head = _declared(source, line)
    return BadStatement(
        kind=kind,
        name=name,
        head=head,
        span=line.span,
    )


def _declared(source: Source, line: Line) -> tuple[str | None, Name | None, str | None]:
    """Return the kind of a statement, the name that it declares, or else what stands there."""
    tokens = line.tokens
    second = tokens[1].type if len(tokens) > 1 else ""
    if line.first in SETTING_KINDS:
        return line.first.lower(), None, None
    if line.first in (*BEGINNERS, "USE", "APP") and second != EQUAL:
        kind = line.first.lower()
        rest = source.quote(line.span)[len(tokens[0]) :].strip()
        written = _UP_TO_BLANK.match(rest)
        head = written[0] if written else ""
        if second == NAME and head == tokens[1]:
            return kind, _name(tokens[1]), None
        return kind, None, None if kind == "app" else head
    equals = next((i for i, token in enumerate(tokens) if token.type == EQUAL), None)
    if equals is None:
        if tokens[0].type == NAME and (
            second == "COLON" or (second == NAME and tokens[1][:1].isupper())
        ):
            return "block", _name(tokens[0]), None
        text = source.quote(line.span)
        if _EQUAL_SIGN in text:  # within a text that is left open
            return "block", None, "".join(text.partition(_EQUAL_SIGN)[0].split())
        if len(tokens) == 1 and tokens[0].type == NAME:  # the rest may be behind a stray `#`
            return "block", _name(tokens[0]), None
        types = {token.type for token in tokens}
        is_flow = "_ARROW" in types and types <= _IN_A_FLOW
        return "flow" if is_flow else None, None, None
    if equals == 1 and tokens[0].type == NAME:
        return "block", _name(tokens[0]), None
    start = span(tokens[0])
    head = source.quote(start.to(span(tokens[equals - 1]))) if equals else ""
    return "block", None, "".join(head.split())


def _name(token: Token) -> Name:
    return Name(text=str(token), span=span(token))
