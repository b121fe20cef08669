"""What the reports of changes share: their headings, and the lines that show a change."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from plutoc.diff.model import Change, Difference, Importance
from plutoc.source import Source, Span
from plutoc_runtime.domain.text import counted

HEADINGS = {
    Importance.SAFETY: "Safety and failures",
    Importance.MISSIONS: "Where missions go",
    Importance.PEOPLE: "What people write and enter",
    Importance.FORM: "Names and arrangement",
}
NOTHING = "nothing changed in meaning"
_MOST_LINES = 3
"""Of one source, for one change."""


class Shown(NamedTuple):
    """A line of one of the sources."""

    is_new: bool
    path: str
    number: int
    text: str


def headline(found: Difference) -> str:
    """Say how much there is."""
    if not found.changes:
        return NOTHING
    return f"{counted(len(found.changes), 'change')} in meaning"


def sections(found: Difference) -> Iterator[tuple[Importance, tuple[Change, ...]]]:
    """Yield the changes by importance."""
    for importance in Importance:
        changes = tuple(c for c in found.changes if c.importance is importance)
        if changes:
            yield importance, changes


def lines_of(found: Difference, change: Change) -> tuple[Shown, ...]:
    """Return the lines that show a change, those of the old source first, each once."""
    return (
        *_lines(found.old, change.was, is_new=False),
        *_lines(found.new, change.now, is_new=True),
    )


def _lines(source: Source, spans: Sequence[Span], *, is_new: bool) -> Iterator[Shown]:
    numbers = dict.fromkeys(source.position(span.start)[0] for span in spans)
    for number in tuple(numbers)[:_MOST_LINES]:
        text = source.line(number).strip()
        yield Shown(is_new=is_new, path=source.path, number=number, text=text)
