"""Reading a text once more after a change: only the statements that it touches are read anew.

What lies around them was in order, and stays as it is. So a text is read that has only the touched
statements in its app, with two on either side, and what comes out is put where it belongs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from functools import cache
from typing import TypeVar, cast

from plutoc.diagnostic import Diagnostic
from plutoc.source import LARGEST, Source, Span
from plutoc.syntax.parse import read
from plutoc.syntax.tree import File, Statement

T = TypeVar("T")
_BESIDE = 2
"""A touched statement may join the one beside it, and is then judged by the next."""
Place = Callable[[int], int]
"""Where a character stands after a change."""


def read_again(source: Source, before: File | None) -> tuple[File, tuple[Diagnostic, ...]]:
    """Return what `read` does, given the tree of an earlier text that was in order."""
    part = None if before is None else _touched(source, before)
    if before is None or part is None:
        return read(source)
    left, right, start, end = part
    opened = _opening(before)
    closing = len(source.text) - (len(before.source.text) - before.app.span.end + 1)
    short = source.text[: opened + 1] + source.text[start:end] + source.text[closing:]
    gone, rest = start - opened - 1, closing - end

    def place(at: int) -> int:
        if at <= opened + 1:
            return at
        return at + gone + (rest if at + gone > end else 0)

    file, found = read(Source(source.path, short))
    new = moved(file, place)
    by = len(source.text) - len(before.source.text)
    behind = right if by == 0 else tuple(moved(one, lambda at: at + by) for one in right)
    app = replace(new.app, statements=(*left, *new.app.statements, *behind))
    return replace(new, source=source, app=app), tuple(_placed(one, source, place) for one in found)


def is_sound(file: File, found: tuple[Diagnostic, ...]) -> bool:
    """Return whether a text was in order, so that another one can be read from its tree."""
    return not found and not file.bad and bool(file.app.name.text)


Part = tuple[tuple[Statement, ...], tuple[Statement, ...], int, int]


def _touched(source: Source, before: File) -> Part | None:
    """Return what stays on the left and on the right, and from where to where the text is read."""
    old, new = before.source.text, source.text
    opened, closed = _opening(before), before.app.span.end - 1
    if len(new) > LARGEST // 4 or opened < 0:
        return None
    same = _same(old, new)
    last = len(old) - _same(old[same:][::-1], new[same:][::-1])
    if same <= opened or last > closed or set(new[same : last + len(new) - len(old)]) & set("{}"):
        return None
    statements = before.app.statements
    i = next((i for i, one in enumerate(statements) if one.span.end >= same), len(statements))
    j = next((j for j, one in enumerate(statements) if one.span.start > last), len(statements))
    i = max(i - _BESIDE, 0)
    j = min(j + _BESIDE, len(statements))
    while j < len(statements) and "\n" in old[slice(*statements[j - 1].span)]:
        j += 1  # its first line alone may not show that a statement begins there
    by = len(new) - len(old)
    start = statements[i - 1].span.end if i else opened + 1
    end = (statements[j].span.start if j < len(statements) else closed) + by
    return statements[:i], statements[j:], start, end


def _opening(file: File) -> int:
    """Return where the brace is that opens the app."""
    name = file.app.title or file.app.name
    return file.source.text.find("{", name.span.end)


def _same(one: str, other: str) -> int:
    """Return how many characters two texts begin with in common."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[:middle] == other[:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def moved(node: T, place: Place) -> T:
    """Return a tree, or a part of one, at other places."""
    kind = type(node)
    if kind is Span:
        start, end = cast(Span, node)
        return cast(T, Span(place(start), place(end)))
    if kind is tuple:
        return cast(T, tuple([moved(one, place) for one in cast(tuple[object, ...], node)]))
    names = _parts(cast(type, kind))
    if not names:
        return node
    made = object.__new__(kind)
    for name, has_place in names:
        value = getattr(node, name)
        object.__setattr__(made, name, moved(value, place) if has_place else value)
    return made


@cache
def _parts(kind: type) -> tuple[tuple[str, bool], ...]:
    """Return the fields of a kind of node, each with whether there may be a place in it."""
    if not is_dataclass(kind) or kind is Source:
        return ()
    return tuple((one.name, one.name != "source" and one.type != "str") for one in fields(kind))


def _placed(found: Diagnostic, source: Source, place: Place) -> Diagnostic:
    """Return a finding about the short text as one about the whole."""
    fix = found.fix and moved(found.fix, place)
    related = tuple(replace(moved(one, place), source=source) for one in found.related)
    span = moved(found.span, place)
    return replace(found, source=source, span=span, related=related, fix=fix)
