"""A journal in memory, for tests."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from errno import ENOSPC
from itertools import islice
from pathlib import Path

from pluto_fleet.journal import errors
from pluto_fleet.journal.database import Row
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Read
from pluto_fleet.shared.domain.trace import Event


class Memory:
    """The same as a `Store`; what was added and not committed is lost in a crash."""

    def __init__(self, header: Event, clock: Callable[[], float] | None = None) -> None:
        self.header, self.epoch, self.torn = header, 1, None
        self.failure: JournalError | None = None
        self.room: int | None = None
        """How many rows the disk still takes; None: as many as there will ever be."""
        self._clock = clock or (lambda: 0.0)
        self._rows: list[tuple[float, str]] = []
        self._pending: list[str] = []
        self._snapshots: list[tuple[int, str]] = []

    @property
    def seq(self) -> int:
        return len(self._rows)

    @property
    def rows(self) -> list[str]:
        """The durable rows."""
        return [text for _, text in self._rows]

    def replace(self, rows: Sequence[str]) -> None:
        """Have other rows, as somebody has written them."""
        self._rows = [(0.0, text) for text in rows]

    def reopen(self) -> None:
        """Go on with it in another life: what was not durable never was."""
        self.crash()
        self.epoch += 1
        self.failure = None

    def crash(self) -> None:
        """Lose what was added after the last commit."""
        self._pending.clear()

    def add(self, row: str) -> int:
        """Take a row and return its number; it is durable after the next `commit`."""
        self._pending.append(row)
        return len(self._rows) + len(self._pending)

    def commit(self) -> int:
        """Make durable what was added; return the number of the last row."""
        rows, self._pending = self._pending, []
        self.append(rows)
        return len(self._rows)

    def append(self, rows: Sequence[str]) -> None:
        """Write rows, all or none; when this returns they are durable."""
        if self.failure is not None:
            raise self.failure
        if self.room is not None:
            if len(rows) > self.room:
                full = OSError(ENOSPC, "")
                self.failure = errors.cannot_write(Path("the journal in memory"), full, self.seq)
                raise self.failure
            self.room -= len(rows)
        now = self._clock()
        self._rows += [(now, row) for row in rows]

    def last_words(self, row: str) -> bool:
        """Write a row after all: there is a reserve."""
        self._rows.append((self._clock(), row))
        return True

    def snapshot(self, state: str) -> None:
        if self.failure is not None:
            raise self.failure
        self._snapshots = [*self._snapshots[-1:], (self.seq, state)]

    def read(self) -> Read:
        after, state = self._snapshots[-1] if self._snapshots else (0, None)
        return Read(self._chunks(after), state, after)

    def _chunks(self, after: int) -> Generator[list[Row], None, str | None]:
        rows = islice(self._rows, after, None)
        yield [Row(seq, wall, text, 0) for seq, (wall, text) in enumerate(rows, after + 1)]
        return None

    def close(self) -> None:
        """Nothing is to be done."""
