"""What becomes of a mission's trips when a person changes those that have not flown, while it is under way."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from typing import TYPE_CHECKING, Any

from ..files.plan_check import unflyable
from ..files.reading import Document, PlanTable
from ..files.writing import trip_table
from ..shared.alone.files import read_trips
from ..shared.domain.actions import PICK
from ..shared.domain.errors import BadInput
from ..shared.domain.text import percent, quoted
from ..shared.domain.values import shortened
from ..shared.fleet.reach import Reach, chain_of
from ..shared.hooks.plain_data import trip_data, trip_of
from .reconcile import in_flight

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..jobs.telemetry import Telemetry
    from ..journal.standing import Record
    from ..shared.domain.model import Trip

Given = Sequence[object]
"""Trips as a missions file has them, in their order; one without a name is a new one."""


def flying(record: Record) -> list[Record]:
    """Return the trip that flies now, as a list of one, or of none."""
    flight = in_flight(record)
    return (
        [] if flight is None else [one for one in record["todo"] if one["name"] == flight["trip"]]
    )


def left(record: Record) -> list[Record]:
    """Return the trips of a mission that have not flown yet."""
    now = flying(record)
    return [one for one in record["todo"] if one not in now]


class TripChange:
    """What a mission has still to do, in place of what it had."""

    def __init__(
        self, app: App, fleet: FleetFile, mission: str, record: Record, given: Given
    ) -> None:
        """Read the trips; raise `BadInput` with everything that keeps them from being flown."""
        self._app, self._fleet, self._mission, self._record = app, fleet, mission, record
        self._now = flying(record)
        self._before = [trip_of(app, one) for one in (*self._aboard(), *self._now)]
        """What the new trips build on: from the pick of an item that is aboard to the trip that flies."""
        if not record["todo"]:
            raise BadInput(f"{self._who}: all its trips have flown: begin another mission instead")
        if not given and not self._now:
            raise BadInput(f"{self._who} would have no trip left: cancel it instead")
        self.trips = self._read(given)
        self._refuse_what_cannot_be_flown()
        known = {one["name"]: one for one in record["todo"]}
        first = 1 + max(one["index"] for one in _all(record))
        new = [self._data(trip, first + place, known) for place, trip in enumerate(self.trips)]
        self.in_place = bool(self._now) or self._begins_the_same()
        """Whether the mission can stay where it is in its graph, as what it does now is not changed."""
        self.todo: list[Record] = [*self._now, *new]
        """All that is to do now, the trip that flies included."""
        if self.in_place:
            self.todo[0] = record["todo"][0]

    @property
    def _who(self) -> str:
        return f"mission {quoted(self._mission)}"

    def _begins_the_same(self) -> bool:
        before = [trip_of(self._app, one) for one in self._record["todo"]]
        return self._same(chain_of(before), chain_of(self.trips))

    def _same(self, some: Sequence[Trip], others: Sequence[Trip]) -> bool:
        def content(trips: Sequence[Trip]) -> list[Mapping[str, Any]]:
            kept = ("index", "attempt", "added", "status")
            data = [trip_data(self._app, one) for one in trips]
            return [{key: one[key] for key in one if key not in kept} for one in data]

        return content(some) == content(others)

    def _aboard(self) -> list[Record]:
        """Return the trips from the pick of the item that is aboard on."""
        if self._record["carries"] is None:
            return []
        done: list[Record] = self._record["done"]
        picks = [place for place, one in enumerate(done) if one["action"] == PICK]
        return done[picks[-1] :] if picks else []

    def _read(self, given: Given) -> list[Trip]:
        tables = [*(trip_table(self._app, one) for one in self._before), *self._named(given)]
        document = Document("", {"mission": [{"name": self._mission, "trip": tables}]})
        table = PlanTable(document, {"trip": tables}, ("mission", 0), self._who)
        trips = read_trips(table, self._app, self._fleet.airspace)
        document.refuse_if_bad()
        return trips[len(self._before) :]

    def _named(self, given: Given) -> Iterator[object]:
        """Yield the trips with names: of those that flew none may be used again, as it says what was done."""
        used = {str(one["name"]): one for one in _all(self._record)}
        past = [one["name"] for one in self._record["done"]]
        named = {str(one["name"]) for one in given if isinstance(one, dict) and "name" in one}
        free = (str(number) for number in count(1) if str(number) not in {*used, *named})
        for one in given:
            if not isinstance(one, dict):
                yield one
                continue
            name = one.get("name")
            if name in past or any(name == now["name"] for now in self._now):
                what = "has been flown" if name in past else "has taken off"
                raise BadInput(
                    f"{self._who}: trip {quoted(str(name))} {what} meanwhile, and cannot be changed"
                    " any more: look at the mission again"
                )
            yield one if name is not None else {**one, "name": next(free)}

    def _refuse_what_cannot_be_flown(self) -> None:
        trips = [*self._before, *self.trips]
        mission = self._app.mission(name=self._mission, trips=trips)
        new = {*map(id, self.trips)}
        said = [
            f"{miss.called}: {miss.reason}"
            for miss in unflyable([mission], self._app, self._fleet, self._fleet.airspace)
            if any(id(trip) in new for trip in miss.trips)
        ]
        if said:
            raise BadInput(shortened(said))

    def refuse_too_little_battery(self, drone: str, telemetry: Telemetry) -> None:
        """Raise `BadInput` if what is aboard a drone cannot be brought where it shall be now.

        Nothing else asks for that: the drone was chosen for the way that it had before.
        """
        chain = chain_of([*self._before, *self.trips])
        rest = chain[len(self._before) - len(self._now) :]
        old = chain_of([*self._before, *(trip_of(self._app, one) for one in left(self._record))])
        if len(chain) <= len(self._before) or self._same(chain, old):
            return
        entry = next(one for one in self._fleet.drones if one.id == drone)
        category = next(one for one in self._app.categories if one.name == entry.category)
        reach = Reach(self._app, self._fleet.airspace)
        needs = reach.level(category, entry.home, telemetry.location, rest)
        if telemetry.battery_level < needs:
            raise BadInput(
                f"{self._who}: {drone} has {percent(telemetry.battery_level)} in its battery, and"
                f" needs {percent(needs)} for what it carries to come there, and home"
            )

    def _data(self, trip: Trip, index: int, known: Mapping[str, Record]) -> Record:
        """Return a trip's record: one that had it before keeps what came of it so far."""
        trip.index = index
        data: Record = trip_data(self._app, trip)
        before: Record = known.get(trip.name, {})
        kept: Record = {key: before[key] for key in ("attempt", "added") if key in before}
        if before.get("status") == "FAILED":
            kept["attempt"] = before.get("attempt", 1) + 1
        return {**data, **kept}


def refuse_if_stale(mission: str, record: Record, replaces: Sequence[object]) -> None:
    """Raise `BadInput` unless these are the names of the trips that have not flown."""
    now = [one["name"] for one in left(record)]
    if now == [*replaces]:
        return
    off = [str(one) for one in replaces if one not in now]
    changed = f"trip {quoted(off[0])} is not to be flown any more" if off else "it was changed"
    if off and any(one["name"] == off[0] for one in flying(record)):
        changed = f"trip {quoted(off[0])} has taken off meanwhile"
    elif off and any(one["name"] == off[0] for one in record["done"]):
        changed = f"trip {quoted(off[0])} has been flown meanwhile"
    raise BadInput(f"mission {quoted(mission)}: {changed}: look at it again")


def _all(record: Record) -> list[Record]:
    return [*record["done"], *record["todo"], *record["gone"]]
