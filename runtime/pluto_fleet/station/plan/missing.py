"""What is missing of missions that failed: the trips that were not done, to fly only those again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...shared.domain.actions import PICK, RELEASE
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity, FieldType
from ...shared.domain.text import quoted
from .shape import BROKEN_OFF, COMPLETED, Shape, trips_of

if TYPE_CHECKING:
    from ...app import App

FAILED = ("FAILED", BROKEN_OFF)
"""How missions end of which something is missing without a person's decision."""


def settled(record: Mapping[str, Any]) -> list[str]:
    """Return the names of the trips of a flown mission that were done, or left out by a decision."""
    return [str(trip["name"]) for trip in (*record["done"], *record["gone"])]


def only_missing(app: App, missions: Sequence[Shape], chosen: bool) -> list[Shape]:
    """Return missions with the trips that are missing of them, in their order and by their names.

    Those that have not failed, or of which nothing is missing, are left out; if they were `chosen`,
    `BadInput` says why that cannot be.
    """
    found = []
    for mission in missions:
        if not chosen and mission["ended"] not in FAILED:
            continue
        trips = missing(mission)
        if chosen and (why := _why_not(mission, trips)):
            raise BadInput(f"mission {quoted(str(mission['name']))} {why}")
        if _in_rounds(app, mission):
            raise BadInput(
                f"mission {quoted(str(mission['name']))} flies in rounds: what is missing of one round"
                " cannot be flown alone; start it whole"
            )
        if trips:
            found.append({**mission, "trips": trips})
    if not found:
        raise BadInput("no mission has failed of which a trip is missing: start them whole")
    return found


def missing(mission: Shape) -> list[Shape]:
    """Return the trips of a mission to be flown: those not done, but a pick with its release or not at all.

    Where that is missing, the item is not where it was to be: it is picked again, and then released.
    """
    done: Any = mission.get("done") or ()
    trips: list[Shape] = [
        {**trip, "name": trip.get("name") or str(number)}
        for number, trip in enumerate(trips_of(mission), 1)
    ]
    wanted = [trip["name"] not in done for trip in trips]
    for place, trip in enumerate(trips):
        if trip["action"] == PICK:
            wanted[place] = _release(trips, wanted, place)
    return [trip for trip, is_wanted in zip(trips, wanted, strict=True) if is_wanted]


def _release(trips: Sequence[Shape], wanted: Sequence[bool], pick: int) -> bool:
    """Return whether the release of a pick is to be flown; of one without, whether itself is."""
    for place in range(pick + 1, len(trips)):
        if trips[place]["action"] == RELEASE:
            return wanted[place]
    return wanted[pick]


def _why_not(mission: Shape, trips: Sequence[Shape]) -> str:
    if mission["ended"] == COMPLETED:
        return "was completed: nothing of it is missing"
    if mission["ended"] is None:
        return "has not failed, or was changed since: start it whole"
    return "" if trips else "failed, and all its trips were done: start it whole"


def _in_rounds(app: App, mission: Shape) -> bool:
    return any(
        bool(mission.get(field.name))
        for field in app.fields
        if field.on is Entity.MISSION and field.type is FieldType.ROUNDS
    )
