"""Changes of a text, as values: made, undone, found between two texts, and moved past others."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from itertools import pairwise


@dataclass(frozen=True, slots=True)
class Edit:
    """A text put in the place of a stretch; the end is not included."""

    start: int
    end: int
    text: str


Edits = tuple[Edit, ...]
"""In order and none overlapping, all in the text as it is before."""


class Overlap(Exception):
    """Edits touch the same stretch."""


def in_order(edits: Iterable[Edit]) -> Edits:
    """Return edits as they stand in the text; raise `Overlap` where that is not clear."""
    found = tuple(sorted(edits, key=lambda one: (one.start, one.end)))
    if any(one.end > other.start for one, other in pairwise(found)):
        raise Overlap
    return found


def made(text: str, edits: Edits) -> str:
    """Return the text with edits made."""
    parts, done = [], 0
    for one in edits:
        parts += [text[done : one.start], one.text]
        done = one.end
    return "".join([*parts, text[done:]])


def inverse(text: str, edits: Edits) -> Edits:
    """Return the edits that lead from the text as it is then back to this one."""
    found, moved = [], 0
    for one in edits:
        start = one.start + moved
        found.append(Edit(start, start + len(one.text), text[one.start : one.end]))
        moved += len(one.text) - (one.end - one.start)
    return tuple(found)


_LINE = re.compile(r"[^\n]*\n|[^\n]+")
_MOST = 1_000_000
"""Pairs of lines that are compared; beyond, one edit is as good as the smallest."""


def lines_of(text: str) -> list[str]:
    """Return the lines with their ends: those that the compiler counts."""
    return _LINE.findall(text)


def between(before: str, after: str) -> Edits:
    """Return edits that make one text of another, line by line and each as small as it can be."""
    old, new = lines_of(before), lines_of(after)
    starts = [0]
    for line in old:
        starts.append(starts[-1] + len(line))
    return tuple(
        _trimmed(before, starts[i], starts[j], "".join(new[k:m])) for i, j, k, m in hunks(old, new)
    )


def hunks(old: Sequence[str], new: Sequence[str]) -> Iterator[tuple[int, int, int, int]]:
    """Yield which lines became which: from, to, and from, to in the new ones."""
    most = min(len(old), len(new))
    head = next((i for i in range(most) if old[i] != new[i]), most)
    most -= head
    tail = next((i for i in range(most) if old[-1 - i] != new[-1 - i]), most)
    ours, theirs = old[head : len(old) - tail], new[head : len(new) - tail]
    if len(ours) * len(theirs) > _MOST:
        yield head, len(old) - tail, head, len(new) - tail
        return
    for tag, i, j, k, m in SequenceMatcher(None, ours, theirs, autojunk=False).get_opcodes():
        if tag != "equal":
            yield head + i, head + j, head + k, head + m


def _trimmed(before: str, start: int, end: int, text: str) -> Edit:
    old = before[start:end]
    most = min(len(old), len(text))
    head = next((i for i in range(most) if old[i] != text[i]), most)
    most -= head
    tail = next((i for i in range(most) if old[-1 - i] != text[-1 - i]), most)
    return Edit(start + head, end - tail, text[head : len(text) - tail])


def rebased(edits: Edits, over: Edits, measure: Callable[[str], int] = len) -> Edits:
    """Return edits as they are in a text that others have changed meanwhile; raise `Overlap`.

    What is put in at the very same place comes behind what is there already.
    """
    found = []
    for one in edits:
        moved = 0
        for other in over:
            if other.end <= one.start:
                moved += measure(other.text) - (other.end - other.start)
            elif other.start < one.end:
                raise Overlap
        found.append(Edit(one.start + moved, one.end + moved, one.text))
    return tuple(found)


def length(edits: Sequence[Edit]) -> int:
    """Return how much text edits hold."""
    return sum(len(one.text) for one in edits)
