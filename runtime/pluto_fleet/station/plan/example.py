"""An example plan that this app and fleet can fly on this map."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, cycle, islice, product
from math import dist
from typing import TYPE_CHECKING

from ...shared.domain.actions import PICK, RELEASE, Action
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity
from ...shared.domain.quantities import Type
from ...shared.domain.text import mass
from .problems import read, unflyable_trips
from .shape import Shape

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...shared.domain.airspace import Corner

PLAUSIBLE: dict[Type, object] = {
    Type.INT: 1,
    Type.FLOAT: 1,
    Type.BOOL: True,
    Type.TEXT: "example",
    Type.MASS: "1 g",
    Type.LENGTH: "1 m",
    Type.TIME: "5 s",
    Type.ANGLE: "90 deg",
    Type.PERCENT: "50 %",
    Type.SPEED: "0.5 m/s",
    Type.TEMPERATURE: "20 C",
}
"""Values of parameters and fields without a default."""

HEAVIEST = 0.005
"""The item's mass in kilograms; half of the largest payload if that is less."""

CLEAR = 0.3
"""Metres around each place that are free."""

_MISSIONS, _TRIPS = 3, 3
_COLUMNS = 7
_EDGE = 0.1
"""The margin of the map without places, as a share."""

_WINDOWS = (2.0, 0.5, 0.2, 0.1, 0.05, 0.02)
"""Shares of the map, around the drones' homes, in which places are looked for: the first that
will do. On a large map a battery does not last for a way across."""

_TRIES = 20


def example_missions(app: App, fleet: FleetFile, taken: Sequence[str]) -> list[Shape]:
    """Return two or three missions without keys, with new names; raise `BadInput` if that fails."""
    wanted = _wanted(app, fleet)
    best: list[Shape] = []
    for share in _WINDOWS:
        found = [
            _mission(app, fleet, *one) for one in zip(wanted, _rows(fleet, share), strict=False)
        ]
        missions = [mission for mission in found if mission is not None]
        best = max(best, missions, key=len)
        if len(best) == len(wanted):
            break
    if not best:
        raise BadInput(
            "no example could be made: no drone of the fleet can do anything anywhere on this map"
        )
    numbers = (f"Example {i}" for i in range(1, len(taken) + len(best) + 1))
    names = (name for name in numbers if name not in taken)
    return [{"name": name, **mission} for name, mission in zip(names, best, strict=False)]


def _wanted(app: App, fleet: FleetFile) -> list[list[Shape]]:
    """Return the actions of each mission: one carries an item, the others do all other actions in turn."""
    flying = {drone.category for drone in fleet.drones}
    categories = [category for category in app.categories if category.name in flying]
    carrying = [one.payload for one in categories if one.can(PICK) and one.can(RELEASE)]
    single = [
        _trip(action)
        for action in app.actions.values()
        if action.name not in (PICK, RELEASE) and any(one.can(action.name) for one in categories)
    ]
    wanted = []
    if carrying:
        item = {"name": "parcel", "mass": mass(min(HEAVIEST, max(carrying) / 2))}
        carry: list[Shape] = [{"action": PICK, "item": item}, {"action": RELEASE, "item": item}]
        wanted = [carry] if single else [carry, carry]
    turn = cycle(single)
    while single and len(wanted) < _MISSIONS:
        wanted.append(list(islice(turn, _TRIPS)))
    return wanted


def _trip(action: Action) -> Shape:
    missing = {one.name: PLAUSIBLE[one.type] for one in action.parameters if one.default is None}
    return {"action": action.name, "parameters": missing}


def needed(app: App, on: Entity) -> Shape:
    """Return plausible values of the fields that must be filled in."""
    fields = [one for one in app.fields if one.on is on and one.hint]
    return {one.name: PLAUSIBLE[one.type] for one in fields if isinstance(one.type, Type)}


def _mission(
    app: App, fleet: FleetFile, wanted: Sequence[Shape], row: Sequence[Corner]
) -> Shape | None:
    """Return a mission with these actions at places of a row, if one can be flown."""
    for places in islice(_choices(row, len(wanted)), _TRIES):
        trips: list[Shape] = [
            {"key": str(i), **trip, **needed(app, Entity.TRIP), "target": list(place)}
            for i, (trip, place) in enumerate(zip(wanted, places, strict=True))
        ]
        filled = needed(app, Entity.MISSION)
        mission: Shape = {"key": "", "name": "1", **filled, "trips": trips}
        if not (
            read(app, fleet.airspace, [mission])[1]
            or unflyable_trips(app, fleet, fleet.airspace, mission)
        ):
            return {**filled, "trips": trips}
    return None


def _choices(row: Sequence[Corner], count: int) -> Iterator[tuple[Corner, ...]]:
    """Yield selections of places of a row, those far apart first."""
    last = len(row) - 1
    if last < count - 1:
        return
    spread = [row[round(i * last / max(1, count - 1))] for i in range(count)]
    yield tuple(spread)
    yield from combinations(row, count)


def _rows(fleet: FleetFile, share: float) -> Iterator[list[Corner]]:
    """Yield rows of free places in a window of the map."""
    homes = [drone.home for drone in fleet.drones]
    spans = []
    for axis, size in enumerate(fleet.airspace.size):
        edge, half = _EDGE * size, share * size / 2
        middle = sum(home[axis] for home in homes) / max(1, len(homes))
        spans.append((max(edge, middle - half), min(size - edge, middle + half)))
    (left, right), (low, high) = spans
    for up in range(_MISSIONS):
        y = low + (high - low) * (up + 0.5) / _MISSIONS
        row = [left + (right - left) * across / (_COLUMNS - 1) for across in range(_COLUMNS)]
        places = dict.fromkeys((round(x, 1), round(y, 1)) for x in row)
        yield [place for place in places if _has_room(fleet, place)]


def _has_room(fleet: FleetFile, place: Corner) -> bool:
    x, y = place
    around = product((x - CLEAR, x, x + CLEAR), (y - CLEAR, y, y + CLEAR))
    height = fleet.airspace.cruise_height
    return all(fleet.airspace.problem((*corner, height)) is None for corner in around) and all(
        dist(place, drone.home[:2]) > 2 * CLEAR for drone in fleet.drones
    )
