"""Reading the journal of a flight, also of one that another process writes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ...journal import errors
from ...journal.database import Row
from ...journal.errors import JournalError
from ...journal.fold import Records
from ...journal.reader import Reader

Event = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Instant:
    """The events of one row of a journal."""

    wall: float
    """When it was written, in seconds since 1970."""
    epoch: int
    """How often the journal had been opened by then."""
    events: list[Event]


@dataclass(slots=True)
class JournalText:
    """A journal that is read from its beginning."""

    path: Path
    damaged: str = ""
    """What is wrong with it, after all that can be read; empty: nothing."""
    records: Records = field(default_factory=Records)
    """What is so after the instant that was read last."""

    def instants(self) -> Iterator[Instant]:
        """Yield its rows, the header first, after each has been taken into the records."""
        for row in self._rows():
            try:
                events = row.events
                for event in events:
                    self.records.read(event)
                    if event["event"] == "trip.completed":
                        event["did"] = self.records.flown_last(event["mission"])
            except ValueError as error:
                self.damaged = f"{self.path}: {errors.unfit(row.seq, error)}"
                return
            if events:
                yield Instant(row.wall, row.epoch, events)

    def _rows(self) -> Iterator[Row]:
        try:
            reader = Reader(self.path)
        except JournalError as error:
            self.damaged = str(error)
            return
        with closing(reader):
            yield from reader.rows()
            self.damaged = reader.damaged or ""
