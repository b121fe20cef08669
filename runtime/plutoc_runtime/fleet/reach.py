"""Whether a drone can fly a trip and come home: its abilities, its time and its battery.

The same arithmetic for plan, allocation and simulation. The ground is at height 0. A drone in the air drains
its battery evenly, moving or not.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from functools import lru_cache
from math import dist, hypot, inf
from typing import TYPE_CHECKING, Any, NamedTuple

from ..domain.actions import BUILT_IN, PICK, RELEASE
from ..domain.fields import FieldType
from ..domain.text import mass, percent, place, quoted

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Category, Item, Mission, Point, Trip

Stop = tuple["Point", float]  # a point to fly to, and the seconds that the drone is busy there
Stops = Sequence[Stop]

LOW = 0.2  # a drone goes home when its battery holds no more than so much above its reserve
DOCK_REACH = 0.2  # how near its home a drone must land to be charged there, in metres


def docked(landed_at: Point, home: Point) -> bool:
    """Return whether a drone that landed there stands in its dock."""
    return landed_at == home or dist(landed_at[:2], home[:2]) <= DOCK_REACH


def flight_seconds(
    category: Category, airspace: Airspace, start: Point, points: Sequence[Point], actions: float
) -> float:
    """Return how long it takes to fly through all points, with the seconds of actions on the way.

    A start on the ground (z = 0) counts the take-off to cruise height; a last point on the ground
    counts the landing there, from the height flown before. From beyond the bounds of the map it first
    flies back in. Infinite where no route leads.
    """
    motion = category.motion
    speed = category.speed
    seconds = actions
    here = airspace.within(start)
    if here[:2] != start[:2] or start[2] > here[2]:
        seconds += motion.leg(dist(start, here), speed)
    if points and start[2] <= 0:
        here = (here[0], here[1], airspace.cruise_height)
        seconds += motion.rises(here[2], speed)
    for number, point in enumerate(points, 1):
        there = point
        if number == len(points) and point[2] <= 0:
            there = (point[0], point[1], here[2])
            seconds += motion.lands(there[2], speed)
        way = airspace.route(here, there)
        if way is None:
            return inf
        for corner in way:
            seconds += motion.flies(dist(here, corner), motion.against(here, corner, speed))
            here = corner
        here = there
    return seconds


def needed(
    category: Category, airspace: Airspace, start: Point, stops: Stops, home: Point
) -> float:
    """Return the share of the battery for all stops, each with its action, and back home, without the reserve.

    Infinite: no route leads there, or none home.
    """
    points = [point for point, _ in stops]
    points.append((home[0], home[1], 0.0))
    actions = sum(seconds for _, seconds in stops)
    return flight_seconds(category, airspace, start, points, actions) / category.endurance


class Lacks(IntEnum):
    """What a drone lacks for a trip, in order of severity."""

    ACTION = 0
    PAYLOAD = 1
    WAY = 2
    ENERGY = 3


class Miss(NamedTuple):
    """What a drone lacks, and by how much."""

    lacks: Lacks
    by: float  # how much is lacking: of two alike the smaller is nearer
    reason: str


def chain_of(trips: Sequence[Trip]) -> Sequence[Trip]:
    """Return the trips that one drone must fly: the first, and from a pick all to its release."""
    if trips and trips[0].action == PICK:
        for number, trip in enumerate(trips, 1):
            if trip.action == RELEASE:
                return trips[:number]
        return trips
    return trips[:1]


def miss_of(
    app: App, airspace: Airspace, category: Category, home: Point, chain: Sequence[Trip]
) -> Miss | None:
    """Return what a drone of this category and home lacks for the chain; None: nothing."""
    unfit = _unfit(category, chain)
    if unfit is not None:
        return unfit
    stops = stops_of(app, category, airspace.cruise_height, chain)
    share = needed(category, airspace, home, stops, home)
    if share == inf:
        return Miss(Lacks.WAY, 0.0, _no_way(category, airspace, home, stops))
    if share + category.reserve > 1:
        reason = (
            f"{category.name} would need {percent(share)} of a full battery from its home "
            f"{place(home)} and back, and {percent(category.reserve)} must be left"
        )
        return Miss(Lacks.ENERGY, share + category.reserve - 1, reason)
    return None


def _unfit(category: Category, chain: Sequence[Trip]) -> Miss | None:
    """Return what drones of this category lack for the chain wherever it leads; None: nothing."""
    for trip in chain:
        if not category.can(trip.action):
            return Miss(Lacks.ACTION, 0.0, f"{category.name} cannot {trip.action}")
    for trip in chain:
        if trip.item is not None and trip.item.mass > category.payload:
            most = mass(category.payload)
            reason = (
                f"{category.name} carries at most {most}, the item weighs {mass(trip.item.mass)}"
            )
            return Miss(Lacks.PAYLOAD, trip.item.mass - category.payload, reason)
    return None


def stops_of(app: App, category: Category, cruise: float, chain: Sequence[Trip]) -> Stops:
    """Return the stops of a chain, with the seconds that the drone is busy at each.

    Between two trips of a chain it lands with its item, and takes off again.
    """
    stops: list[Stop] = []
    motion = category.motion
    for number, trip in enumerate(chain, 1):
        if trip.source is not None:
            stops.append((trip.source, 0.0))
        busy = app.actions[trip.action].lasts(trip.parameters)
        if number < len(chain):
            busy += motion.lands(trip.target[2], category.speed)
            busy += motion.rises(cruise, category.speed)
        stops.append((trip.target, busy))
    return stops


def _no_way(category: Category, airspace: Airspace, home: Point, stops: Stops) -> str:
    here = home
    for point, _ in [*stops, (home, 0.0)]:
        if airspace.route(here, point) is None:
            break
        here = point
    return f"{category.name} finds no permitted way from {place(here)} to {place(point)}"


def grip_problem(
    drone: str, category: Category, aboard: Item | None, action: str, item: Item | None
) -> str | None:
    """Return why a drone with this item aboard cannot pick or release an item, or None."""
    if action == PICK:
        if item is None:
            return "there is nothing to pick"
        if aboard is not None:
            return f"{drone} already carries {aboard.name}"
        if item.mass > category.payload + 1e-9:
            most = mass(category.payload)
            return f"{item.name} weighs {mass(item.mass)}, {drone} carries at most {most}"
    if action == RELEASE and (aboard is None or item is None or aboard.name != item.name):
        carries = "nothing" if aboard is None else aboard.name
        return f"{drone} carries {carries}" + ("" if item is None else f", not {item.name}")
    return None


def problems(
    app: App, missions: Sequence[Mission[Any]], fleet: FleetData, *, forever: bool
) -> list[str]:
    """Return a sentence for each trip that no drone could ever fly.

    Unless `forever` is allowed, also one for each mission that repeats without end.
    """
    kinds = {category.name: category for category in app.categories}
    rounds = [field.name for field in app.fields if field.type is FieldType.ROUNDS]
    found: list[str] = []
    for mission in missions:
        trips: Sequence[Trip] = mission.trips
        while trips:
            chain = chain_of(trips)
            trips = trips[len(chain) :]
            misses = [
                miss_of(app, fleet.airspace, kinds[drone.category], drone.home, chain)
                for drone in fleet.drones
            ]
            if None not in misses:
                nearest = min(filter(None, misses), key=lambda miss: (-miss.lacks, miss.by))
                who = f"mission {quoted(mission.name)}, trip {chain[0].name}"
                found.append(f"{who}: no drone of the fleet can do it: {nearest.reason}")
        if not forever and any(getattr(mission, name, None) is True for name in rounds):
            why = "repeats until it is stopped: say when with --until, such as --until 2h"
            found.append(f"mission {quoted(mission.name)} {why}")
    return found


def idle_actions(app: App, fleet: FleetData) -> list[str]:
    """Return a sentence for each action that no drone can do; these missions may not need it."""
    there = {drone.category for drone in fleet.drones}
    found: list[str] = []
    for action in app.actions:
        able = [category.name for category in app.categories if category.can(action)]
        if there.isdisjoint(able) and (able or action not in BUILT_IN):
            who = f"it has no {' and no '.join(able)}" if able else "no category of the app can"
            found.append(f"no drone of the fleet can {action}: {who}")
    return found


def reckoned(app: App, missions: Sequence[Mission[Any]]) -> list[str]:
    """Return a sentence for each action of these missions whose duration is not declared."""
    used = {trip.action for mission in missions for trip in mission.trips}
    return [
        f"{action.name} is reckoned with {action.seconds:g} s: `takes` in the app says how long it takes"
        for action in app.actions.values()
        if action.takes is None and action.name in used
    ]


Bounds = tuple[float, float, float]
"""The least level beside the way, and for each metre of it; and what is enough for a drone that stands at home,
wherever on the map that is: infinite where a route must be searched to tell."""
_FAR = 1e6  # metres of a long leg: a metre of a short one takes no less
_BEYOND = 0.01  # metres beyond an edge of the map that do not count
_LESS = 1 - 1e-9  # sums of floats are not exact, and bounds must be true
_MORE = 1 + 1e-8


class Reach:
    """The battery that trips take of drones: exactly, by a search for a route, and at least."""

    def __init__(self, app: App, airspace: Airspace, homes: Sequence[Point] = ()) -> None:
        """`homes`: where drones stand at first."""
        self.app = app
        self.airspace = airspace
        docks = [(x, y, -z) for x, y, z in homes]  # on the ground, where heights have no sign
        ends = [(0.0, 0.0, airspace.cruise_height), *docks]
        self._is_open = not airspace.no_fly and not any(map(airspace.problem, ends))
        """Whether nothing is in the way from any dock to any place on the map."""
        self._bounds = lru_cache(1_000)(self._bounds_of)  # plans repeat their targets

    def level(self, category: Category, home: Point, here: Point, trips: Sequence[Trip]) -> float:
        """Return the battery level that the first chain of trips needs from here; infinite: it cannot be flown."""
        chain = chain_of(trips)
        if _unfit(category, chain):
            return inf
        stops = stops_of(self.app, category, self.airspace.cruise_height, chain)
        return needed(category, self.airspace, here, stops, home) + category.reserve

    def takes(self, category: Category, trip: Trip) -> Bounds:
        """Return what a trip takes of a battery at least, and what is enough."""
        seconds = self.app.actions[trip.action].lasts(trip.parameters)
        is_straight = trip.source is None and trip.item is None and category.can(trip.action)
        return self._bounds(category, seconds, trip.target, is_straight)

    def _bounds_of(
        self, category: Category, seconds: float, target: Point, is_straight: bool
    ) -> Bounds:
        space = self.airspace
        motion = category.motion
        speed = category.speed
        upright = motion.rises(space.cruise_height, speed) + motion.lands(target[2], speed)
        upright += 2 * motion.settles + seconds
        a_metre = motion.leg(_FAR, speed) / _FAR
        share = 1.0 / category.endurance
        least = category.reserve + share * upright * _LESS
        way = share * a_metre * _LESS
        enough = inf
        if is_straight and self._is_open and not motion.wind and not space.problem(target):
            slack = a_metre * abs(target[2] - space.cruise_height) + 2 * motion.shortness(speed)
            enough = (least + 2 * (hypot(*space.size) + _BEYOND) * way) * _MORE + share * slack
        return least, way, enough
