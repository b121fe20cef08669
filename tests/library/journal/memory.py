"""A journal in memory, for tests."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from errno import ENOSPC
from pathlib import Path

from pluto_fleet.journal import errors
from pluto_fleet.journal.database import written
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.facts import row_of
from pluto_fleet.journal.standing import Row, Standing, inherited
from pluto_fleet.journal.store import Entry
from pluto_fleet.shared.domain.trace import Event


class Memory:
    """The same as a `Store`; what was added and not committed is lost in a crash."""

    def __init__(self, header: Event, clock: Callable[[], float] | None = None) -> None:
        self.header = header
        self.epoch = 1
        self.failure: JournalError | None = None
        self.room: int | None = None
        """How many entries the disk still takes; None: as many as there will ever be."""
        self._clock = clock or (lambda: 0.0)
        self._events: list[str] = []
        self._pending: list[Entry] = []
        self._rows: dict[tuple[str, tuple[str | int, ...]], str] = {}
        self.append([Entry(json.dumps([{"t": 0.0, **header}]), inherited(header))])

    @property
    def seq(self) -> int:
        return len(self._events) - 1

    @property
    def events(self) -> Iterator[Event]:
        """The durable events, without the header."""
        for text in self._events[1:]:
            yield from json.loads(text)

    def rows(self) -> list[Row]:
        """Return the durable rows."""
        return [(table, key, row_of(table, key, text)) for (table, key), text in self._rows.items()]

    def replace(self, rows: Sequence[Row]) -> None:
        """Have other rows, as somebody has written them."""
        self._rows = {(table, key): written(row) for table, key, row in rows}

    def standing(self) -> Standing:
        """Return where everything stands, by the durable rows."""
        last = next(text for text in reversed(self._events) if text != "[]")
        return Standing(self.rows(), float(json.loads(last)[-1]["t"]))

    def reopen(self) -> None:
        """Go on with it in another life: what was not durable never was."""
        self._pending.clear()
        self.epoch += 1
        self.failure = None

    def add(self, entry: Entry) -> int:
        """Take an entry and return its number; it is durable after the next `commit`."""
        self._pending.append(entry)
        return self.seq + len(self._pending)

    def commit(self) -> int:
        """Make durable what was added; return the number of the last entry."""
        entries = self._pending
        self._pending = []
        self.append(entries)
        return self.seq

    def append(self, entries: Sequence[Entry]) -> None:
        """Write entries, all or none; when this returns they are durable."""
        if self.failure is not None:
            raise self.failure
        if self.room is not None:
            if len(entries) > self.room:
                full = OSError(ENOSPC, "")
                self.failure = errors.cannot_write(Path("the journal in memory"), full, self.seq)
                raise self.failure
            self.room -= len(entries)
        for entry in entries:
            self._events.append(entry.events)
            for table, key, row in entry.rows:
                self._rows[table, key] = written(row)
