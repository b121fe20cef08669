"""From the records of an earlier life of the app, and a roll call of the drones, to living missions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from .flight import Flight, keep_carrier
from .interruption import (
    Fate,
    doubt,
    fly_again,
    fly_on,
    settle_doubt,
    standing,
    was_done,
    what_became,
)
from .journal.values import item_of, trip_of, value_of
from .status import Status, TripStatus

if TYPE_CHECKING:
    from .app import App
    from .core import Core
    from .engine import Engine
    from .gateway.commanding import Commanding
    from .journal.fold import Record, Records
    from .model import Drone, Mission, Trip
    from .standing import RollCall
    from .state import State


async def go_on(
    core: Core, engine: Engine, link: Commanding, roll: RollCall, records: Records
) -> list[Mission[Any]]:
    """Take up everything where it was interrupted; return all missions, those that ended too."""
    by_index = sorted(records.missions.items(), key=lambda item: int(item[1]["index"]))
    revival = _Revival(core, engine, link, roll)
    missions = [revival.rebuilt(name, record) for name, record in by_index]
    _restore_results(core, records, revival.trips, {m.name: m for m in missions})
    for drone in core.fleet.drones:
        drone.trips = records.flown.get(drone.id, 0)
    for mission in missions:
        record = records.missions[mission.name]
        if record["answer"] == "cancel":
            state = revival.state(mission, record)
            engine.set_aside(state)
            engine.end(state, Status.CANCELLED, "cancelled by hand")
        elif not record["ended"]:
            await revival.revive(mission, record)
    at_work = {entry.drone for entry in roll.jobs.values() if entry.flies}
    for drone in core.fleet.drones:
        if drone not in revival.engaged:
            if drone.id in at_work:
                link.break_off(
                    drone.id
                )  # the brain that ended its flight could not say so any more
            core.fleet.take_up(drone, roll.drones[drone.id])
    engine.look_for_the_end()
    return missions


class _Revival:
    """One recovery."""

    def __init__(self, core: Core, engine: Engine, link: Commanding, roll: RollCall) -> None:
        self._core, self._engine, self._link, self._roll = core, engine, link, roll
        self._drones = {drone.id: drone for drone in core.fleet.drones}
        self.engaged: set[Drone] = set()
        """The drones that belong to missions from the start."""
        self.trips: dict[str, dict[str, Trip]] = {}
        """By mission and name, those that are no more to be flown included."""
        self._unfit: dict[str, str] = {}
        """Why missions do not fit into the app as it is now."""

    def rebuilt(self, name: str, record: Record) -> Mission[Any]:
        """Return a mission as it stood."""
        app, trips = self._core.app, self.trips.setdefault(name, {})
        try:
            lists = [
                [trip_of(app, data, status) for data in record[which]]
                for which, status in _LISTS.items()
            ]
            mission = app.mission(
                name=name, trips=lists[0], index=record["index"], **record["fields"]
            )
        except (KeyError, TypeError) as error:
            self._unfit[name] = _unfit(app, record, error)
            mission, lists = app.mission(name=name, trips=[], index=record["index"]), [[], [], []]
        mission.completed_trips = lists[1]
        mission.status, mission.reason = Status(record["status"]), record["reason"]
        mission.round, mission.attempts = record["round"], record["attempts"]
        for trip in (*lists[2], *lists[1], *lists[0]):
            trip.now = self._core.kernel.time
            trips[trip.name] = trip
        return mission

    async def revive(self, mission: Mission[Any], record: Record) -> None:
        """Let a mission go on, or say why it waits for a person."""
        state = self.state(mission, record)
        flight = self._flight(state, record)
        why_held = self._why_held(mission.name, record)
        if why_held is not None:
            flown = record["flight"]
            if flown is not None and flown["outcome"] is None and not flown["heard"]:
                self._link.break_off(flown["drone"])
            if state.carrier is not None:
                self._check_carrier(state, None)
            self._engine.set_aside(state)
            self._core.transitions.hold(mission, why_held)
            return
        if record["answer"] == "go-on" and state.at not in self._core.app.resumes:
            state.at = next(iter(self._core.app.resumes), None)
        if state.carrier is not None:
            self._check_carrier(state, flight)
        aside = record["paused"] is not None or state.doom is not None
        if (
            flight is not None
            and not flight.is_set
            and not await self._settled(state, flight, record)
        ):
            return
        if state.doom is not None:
            self._engine.set_aside(state)
        elif aside:
            self._engine.set_aside(state)
            self._core.transitions.pause(mission)
        else:
            status = standing(state)
            if not state.goes_on:
                mission.status, mission.reason = status, ""
            self._engine.resume(state, status)

    def state(self, mission: Mission[Any], record: Record) -> State:
        """Return what was remembered of a mission beside what its user sees."""
        state = self._engine.new_state(mission)
        state.at = record["at"]
        state.first_start = record["first_start"]
        state.last_action_end = record["last_action_end"]
        state.waited = {_place(place) for place in record["waited"]} or None
        if record["delay"] is not None:
            place, over, begins = record["delay"]
            state.delay = _place(place), over, begins
        if record["carrier"] is not None:
            state.carrier = self._drones[record["carrier"]]
            state.carries = item_of(record["carries"])
        return state

    def _flight(self, state: State, record: Record) -> Flight | None:
        """Return the mission's last flight, if it still matters."""
        known = record["flight"]
        trip = None if known is None else self.trips[state.mission.name].get(known["trip"])
        if trip is None:
            return None
        drone = self._drones[known["drone"]]
        trip.drone = drone
        state.flight = flight = Flight(state, trip, drone, known["retry"])
        flight.launched_at = known["since"]
        if known["outcome"] is not None:
            flight.set(Status(known["outcome"]))
            state.goes_on = not known["heard"]
        elif known["heard"]:
            state.flight = None
            return None
        return flight

    async def _settled(self, state: State, flight: Flight, record: Record) -> bool:
        """Find out what became of a flight that had not ended; False: a person must say."""
        entry, answer = self._roll.jobs.get(flight.id), record["answer"]
        what = await what_became(self._core, flight, entry, bool(record["flight"]["begun"]))
        if what is Fate.UNKNOWN and answer in _ANSWERED and record["question"]:
            what = _ANSWERED[answer]
            self._engage(flight)
            settle_doubt(state, self._engine, self._link, what is Fate.DONE)
            return False
        if what is Fate.UNKNOWN:
            self._engage(flight)
            self._engine.set_aside(state)
            doubt(state, flight)
            return False
        if what is Fate.FLIES_ON:
            self.engaged.add(flight.flier)
            fly_on(state, flight, self._link)
            return True
        self._link.break_off(flight.drone)
        if what is Fate.DONE:
            was_done(state, flight)
        else:
            fly_again(state, flight, self._link)
        if state.carrier is not None:
            self.engaged.add(state.carrier)
            keep_carrier(state, state.carrier)
        return True

    def _engage(self, flight: Flight) -> None:
        if flight.trip.item is not None:
            self.engaged.add(flight.flier)

    def _check_carrier(self, state: State, flight: Flight | None) -> None:
        """See whether the mission's item is still where it was."""
        drone, item = state.carrier, state.carries
        if drone is None or item is None or (flight is not None and not flight.is_set):
            return
        self.engaged.add(drone)
        found = self._roll.drones[drone.id]
        if found.reached and found.carrying != item.name:
            state.carrier = state.carries = None
            self.engaged.discard(drone)
            state.end(f"{item.name} is not aboard {drone.id} any more")
        else:
            keep_carrier(state, drone)

    def _why_held(self, name: str, record: Record) -> str | None:
        if name in self._unfit:
            return self._unfit[name]
        at, points = record["at"], self._core.app.resumes
        if record["answer"] == "go-on":
            return None
        if at is not None and at not in points:
            return f"it stopped at block {at}, which the app has no more as a place to go on"
        return None


def _unfit(app: App, record: Record, error: Exception) -> str:
    for trip in (*record["todo"], *record["done"]):
        if trip["action"] not in app.actions:
            return f"its trip {trip['name']} needs the action {trip['action']}, which the app has no more"
    return f"it does not fit into the app as it is now: {error}"


def _restore_results(
    core: Core,
    records: Records,
    trips: Mapping[str, Mapping[str, Trip]],
    missions: Mapping[str, Mission[Any]],
) -> None:
    """Put back what every action has given, and what each evaluator has not seen of it."""
    values = core.results.values
    for number, (name, trip, round_, attempt, value) in enumerate(records.results):
        mission = missions[name]
        start = len(values)
        what = trips[name].get(trip)
        values += (mission, what, round_, attempt, value_of(value), mission.last_result)
        if number >= records.missions[name]["judged"]:
            mission.last_result = start


def _place(place: Iterable[Any]) -> tuple[str, str, int, int]:
    block, trip, round_, attempt = place
    return block, trip, round_, attempt


_LISTS = {
    "todo": TripStatus.WAITING,
    "done": TripStatus.COMPLETED,
    "gone": TripStatus.SKIPPED,
}
"""The lists of a record, and how the trips in them stand if it does not say."""

_ANSWERED = {"done": Fate.DONE, "not-done": Fate.AGAIN}
"""What a person's answers say of a flight's fate."""
