"""The console and the results of a flight of the past, by its journal."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ...journal.facts import BROKEN
from ..feed import Feed
from ..results.meaning import SIMULATED_UNITS
from ..results.rows import NameOf, nowhere
from .reading import JournalText

if TYPE_CHECKING:
    from ...app import App
    from ..wire import EventRow

LEFT_OUT = "an event could not be shown: it is not as this app, or this version, knows it"


@dataclass(slots=True)
class Logbook:
    """What a page was told of a flight, line by line."""

    feed: Feed
    lines: list[Any] = field(default_factory=list)
    results: list[Any] = field(default_factory=list)
    events: list[EventRow] = field(default_factory=list)
    said: str = ""
    """What is missing; empty: nothing."""


def logbook(app: App, journal: JournalText, name_of: NameOf = nowhere) -> Logbook:
    """Read a whole journal as a station does that shows it."""
    book: Logbook | None = None
    for _, events in journal.instants():
        for event in events:
            if book is None:
                units = SIMULATED_UNITS if event.get("sim") else {}
                book = Logbook(Feed(app, units, journal.path.stem, name_of))
            try:
                book.feed.take(event)
            except BROKEN:
                book.said = LEFT_OUT
            book.lines += _new(book.feed.log.since(len(book.lines)))
    book = book or Logbook(Feed(app, {}))
    book.results = _new(iter(book.feed.results))
    book.events = [*book.feed.events]
    book.said = journal.damaged or book.said
    return book


def _new(texts: Iterator[str]) -> list[Any]:
    return [json.loads(text) for text in texts]
