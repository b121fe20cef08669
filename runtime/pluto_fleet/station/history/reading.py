"""Reading the journal of a flight, also of one that another process writes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...journal import errors
from ...journal.database import Instant
from ...journal.errors import JournalError
from ...journal.facts import check
from ...journal.reader import Reader, standing_of
from ...journal.standing import Standing

Event = dict[str, Any]


@dataclass(slots=True)
class JournalText:
    """A journal that is read from its beginning."""

    path: Path
    damaged: str = ""
    """What is wrong with it, after all that can be read; empty: nothing."""

    def instants(self) -> Iterator[tuple[Instant, list[Event]]]:
        """Yield its instants and their events, the header first, as far as they are as they must be."""
        try:
            reader = Reader(self.path)
        except JournalError as error:
            self.damaged = str(error)
            return
        with closing(reader):
            for instant in reader.instants():
                try:
                    events = instant.events
                    for event in events:
                        check(event)
                except ValueError as error:
                    self.damaged = f"{self.path}: {errors.unfit(instant.seq, error)}"
                    return
                if events:
                    yield instant, events
            if reader.damaged is not None:
                self.damaged = str(errors.damaged(self.path, reader.damaged))

    def standing(self) -> Standing:
        """Return where everything stands; nothing of a journal whose rows cannot be read."""
        try:
            return standing_of(self.path)
        except JournalError as error:
            self.damaged = self.damaged or str(error)
            return Standing()
