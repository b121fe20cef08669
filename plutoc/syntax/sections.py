"""Which line of a source with mistakes is the header, which is the app's, what stands in its braces."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

from lark import Token

from plutoc.diagnostic import Diagnostic
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.lines import Line, begins_a_statement, joined
from plutoc.syntax.tokens import span

_OUTSIDE = ("USE", "APP", "RBRACE", "LBRACE")


@dataclass(frozen=True, slots=True, kw_only=True)
class Sections:
    """The lines of a source, by where they stand."""

    header: Line | None
    before: tuple[Line, ...]
    app: Line | None
    body: tuple[Line, ...]
    behind: tuple[Line, ...]
    """What stands behind the app: read like its body, since it may belong there."""


def sections(
    source: Source, lines: Sequence[Line], end: Token, found: list[Diagnostic]
) -> Sections:
    """Sort lines by where they stand; find what is wrong with the whole of them."""
    header, rest = _header(source, lines, found)
    at = _app(rest)
    if header is not None and header.has("LBRACE"):  # the app begins on the first line
        at, app, before, body = 0, None, [], list(rest)
    elif at is None:
        begin = next((i for i, line in enumerate(rest) if begins_a_statement(line)), len(rest))
        app, before, body = None, [*rest[:begin]], [*rest[begin:]]
        if not found or not before:  # what is no app at all is told once
            where = span(body[0].tokens[0]) if body else _behind(lines, end)
            found.append(errors.no_app(source, where, at_end=not body))
        if not body:
            before = [line for line in before if line.first == "USE"]
    else:
        app, before, body = rest[at], [*rest[:at]], [*rest[at + 1 :]]
    opened = None
    if app is not None and app.tokens[-1].type == "LBRACE":
        opened = app.tokens[-1]
    body, behind = _braces(
        source, app.tokens[0] if app else None, opened, _nested(body), end, found
    )
    return Sections(
        header=header,
        before=tuple(before),
        app=app,
        body=tuple(body),
        behind=tuple(behind),
    )


def _header(
    source: Source, lines: Sequence[Line], found: list[Diagnostic]
) -> tuple[Line | None, list[Line]]:
    """Take the header off: None where there is none that a parser should look at."""
    if not lines:
        return None, []
    first, rest = lines[0], [*lines[1:]]
    if first.first == "PLUTO":
        return first, rest
    if rest and rest[0].first == "PLUTO":
        return rest[0], [first, *rest[1:]]
    if first.first in _OUTSIDE or begins_a_statement(first) or first.has("LBRACE"):
        found.append(errors.no_header(source, span(first.tokens[0])))
        return None, [first, *rest]
    if rest and "".join(source.quote(first.span.to(rest[0].span)).split()) == "pluto1":
        first, rest = joined([first, rest[0]]), rest[1:]  # with a line break in it
    found.append(errors.wrong_header(source, first.span))
    return None, rest


def _app(lines: Sequence[Line]) -> int | None:
    """Return which line begins the app: by its word, else by its brace."""
    signs = (
        [line.first == "APP" for line in lines],
        [line.tokens[-1].type == "LBRACE" and not begins_a_statement(line) for line in lines],
        [line.has("APP") for line in lines],
        [line.tokens[-1].type == "LBRACE" for line in lines],
    )
    return next((sign.index(True) for sign in signs if True in sign), None)


def _behind(lines: Sequence[Line], end: Token) -> Span:
    """Return the place behind all that is there."""
    last = lines[-1].span.end if lines else span(end).start
    return Span(last, last)


def _is_closing(line: Line) -> bool:
    return len(line.tokens) == 1 and line.first == "RBRACE"


def _nested(body: Sequence[Line]) -> list[Line]:
    """Join what stands in braces of its own, as long as a brace is left to close the app."""
    closings = [i for i, line in enumerate(body) if _is_closing(line)]
    left = len(closings)
    lines: list[Line] = []
    i = 0
    while i < len(body):
        stop = i + 1
        if body[i].has("LBRACE") and body[i].first != "APP" and left > 1:
            next_one = bisect_left(closings, stop)
            if next_one < len(closings):
                stop = closings[next_one] + 1
                left -= 1
        lines.append(joined(body[i:stop]))
        i = stop
    return lines


def _braces(
    source: Source,
    first: Token | None,
    opened: Token | None,
    body: Sequence[Line],
    end: Token,
    found: list[Diagnostic],
) -> tuple[list[Line], list[Line]]:
    """Take the closing braces out of the body; return it, and what stands behind it."""
    closings = [i for i, line in enumerate(body) if _is_closing(line)]
    if not closings:
        hidden = any(line.has("RBRACE") or "}" in line.tokens[-1] for line in body)
        if opened is not None and not hidden:
            at = span(body[-1].tokens[-1] if body else opened).end
            found.append(errors.never_closed(source, span(opened), at))
            if body and len(body[-1].tokens) == 1:  # stands where the brace should
                return [*body[:-1]], [body[-1]]
        return [*body], []
    second = next((i for i in range(closings[0], len(body)) if body[i].first == "APP"), None)
    if second is not None:  # an app of its own, which is not read
        found.append(
            errors.second_app(source, span(body[second].tokens[0]), span(first) if first else None)
        )
        body = body[:second]
        closings = [i for i in closings if i < second]
    last = closings[-1]
    if len(closings) > 1:
        found.append(errors.early_brace(source, body[closings[0]].span, body[last].span))
    elif last + 1 < len(body):
        found.append(errors.behind_the_app(source, body[last + 1].tokens[0]))
    inside = [line for line in body[:last] if not _is_closing(line)]
    return inside, [*body[last + 1 :]]
