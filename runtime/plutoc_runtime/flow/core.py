"""What everything that flies a mission shares."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.text import bounded
from ..hooks.calls import LONGEST_LOG

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.model import Mission
    from ..domain.results import ResultStore
    from ..domain.trace import Trace
    from ..fleet.fleet import Fleet
    from ..fleet.navigation import Navigation
    from ..fleet.queue import Queue
    from ..time.kernel import Kernel
    from ..trips.deadlines import Deadlines
    from ..trips.flight import Flight
    from ..trips.transitions import Transitions
    from .mission import State


CallsOff = Callable[["State", "Flight", str], object]
"""Fails the trip of a flight that was broken off, once it is known that its action was not done."""


class Recorder(Protocol):
    """Writes down what happens, for a later life of the app."""

    missions: dict[str, Mission[Any]]
    """The missions by name, as soon as they exist."""
    trace: Trace | None
    results: ResultStore | None

    async def on_record(self) -> None:
        """Wait until all that has happened up to now is durable."""
        ...

    def look(self, mission: Mission[Any]) -> None:
        """A hook has had this mission in its hands: if it changed its trips, that is an event."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Core:
    """The parts of one running app."""

    app: App
    kernel: Kernel
    airspace: Airspace
    navigation: Navigation[Flight]
    trace: Trace
    results: ResultStore
    transitions: Transitions
    queue: Queue
    fleet: Fleet
    deadlines: Deadlines
    calls_off: CallsOff | None = None
    """None: drones are in this process, and what was not reported was not done."""
    recorder: Recorder | None = None
    """Writes down what happens; None: nothing will ever go on from here."""

    def log(self, text: str, mission: str | None = None) -> None:
        """Write a line on the console."""
        if self.trace.live:
            self.trace.note("log", mission=mission, text=bounded(text, LONGEST_LOG))
