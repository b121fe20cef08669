"""Flights that an event breaks off."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.errors import FlightFailed
from ..time.kernel import EventKind

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission
    from ..flow.flight import Flight
    from ..flow.run import Run
    from .declared import Event

Whose = Callable[["Event", "Mission[Any]"], bool]
"""Whether an event concerns a mission."""


def own(event: Event, mission: Mission[Any]) -> bool:
    """Return whether a mission's own hooks or drone have raised an event."""
    return event.mission == mission.name


def anything(event: Event, mission: Mission[Any]) -> bool:
    """Return whether an event has come, from any source."""
    return True


class Reserves(Protocol):
    """Has drones hover for their missions."""

    def reserve(self, mission: str, drone: Drone) -> None:
        """Have a drone hover for a mission until its next allocation decides."""


class Interruption:
    """What breaks one flight off, for as long as the branch lasts that has set it."""

    def __init__(self, run: Run[Any], of: Whose, reserves: Reserves) -> None:
        self._run = run
        self._of = of
        self._reserves = reserves

    def concerns(self, event: Event) -> bool:
        """Return whether an event breaks the flight off."""
        return self._of(event, self._run.mission)

    def soon(self, flight: Flight, event: Event) -> None:
        """Break the flight off at the end of this instant: one that ends now has ended first."""
        kernel = self._run.core.kernel
        break_off = partial(self._break_off, flight, event)
        kernel.at(kernel.now, EventKind.TIMER, self._run.key, break_off)

    def _break_off(self, flight: Flight, event: Event) -> None:
        """Break it off: its trip waits again, and no attempt is charged.

        What came of an action that is not safe to repeat is found out first: a trip that was done is done.
        """
        run = self._run
        if flight.is_set or flight.called_off is not None or _has_ended(run):
            return
        core = run.core
        repeatable = flight.action.hook is not None or flight.action.repeat == "safe"
        if core.on_record is None or repeatable:
            run.state.break_off(flight)
            # it will be flown again by this id, also if its action had begun
            core.orders.give({"do": "forget", "drone": flight.drone, "flight": flight.id})
            self._take_back(flight, event)
            return
        flight.called_off = f"event {event.id} has interrupted it"
        core.orders.settle(flight.drone, flight.id, partial(self._settled, flight, event))

    def _settled(self, flight: Flight, event: Event, result: object) -> None:
        """Take over what came of the flight."""
        if isinstance(result, FlightFailed):
            self._take_back(flight, event)
        else:
            self._run.state.reported(flight, result)

    def _take_back(self, flight: Flight, event: Event) -> None:
        state = self._run.state
        state.interrupt(flight, by=event.id)
        state.flight = flight  # for branches that have yet to come to their monitor
        if state.carrier is None:
            self._reserves.reserve(state.mission.name, flight.flier)
        else:
            state.keep_carrier(flight.flier)
        flight.set(state.mission.status)


def _has_ended(run: Run[Any]) -> bool:
    return run.task is not None and run.task.is_set
