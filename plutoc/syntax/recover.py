"""Error recovery: a diagnostic for every syntax error, and a tree of all that can be read.

Only called where there is a mistake. Each line is judged by itself (lines.py says what a line is);
what the parser refuses becomes a `BadStatement`, and the rest is parsed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from lark import Token

from plutoc.diagnostic import Diagnostic
from plutoc.source import Source, Span
from plutoc.syntax import build
from plutoc.syntax.explain import explain
from plutoc.syntax.grammar import State, beginning, copied, feeds, tree_of
from plutoc.syntax.lines import (
    Line,
    goes_on,
    is_exchanged,
    is_shifted,
    is_split,
    is_torn,
    joined,
    lines_of,
)
from plutoc.syntax.sections import sections
from plutoc.syntax.tokens import BEGINNERS, END, EQUAL, NAME, NEWLINE, SOFT_KINDS, made_up, span
from plutoc.syntax.tree import BadStatement, File, Name

MOST_MISTAKES = 1_000
"""Of more mistakes in one source nothing is told: that many are not read."""

_HEADER = (("PLUTO", "pluto"), ("NUMBER", "1"), (NEWLINE, ""))
_APP = (("APP", "app"), ("NAME", ""), ("LBRACE", "{"))
_ABOVE = "if this belongs to the line above, join the two"
_BELOW = "if the next line belongs to this one, join the two"
_CLOSING = (("RBRACE", "}"), (NEWLINE, ""), (END, ""))


_IN_A_FLOW = frozenset({NAME, "_ARROW", "COMMA", "LSQB", "RSQB", "WHEN", "OTHERWISE", "UNKNOWN"})
_UP_TO_BLANK = re.compile(r"\w[^\s(]*")
_EQUAL_SIGN = "="


@dataclass(frozen=True, slots=True, kw_only=True)
class _LineInPlace:
    """A line, and the parser as it stands before it."""

    line: Line
    base: State
    silent: bool = False
    """Whether what is wrong with it is told already."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Outcome:
    """The lines that can be read, and what is left of the others."""

    good: tuple[Line, ...]
    bad: tuple[BadStatement, ...]


def recover(source: Source, tokens: Sequence[Token]) -> tuple[File, list[Diagnostic]]:
    """Return the tree of tokens that are not in order, and why they are not."""
    found: list[Diagnostic] = []
    parts = sections(source, lines_of(tokens), tokens[-1], found)
    start, outside, inside = beginning(), _fed(_HEADER), _fed((*_HEADER, *_APP))
    head = [_LineInPlace(line=parts.header, base=start)] if parts.header else []
    app = [_LineInPlace(line=parts.app, base=outside)] if parts.app else []
    judged = _judged(
        source,
        [
            *head,
            *(_LineInPlace(line=line, base=outside) for line in parts.before),
            *app,
            *(_LineInPlace(line=line, base=inside) for line in parts.body),
            *(_LineInPlace(line=line, base=inside, silent=True) for line in parts.behind),
        ],
        parts.app.tokens[0] if parts.app else None,
        found,
    )
    good = set(map(id, judged.good))
    opens = parts.app is not None and parts.app.tokens[-1].type == "LBRACE"
    named = opens and id(parts.app) in good
    clean = _made_up(_HEADER)
    clean += [token for line in parts.before if id(line) in good for token in line.ended]
    clean += parts.app.tokens if parts.app and named else _made_up(_APP)
    for line in (*parts.body, *parts.behind):
        clean += line.ended if id(line) in good else []
    clean += _made_up(_CLOSING)
    node = tree_of(clean)
    assert node is not None, "each of its lines can be read"
    file = build.file(source, node)
    return _with_bad(file, parts.app, judged.bad, named), found


def _judged(
    source: Source, placed: Sequence[_LineInPlace], app: Token | None, found: list[Diagnostic]
) -> _Outcome:
    good: list[Line] = []
    bad: list[BadStatement] = []
    previous: _LineInPlace | None = None  # a good one right before
    i = 0
    while i < len(placed):
        each = placed[i]
        line = each.line
        state, at = _failing(each)
        i += 1
        if at is None:
            good.append(line)
            previous = each
            continue
        if len(found) >= MOST_MISTAKES:  # to ask of each why it is wrong takes its time
            bad.append(bad_statement(source, line))
            previous = None
            continue
        lines = [line]
        above = below = False
        if previous and (
            is_split(source, previous.base, previous.line, line)
            or is_shifted(source, previous.line, each.base, line)
        ):
            good.pop()
            lines.insert(0, previous.line)
            above = True
        elif i < len(placed):
            following = placed[i]
            if _failing(following)[1] is None:  # by itself in order, but perhaps torn
                below = len(line.tokens) == 1 and is_torn(source, each.base, line, following.line)
            else:
                below = is_split(source, each.base, line, following.line) or is_exchanged(
                    source, each.base, line, following.base, following.line
                )
        if below:
            lines.append(placed[i].line)
            i += 1
        if not each.silent:
            tokens = [*line.tokens, line.end]
            why = explain(source, each.base, state, tokens, at, app)
            if (above or below) and why.help is None:
                why = replace(why, help=_ABOVE if above else _BELOW)
            found.append(why)
        while i < len(placed) and goes_on(placed[i].line) and _failing(placed[i])[1] is not None:
            lines.append(placed[i].line)
            i += 1
        bad.append(bad_statement(source, joined(lines)))
        previous = None
    return _Outcome(good=tuple(good), bad=tuple(bad))


def _failing(placed: _LineInPlace) -> tuple[State, int | None]:
    """Return the parser where it cannot go on in a line, and at which token; None: it can."""
    state = copied(placed.base)
    for i, token in enumerate(placed.line.ended):
        if not feeds(state, token):
            return state, i
    return state, None


def _with_bad(file: File, app: Line | None, bad: Sequence[BadStatement], named: bool) -> File:
    """Put what cannot be read where it stands. A broken first line of an app may have its name."""
    end = span(app.tokens[-1]).end if app else 0
    inside = [each for each in bad if each.span.start >= end]
    name = file.app.name
    if not named:
        found = next((each.name for each in bad if each.kind == "app"), None)
        name = found or Name(text="", span=Span(end, end))
    statements = sorted((*file.app.statements, *inside), key=lambda each: each.span.start)
    outside = tuple(each for each in bad if each.span.start < end)
    return replace(
        file, app=replace(file.app, name=name, statements=tuple(statements)), bad=outside
    )


def _fed(tokens: Sequence[tuple[str, str]]) -> State:
    """Return the parser behind tokens that the source does not have."""
    state = beginning()
    for token in _made_up(tokens):
        state.feed_token(token)
    return state


def _made_up(tokens: Sequence[tuple[str, str]]) -> list[Token]:
    return [made_up(kind, text) for kind, text in tokens]


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
    if line.first in SOFT_KINDS:
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
