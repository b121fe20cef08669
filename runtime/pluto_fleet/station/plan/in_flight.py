"""A drawn mission that flies or has flown: what may still be changed, how the plan follows, what is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import TYPE_CHECKING, Any

from ...files.writing import trip_table
from ...flight.changing import flying, left
from ...shared.domain.actions import PICK, RELEASE
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity, FieldType
from ...shared.domain.text import quoted
from ...shared.hooks.plain_data import trip_data, trip_of
from .problems import bare, read
from .shape import BROKEN_OFF, COMPLETED, Shape
from .text import trip_shape

if TYPE_CHECKING:
    from ...app import App
    from ...journal.standing import Record
    from ...shared.domain.airspace import Airspace


_OF_FLIGHTS = frozenset(
    (
        *("index", "attempt", "added", "status", "reason", "start_time", "end_time"),
        *("round", "drone", "number", "rank"),
    )
)
"""What a flight's record has of a trip and a plan has not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnChange:
    """A change of a mission that flies, as a page has drawn it."""

    tables: list[Mapping[str, object]]
    """All that is to be flown from now on, as in a missions file."""
    trips: list[Shape]
    """The mission's trips in the plan from now on, those that have flown first."""
    is_one: bool


def named(fixed: Shape, trips: Sequence[Shape]) -> list[Shape]:
    """Return trips as drawn, each known one with its name in the flight."""
    numbers = {one["key"]: str(number) for number, one in enumerate(fixed["trips"], 1)}
    names = {one["key"]: one.get("name") or numbers[one["key"]] for one in fixed["trips"]}
    return [
        {**one, "name": one.get("name") or names[one["key"]]} if one["key"] in names else one
        for one in trips
    ]


def differs(fixed: Shape, drawn: Shape) -> bool:
    """Return whether a page has drawn other trips than a mission flies."""
    before, after = (named(fixed, one["trips"]) for one in (fixed, drawn))
    keys = [[one["key"] for one in trips] for trips in (before, after)]
    return keys[0] != keys[1] or list(map(bare, before)) != list(map(bare, after))


def drawn_change(app: App, fixed: Shape, drawn: Sequence[Shape], record: Record) -> DrawnChange:
    """Return what a page's trips change of a mission that flies; raise `BadInput` if they are too late.

    What the page has left as it was is flown as the flight has it, as the app's own code may have
    changed that; so are trips that this has added.
    """
    to_do = {one["name"]: one for one in left(record)}
    off = [one["name"] for one in (*record["done"], *flying(record))]
    known = {one["name"]: one for one in named(fixed, fixed["trips"])}
    given = _with_free_names(named(fixed, drawn), {*known, *to_do, *off})
    after = {one["name"]: one for one in given}
    for name in off:
        if _bare(known, name) != _bare(after, name):
            flies = any(one["name"] == name for one in flying(record))
            what = "has taken off" if flies else "has been flown"
            raise BadInput(
                f"mission {quoted(fixed['name'])}: trip {quoted(name)} {what} meanwhile, and cannot"
                " be changed any more: look at the mission again"
            )
    trips = [one for name, one in known.items() if name in off]
    tables: list[Mapping[str, object]] = []
    is_one = False
    for name, trip in after.items():
        if name in off:
            continue
        trips.append(trip)
        is_same = _bare(known, name) == bare(trip)
        if name in to_do and is_same:
            tables.append(trip_table(app, trip_of(app, to_do[name])))
        elif name in to_do or not is_same:  # else it was skipped, and stays so
            tables.append(bare(trip))
            is_one = True
    others = [one for name, one in to_do.items() if name not in known]
    tables += [trip_table(app, trip_of(app, one)) for one in others]
    is_one |= [one["name"] for one in tables] != list(to_do)
    return DrawnChange(tables=tables, trips=_sparsely_named(trips), is_one=is_one)


def followed(
    app: App, airspace: Airspace, fixed: Shape, record: Record, keyed: Callable[[Shape], Shape]
) -> list[Shape]:
    """Return the trips of a drawn mission as its flight has them; `keyed` gives new ones a key."""
    known = {one["name"]: one for one in named(fixed, fixed["trips"])}
    missions, problems = read(
        app, airspace, [{**fixed, "trips": list(known.values())}], fixed.get("after", ())
    )
    drawn: Mapping[str, Any] = {}
    if not problems:
        drawn = {one.name: _content(trip_data(app, one)) for one in missions[0].trips}
    gone = {one["name"] for one in record["gone"]}
    trips = []
    for now in (*record["done"], *record["todo"]):
        name = now["name"]
        if name in known and drawn.get(name) == _content(now):
            trips.append(known[name])
        elif not now.get("added"):
            new = trip_shape(app, trip_of(app, now))
            trips.append({**new, "key": known[name]["key"]} if name in known else keyed(new))
    skipped = [one for name, one in known.items() if name in gone and not record.get("replanned")]
    return _sparsely_named([*trips, *skipped])


def _content(trip: Mapping[str, Any]) -> dict[str, Any]:
    return {key: one for key, one in trip.items() if key not in _OF_FLIGHTS}


def _bare(trips: Mapping[str, Shape], name: str) -> Shape | None:
    return bare(trips[name]) if name in trips else None


def _with_free_names(trips: Sequence[Shape], taken: set[str]) -> list[Shape]:
    used = taken | {one["name"] for one in trips if one.get("name")}
    free = (str(number) for number in count(1) if str(number) not in used)
    return [one if one.get("name") else {**one, "name": next(free)} for one in trips]


def _sparsely_named(trips: Sequence[Shape]) -> list[Shape]:
    """Return trips with a name only where that is not their number anyway."""
    return [
        {key: one[key] for key in one if key != "name" or one[key] != str(place)}
        for place, one in enumerate(trips, 1)
    ]


FAILED = ("FAILED", BROKEN_OFF)
"""How missions end of which something is missing without a person's decision."""


def settled(record: Mapping[str, Any]) -> list[str]:
    """Return the names of the trips of a flown mission that were done, or left out by a decision."""
    return [trip["name"] for trip in (*record["done"], *record["gone"])]


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
        for number, trip in enumerate(mission["trips"], 1)
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
