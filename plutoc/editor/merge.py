"""Two people changed one text: put together where they changed different statements."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from plutoc.editor.changes import hunks, lines_of

Lines = tuple[int, int]
"""The lines of a statement, from 0; the last one is included."""


class Conflict(Exception):
    """Both changed the same statement, or put something in at the same place."""


@dataclass(frozen=True, slots=True)
class _Hunk:
    start: int
    end: int
    lines: tuple[str, ...]


def merged(base: str, ours: str, theirs: str, statements: Iterable[Lines] = ()) -> str:
    """Return a text with the changes of both; raise `Conflict` where it is not clear how.

    `statements` are those of the base: what lies in one belongs together.
    """
    lines = lines_of(base)
    mine, others = _changed(lines, ours), _changed(lines, theirs)
    both = [one for one in mine if one in others]
    for one in mine:
        for other in others:
            if one not in both and other not in both and _meet(one, other):
                raise Conflict
    for first, last in statements:
        if _touches(mine, both, first, last) and _touches(others, both, first, last):
            raise Conflict
    found, done = list[str](), 0
    for one in sorted({*mine, *others}, key=lambda one: (one.start, one.end)):
        found += [*lines[done : one.start], *one.lines]
        done = one.end
    return "".join([*found, *lines[done:]])


def _changed(lines: Sequence[str], text: str) -> list[_Hunk]:
    new = lines_of(text)
    return [_Hunk(i, j, tuple(new[k:m])) for i, j, k, m in hunks(lines, new)]


def _meet(one: _Hunk, other: _Hunk) -> bool:
    """Return whether two changes are about the same lines, or put lines in at one place."""
    if one.start == one.end or other.start == other.end:
        return one.start <= other.end and other.start <= one.end
    return one.start < other.end and other.start < one.end


def _touches(hunks: Sequence[_Hunk], both: Sequence[_Hunk], first: int, last: int) -> bool:
    return any(
        one not in both and one.start <= last and first < max(one.end, one.start + 1)
        for one in hunks
    )
