"""Recording what happens in the journal before it has any effect outside (write-ahead).

The events of each instant, and the rows that they change, are one entry: all or none. A command to a
drone waits until its entry is durable. Measurements cost no entry of their own: they go along with the
next one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from ..shared.time.kernel import Future
from .event_line import exact
from .standing import REMEMBERED, Row, Standing
from .store import Entry

if TYPE_CHECKING:
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Kernel


class Sink(Protocol):
    """Receives entries."""

    def add(self, entry: Entry) -> int:
        """Add an entry and return its number; `Recorder.durable` is called with that number, or a higher one."""
        ...


class Recorder:
    """Records one run of an app."""

    def __init__(
        self,
        kernel: Kernel,
        sink: Sink,
        standing: Standing,
        rows: Callable[[], list[Row]],
    ) -> None:
        """`rows` returns those that have changed since it was called."""
        self._kernel = kernel
        self._sink = sink
        self._rows = rows
        self.standing = standing
        """Where everything stands, as of the last instant that is over."""
        self._lines: list[str] = []
        """The events of this instant."""
        self._measured: list[str] = []
        """The measurements since the last entry."""
        self._facts: dict[str, None] = {}
        """The facts of the app that have changed."""
        self._waiting: deque[tuple[int, Callable[[], object]]] = deque()
        """The calls that wait for an entry to be durable, in order."""
        self._added = 0
        self._durable = 0
        self._due: list[Callable[[], object]] = []
        """The calls that wait for this instant's entry."""
        kernel.settled = self._settle

    def take(self, event: Event) -> None:
        """Add an event to those of its instant."""
        self._lines.append(exact(event))
        self.standing.time = float(str(event["t"]))

    def fact(self, name: str, value: object) -> None:
        """Change a fact of the app."""
        self.standing.app[name] = value
        self._facts[name] = None

    def remember(self, command: str) -> None:
        """Remember a command's id: a sender that has missed the answer may repeat it."""
        self.fact("commands", [*self.standing.commands, command][-REMEMBERED:])

    def measure(self, event: Event) -> None:
        """Add a measurement, which changes no row, and for whose entry no one waits."""
        self._measured.append(exact(event))

    def finish(self) -> None:
        """Append what no other entry has taken along: the run has ended."""
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
        """Called within the kernel when the entries up to this number are durable."""
        self._durable = max(self._durable, number)
        waiting = self._waiting
        while waiting and waiting[0][0] <= self._durable:
            waiting.popleft()[1]()

    def _settle(self) -> None:
        """Append the entry of an instant that has ended, with the calls that wait for it."""
        self._append(only_measured=False)
        if self._due:
            due, self._due = self._due, []
            for call in due:
                self._waiting.append((self._added, call))
            self.durable(self._durable)

    def _append(self, *, only_measured: bool = True) -> None:
        rows = self._rows()
        rows += [("app", (name,), {"is": self.standing.app[name]}) for name in self._facts]
        self._facts.clear()
        if not (rows or self._lines or (only_measured and self._measured)):
            return
        self.standing.take(rows)
        lines = [*self._measured, *self._lines]
        self._measured.clear()
        self._lines.clear()
        self._added = self._sink.add(Entry("[" + ",\n".join(lines) + "]", rows))
