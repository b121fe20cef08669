"""Changes of status by an interruption or by the user; each is an event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status, TripStatus

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission, Trip
    from plutoc_runtime.flow.mission import Core

PRIORITY = "priority"
"""The field of trips with the priority in the queue, in apps whose graph has one."""


def interrupt(core: Core, mission: Mission[Any], trip: Trip) -> None:
    """Take back a flight that was interrupted before its action was done: it counts as no attempt."""
    trip.status, trip.drone = TripStatus.WAITING, None
    trip.start_time = trip.end_time = None
    mission.attempts -= 1
    _note(core, mission, "trip.interrupted", trip=trip.name)


def skip(core: Core, mission: Mission[Any], trip: Trip) -> None:
    """Skip a trip."""
    trip.status = TripStatus.SKIPPED
    mission.trips.remove(trip)
    _note(core, mission, "trip.skipped", trip=trip.name)


def prioritise(core: Core, mission: Mission[Any], trip: Trip, priority: int) -> None:
    """Change a trip's priority."""
    setattr(trip, PRIORITY, priority)
    _note(core, mission, "trip.prioritised", trip=trip.name, priority=priority)


def pause(core: Core, mission: Mission[Any]) -> None:
    """Pause a mission."""
    mission.status, mission.reason = Status.PAUSED, ""
    _note(core, mission, "mission.paused")


def resume(core: Core, mission: Mission[Any], status: Status) -> None:
    """Resume an interrupted mission."""
    mission.status = status
    _note(core, mission, "mission.resumed", status=status.value)


def doubt(core: Core, mission: Mission[Any], trip: Trip, drone: str, question: str) -> None:
    """Set a mission UNCERTAIN: only the user can say whether a trip's action was done."""
    mission.status, mission.reason = Status.UNCERTAIN, question
    _note(core, mission, "mission.uncertain", trip=trip.name, drone=drone, reason=question)


def hold(core: Core, mission: Mission[Any], reason: str) -> None:
    """Hold a mission that cannot go on in this app until the user decides."""
    mission.status, mission.reason = Status.HELD, reason
    _note(core, mission, "mission.held", reason=reason)


def decide(core: Core, mission: Mission[Any], answer: str) -> None:
    """Record the user's decision."""
    _note(core, mission, "mission.decided", answer=answer)


def _note(core: Core, mission: Mission[Any], event: str, **facts: object) -> None:
    if core.trace.live:
        core.trace.note(event, mission=mission.name, **facts)
