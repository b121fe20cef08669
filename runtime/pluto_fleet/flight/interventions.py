"""Changes of status that only an interruption or a person makes; each of them is an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status, TripStatus

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission, Trip
    from plutoc_runtime.flow.mission import Core

PRIORITY = "priority"
"""The field of trips that decides who gets a drone first, in apps whose graph has one."""


def interrupt(core: Core, mission: Mission[Any], trip: Trip) -> None:
    """A flight was interrupted before its action was done: it counts as no attempt."""
    trip.status, trip.drone = TripStatus.WAITING, None
    trip.start_time = trip.end_time = None
    mission.attempts -= 1
    _note(core, mission, "trip.interrupted", trip=trip.name)


def skip(core: Core, mission: Mission[Any], trip: Trip) -> None:
    """A person wants a trip not to be flown after all."""
    trip.status = TripStatus.SKIPPED
    mission.trips.remove(trip)
    _note(core, mission, "trip.skipped", trip=trip.name)


def prioritise(core: Core, mission: Mission[Any], trip: Trip, priority: int) -> None:
    """A person wants a trip to be flown sooner, or later, than it would be."""
    setattr(trip, PRIORITY, priority)
    _note(core, mission, "trip.prioritised", trip=trip.name, priority=priority)


def pause(core: Core, mission: Mission[Any]) -> None:
    """A person wants a mission to wait until it is told to go on."""
    mission.status, mission.reason = Status.PAUSED, ""
    _note(core, mission, "mission.paused")


def resume(core: Core, mission: Mission[Any], status: Status) -> None:
    """A mission that was interrupted goes on."""
    mission.status = status
    _note(core, mission, "mission.resumed", status=status.value)


def doubt(core: Core, mission: Mission[Any], trip: Trip, drone: str, question: str) -> None:
    """Only a person can say whether a trip's action was done."""
    mission.status, mission.reason = Status.UNCERTAIN, question
    _note(core, mission, "mission.uncertain", trip=trip.name, drone=drone, reason=question)


def hold(core: Core, mission: Mission[Any], reason: str) -> None:
    """A mission cannot go on in this app: a person must decide."""
    mission.status, mission.reason = Status.HELD, reason
    _note(core, mission, "mission.held", reason=reason)


def decide(core: Core, mission: Mission[Any], answer: str) -> None:
    """A person has decided what only a person can know."""
    _note(core, mission, "mission.decided", answer=answer)


def _note(core: Core, mission: Mission[Any], event: str, **facts: object) -> None:
    if core.trace.live:
        core.trace.note(event, mission=mission.name, **facts)
