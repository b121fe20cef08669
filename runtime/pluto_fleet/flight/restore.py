"""Restoring missions, trips, flights and results from the records of an earlier run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status, TripStatus
from plutoc_runtime.hooks.values import item_of, trip_of, value_of
from plutoc_runtime.trips.flight import Flight

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission, Trip
    from plutoc_runtime.flow.mission import Core, MissionState

    from ..journal.fold import Record, Records


@dataclass(slots=True, kw_only=True)
class Rebuilt:
    """One restored mission."""

    mission: Mission[Any]
    record: Record
    trips: dict[str, Trip] = field(default_factory=dict)
    """By name, also those that are not to be flown any more."""
    unfit: str | None = None
    """Why it does not fit the present app."""


def rebuilt(core: Core, name: str, record: Record) -> Rebuilt:
    """Restore a mission; one that does not fit the app any more is empty."""
    app, unfit = core.app, None
    try:
        todo, done, gone = (
            [trip_of(app, data, status) for data in record[which]]
            for which, status in _LISTS.items()
        )
        given = record["fields"]
        mission = app.mission(name=name, trips=todo, index=record["index"], **given)
    except (KeyError, TypeError) as error:
        unfit = _unfit(app, record, error)
        todo = done = gone = []
        mission = app.mission(name=name, trips=[], index=record["index"])
    mission.completed_trips = done
    mission.status, mission.reason = Status(record["status"]), record["reason"]
    mission.round, mission.attempts = record["round"], record["attempts"]
    one = Rebuilt(mission=mission, record=record, unfit=unfit)
    for trip in (*gone, *done, *todo):
        trip.now = core.kernel.time
        one.trips[trip.name] = trip
    return one


def remember(state: MissionState, record: Record, drones: Mapping[str, Drone]) -> None:
    """Restore a mission's state."""
    state.at, state.interrupted = record["at"], record["interrupted"]
    state.first_start = record["first_start"]
    state.last_action_end = record["last_action_end"]
    state.waited = {_place(place) for place in record["waited"]} or None
    if record["delay"] is not None:
        place, over, begins = record["delay"]
        state.delay = _place(place), over, begins
    if record["carrier"] is not None:
        state.carrier, state.carries = drones[record["carrier"]], item_of(record["carries"])


def last_flight(state: MissionState, one: Rebuilt, drones: Mapping[str, Drone]) -> Flight | None:
    """Restore the mission's last flight, if it still matters, and return it."""
    known = one.record["flight"]
    trip = None if known is None else one.trips.get(known["trip"])
    if trip is None or (known["outcome"] is None and known["heard"]):
        return None
    trip.drone = drone = drones[known["drone"]]
    state.flight = flight = state.new_flight(trip, drone, known["retry"])
    flight.launched_at = known["since"]
    if known["outcome"] is not None:
        flight.set(Status(known["outcome"]))
        state.goes_on = not known["heard"]
    return flight


def restore_results(core: Core, records: Records, missions: Mapping[str, Rebuilt]) -> None:
    """Restore all results, and which of them each evaluator has not seen."""
    for number, (name, trip, round_, attempt, value) in enumerate(records.results):
        one = missions[name]
        mission, gave = one.mission, value_of(value)
        kept = core.results.add(mission, one.trips.get(trip), round_, attempt, gave)
        if number >= one.record["judged"]:
            mission.last_result = kept


def _unfit(app: App, record: Record, error: Exception) -> str:
    for trip in (*record["todo"], *record["done"]):
        if trip["action"] not in app.actions:
            return f"its trip {trip['name']} needs the action {trip['action']}, which the app has no more"
    return f"it does not fit into the app as it is now: {error}"


def _place(place: Iterable[Any]) -> tuple[str, str, int, int]:
    block, trip, round_, attempt = place
    return block, trip, round_, attempt


_LISTS = {
    "todo": TripStatus.WAITING,
    "done": TripStatus.COMPLETED,
    "gone": TripStatus.SKIPPED,
}
"""The lists of a record, and the default status of the trips in them."""
