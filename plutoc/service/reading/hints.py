"""What an editor shows within the text: the statuses that pass along each arrow."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.service.document import Document
from plutoc.service.reading.arrows import arrows, carried
from plutoc.source import Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Hint:
    """A few words behind a place of the text."""

    offset: int
    text: str


def hints(document: Document, within: Span | None = None) -> tuple[Hint, ...]:
    """Return the statuses of each arrow, behind the stop that it leads to."""
    start, end = within or Span(0, len(document.text))
    return tuple(
        Hint(offset=arrow.end, text=", ".join(status.value for status in statuses) or "nothing")
        for arrow in arrows(document)
        if start <= arrow.end <= end
        for statuses in (carried(document, arrow),)
        if document.carries
    )
