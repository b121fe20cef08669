"""The console and the results of a flight of the past, by its journal and its recording."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ...journal.facts import BROKEN
from ..feed import Feed
from ..results.meaning import SIMULATED_UNITS
from ..results.rows import NameOf, nowhere
from .reading import JournalText

if TYPE_CHECKING:
    from ...app import App

Said = tuple[Mapping[str, Any], int]
"""A line of the console that is in no journal, and how many lines of the journal stood before it."""

LEFT_OUT = "an event could not be shown: it is not as this app, or this version, knows it"


@dataclass(slots=True)
class Logbook:
    """What a page was told of a flight, line by line."""

    feed: Feed
    lines: list[Any] = field(default_factory=list)
    results: list[Any] = field(default_factory=list)
    said: str = ""
    """What is missing; empty: nothing."""


def logbook(
    app: App, journal: JournalText, said: Sequence[Said], name_of: NameOf = nowhere
) -> Logbook:
    """Read a whole journal as a station does that shows it, with what else it has said."""
    book: Logbook | None = None
    others = iter(said)
    ahead = next(others, None)
    told = 0
    """The lines of the journal so far."""
    for _, events in journal.instants():
        for event in events:
            if book is None:
                units = SIMULATED_UNITS if event.get("sim") else {}
                book = Logbook(Feed(app, units, journal.path.stem, name_of))
            while ahead is not None and ahead[1] <= told:
                _say(book, ahead[0])
                ahead = next(others, None)
            try:
                book.feed.take(event)
            except BROKEN:
                book.said = LEFT_OUT
            told += len(_new_lines(book))
    book = book or Logbook(Feed(app, {}))
    book.results = _new(iter(book.feed.results))
    for line, _ in [*([ahead] if ahead is not None else []), *others]:
        _say(book, line)
    book.said = journal.damaged or book.said
    return book


def _say(book: Logbook, line: Mapping[str, Any]) -> None:
    book.feed.say(line["time"], line["text"], line["kind"])
    _new_lines(book)


def _new_lines(book: Logbook) -> list[Any]:
    new = _new(book.feed.log.since(len(book.lines)))
    book.lines += new
    return new


def _new(texts: Iterator[str]) -> list[Any]:
    return [json.loads(text) for text in texts]
