"""Recording events in the journal before they have any effect outside (write-ahead).

The events of each instant are appended to the journal as one row: all or none. A command to a drone waits
until its row is durable. Measurements cost no row of their own: they go along with the next one.
"""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from ..shared.time.kernel import Future
from .event_line import exact
from .fold import Records

if TYPE_CHECKING:
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Kernel


class Sink(Protocol):
    """Receives rows."""

    def add(self, row: str) -> int:
        """Add a row and return its number; `Recorder.durable` is called with that number, or a higher one."""
        ...


class Recorder:
    """Records one run of an app."""

    def __init__(self, kernel: Kernel, sink: Sink, records: Records) -> None:
        self._kernel, self._sink = kernel, sink
        self.records = records
        self._lines: list[str] = []
        """The events of this instant."""
        self._measured: list[str] = []
        """The measurements since the last row."""
        self._waiting: deque[tuple[int, Callable[[], object]]] = deque()
        """The calls that wait for a row to be durable, in order."""
        self._added = self._durable = 0
        self._due: list[Callable[[], object]] = []
        """The calls that wait for this instant's row."""
        kernel.settled = self._settle

    def take(self, event: Event) -> None:
        """Add an event to those of its instant."""
        written = exact(event)
        self._lines.append(written)
        if event["event"] in _SHARED:
            event = json.loads(written)  # a copy, independent of the mission and its hooks
        self.records.take(event)

    def measure(self, event: Event) -> None:
        """Add a measurement, which changes no record, and for whose row no one waits."""
        self._measured.append(exact(event))

    def finish(self) -> None:
        """Append the measurements that no other row has taken along: the run has ended."""
        self._append()

    def when_durable(self, call: Callable[[], object]) -> None:
        """Call this as soon as all that has happened up to now is durable; not before this instant
        is over."""
        self._due.append(call)

    async def on_record(self) -> None:
        """Wait until everything up to now is durable."""
        durable: Future[None] = Future()
        self.when_durable(lambda: durable.set(None))
        await durable

    def durable(self, number: int) -> None:
        """Called within the kernel when the rows up to this number are durable."""
        self._durable = max(self._durable, number)
        waiting = self._waiting
        while waiting and waiting[0][0] <= self._durable:
            waiting.popleft()[1]()

    def _settle(self) -> None:
        """Append the row of an instant that has ended, with the calls that wait for it."""
        if self._lines:
            self._append()
        if self._due:
            due, self._due = self._due, []
            for call in due:
                self._waiting.append((self._added, call))
            self.durable(self._durable)

    def _append(self) -> None:
        lines = [*self._measured, *self._lines]
        self._measured.clear()
        self._lines.clear()
        if lines:
            self._added = self._sink.add("[" + ",\n".join(lines) + "]")


_SHARED = (
    *("mission.created", "mission.changed", "mission.replanned", "mission.extended"),
    "trip.reset",
)
"""The events with parts that are kept in records, which change."""
