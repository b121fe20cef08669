"""What changes of a trip while it flies: results on the way, and who flies it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..domain.keeper import put
from ..domain.model import Result
from ..domain.text import shown
from ..hooks.plain_data import value_data

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from ..flow.mission import Core


def keep(core: Core, mission: Mission[Any], trip: Trip, value: object, **did: object) -> None:
    """Store a result of a trip that goes on; `did` is the `action` that has brought it, if that is known."""
    place = None if trip.drone is None else trip.drone.location
    now = core.kernel.now
    result = Result(mission, trip, mission.round, trip.attempt, value, now, place)
    put(mission, last_result=core.results.add(result))
    facts = {"result": value_data(value), "at": place, **did} if core.changes.kept else {}
    core.transitions.note_flight("action.result", mission, trip, value=shown(value), **facts)


def relieve(core: Core, mission: Mission[Any], trip: Trip, drone: Drone) -> None:
    """Have another drone set out to a trip in flight."""
    put(drone, trips=drone.trips + 1)
    core.changes.drone(drone)
    core.transitions.note_trip("trip.relieving", mission, trip, drone=drone.id)


def hand_over(
    core: Core, mission: Mission[Any], trip: Trip, drone: Drone, away: float, reach: float
) -> None:
    """Give a trip in flight another drone, which is so far `away`: that is no attempt of its own."""
    before = trip.drone and trip.drone.id
    put(trip, drone=drone)
    facts = {"of": before, "away": round(away, 3), "reach": reach}
    core.transitions.note_flight("trip.handed_over", mission, trip, **facts)
