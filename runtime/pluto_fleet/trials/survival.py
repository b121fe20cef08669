"""What an app must still know when it goes on: what was on record of missions, trips and results."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.fields import Entity

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission, Trip
    from plutoc_runtime.domain.trace import Event


@dataclass(frozen=True, slots=True)
class Known:
    """What was on record of one mission."""

    round: int
    attempts: int
    completed: tuple[str, ...]
    fields: tuple[object, ...]
    trips: dict[str, tuple[object, ...]]
    """By name: the attempt, and the fields that the graph gives a trip."""


def known_of(app: App, mission: Mission[Any]) -> Known:
    """Return what there is to know of a mission."""
    return Known(
        mission.round,
        mission.attempts,
        tuple(trip.name for trip in mission.completed_trips),
        _fields(app, Entity.MISSION, mission),
        {
            trip.name: (trip.attempt, *_fields(app, Entity.TRIP, trip))
            for trip in (*mission.trips, *mission.completed_trips)
        },
    )


def forgotten(name: str, before: Known, after: Known, since: Sequence[Event]) -> Iterable[str]:
    """Yield what an app has forgotten of a mission, but for what has happened to it since."""
    launched = sum(event["event"] == "trip.launched" for event in since)
    if any(event["event"] in _CHANGES for event in since):
        return
    if before.round != after.round:
        yield f"{name} was in round {before.round}, and went on in round {after.round}"
    flown = before.attempts + launched
    interrupted = sum(event["event"] == "trip.interrupted" for event in since)
    if not flown - interrupted <= after.attempts <= flown:
        yield f"{name} had had {before.attempts} flights, and went on with {after.attempts - launched}"
    if before.fields != after.fields:
        yield f"{name} had {_shown(before.fields)}, and went on with {_shown(after.fields)}"
    for trip in before.completed:
        if trip not in after.completed:
            yield f"{trip} of {name} was completed, and is to be flown again"
    for trip, facts in before.trips.items():
        found = after.trips.get(trip)
        if found is None:
            yield f"{trip} of {name} was forgotten"
        elif found != facts:
            yield f"{trip} of {name} had {_shown(facts)}, and went on with {_shown(found)}"


_CHANGES = ("trip.reset", "trip.skipped", "mission.repeated", "mission.extended", "mission.changed")


def _fields(app: App, entity: Entity, of: Mission[Any] | Trip) -> tuple[object, ...]:
    return tuple(getattr(of, field.name) for field in app.fields if field.on is entity)


def _shown(facts: Sequence[object]) -> str:
    return ", ".join(map(repr, facts))
