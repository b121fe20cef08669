"""Alternative sections: at other heights, home, and down to the ground."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain, islice, pairwise
from math import dist, hypot
from typing import TYPE_CHECKING

from ...jobs.landing_sites import free_spots, is_free
from ...shared.fleet.reach import docked
from .legs import leg_problem
from .reservations import box_of
from .way_back import way_back

if TYPE_CHECKING:
    from ...jobs.controls import FleetDrone
    from ...jobs.telemetry import Telemetry
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Category, Point
    from .reservations import Box


FURTHEST, SHARE = 1.5, 0.05
"""How many metres higher or lower a drone flies to avoid another; on long routes, a share of the length."""
LOWEST = 0.5
"""Below this height a drone only takes off and lands."""


@dataclass(frozen=True, slots=True)
class Section:
    """A drone's route from one resting place to the next, on the ground or hovering."""

    drone: str
    points: tuple[Point, ...]
    """The first is where it is now."""
    stands: bool
    """It begins on the ground: the second point is right above the first."""
    lands: bool
    """It ends on the ground: the last point is right below the one before."""
    tail: tuple[Point, ...] = ()
    """Where it goes next by default: to its dock."""
    shoots: tuple[Point, ...] = ()
    """Where it may still shoot to at first, as it comes from another way."""
    aside: bool = False
    """It only makes room for others."""
    target: Point | None = None
    """Where it was to end, if it ends beside that."""
    whole: tuple[Point, ...] = field(init=False, compare=False, repr=False)
    """It with its tail, and where it may shoot to."""
    box: Box = field(init=False, compare=False, repr=False)
    """The box around all that."""

    def __post_init__(self) -> None:
        # Frozen, yet both are asked for again and again.
        whole = self.points
        if self.tail or self.shoots:
            whole = (*whole, *self.tail, *self.shoots)
        object.__setattr__(self, "whole", whole)
        object.__setattr__(self, "box", box_of(whole))

    def seconds(self, category: Category) -> float:
        """Return how long a drone of this category takes for it."""
        way = self.points[1 if self.stands else 0 : -1 if self.lands else None] or self.points
        stages = category.motion.stages(way, category.speed, self.stands, self.lands)
        return sum(before + flies + after for _, before, flies, after in stages)

    def bent(self, offset: float) -> Section:
        """Return the section with the middle of its only leg raised, which costs next to nothing."""
        index = 2 if self.stands else 1
        (ax, ay, az), (bx, by, bz) = self.points[index - 1 : index + 1]
        middle = (ax + bx) / 2, (ay + by) / 2, (az + bz) / 2 + offset
        return replace(self, points=(*self.points[:index], middle, *self.points[index:]))

    def at_height(self, offset: float) -> Section:
        """Return the section raised by a height, with the same resting places."""
        points = self.points
        way = points[1 if self.stands else 0 : -1 if self.lands else None]
        shifted = tuple((x, y, z + offset) for x, y, z in way)
        return replace(self, points=(points[0], *shifted, points[-1]))


def sections(section: Section, step: float, airspace: Airspace) -> Iterator[Section]:
    """Yield a section, and then variants at other heights: the smallest detour first.

    None is lower than the cruise height: obstacles there are not known.
    """
    yield section
    way = section.points[1 if section.stands else 0 : -1 if section.lands else None]
    if len(way) < 2 or all(point[:2] == way[0][:2] for point in way) or step <= 0:
        return
    heights = [point[2] for point in way]
    most, least = max(heights), min(heights)
    floor = min(least, airspace.cruise_height)
    furthest = max(FURTHEST, SHARE * sum(map(dist, way, way[1:])))
    count = 1
    while count * step <= furthest + 1e-9:
        for offset in (count * step, -count * step):
            if floor - 1e-9 <= least + offset and most + offset <= airspace.ceiling + 1e-9:
                if len(way) == 2:
                    yield section.bent(offset)
                yield section.at_height(offset)
        count += 1


_LEVELS_HOME = 9
"""How many heights are tried."""
_PARTS = (0.5, 0.25, 0.75)
"""At which share of the length a route is farthest from the straight one."""
_ASIDE = (0.6, -0.6, 1.2, -1.2)
"""Sideways offsets in metres; negative: to the right."""


def ways_home(
    airspace: Airspace, drone: FleetDrone, here: Point, stands: bool, step: float
) -> list[Section]:
    """Return sections home that end on the ground; none if there is no route."""
    cruise, (x, y, _) = airspace.cruise_height, here
    start = (x, y, cruise) if stands else here
    end = (drone.home[0], drone.home[1], min(start[2], cruise))
    route = airspace.route(start, end)
    if route is None:
        return []
    ways = [(start, *route)]
    for level in range(_LEVELS_HOME):
        height = cruise + level * step
        if height <= airspace.ceiling + 1e-9:
            over = ((x, y, height), *((px, py, height) for px, py, _ in route))
            if len(route) == 1 and level:
                (ax, ay, _), (bx, by, _) = over
                ways.append((start, ((ax + bx) / 2, (ay + by) / 2, height), end))
            ways.append((start, *over, end))
    if len(route) == 1:
        ways += _around(airspace, start, end)
    ground = (end[0], end[1], 0.0)
    return [Section(drone.id, _without_repeats((here, *way, ground)), stands, True) for way in ways]


def _around(airspace: Airspace, start: Point, end: Point) -> Iterator[tuple[Point, ...]]:
    """Yield routes to the left and to the right of the straight one."""
    (x, y, z), (dx, dy, dz) = start, (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    far = hypot(dx, dy)
    if not far:
        return
    for part in _PARTS:
        for aside in _ASIDE:
            turn = (
                x + part * dx - aside * dy / far,
                y + part * dy + aside * dx / far,
                z + part * dz,
            )
            if (
                airspace.problem(turn) is None
                and leg_problem(airspace, start, turn) is None
                and leg_problem(airspace, turn, end) is None
            ):
                yield start, turn, end


def _without_repeats(points: tuple[Point, ...]) -> tuple[Point, ...]:
    return (points[0], *(b for a, b in pairwise(points) if a != b))


_SPOTS = 120
"""How many landing places are tried, the nearest first."""
_LEVELS_ASIDE = (0, -1, 1, -2, 2)
"""At which heights a drone flies there, in multiples of what keeps drones apart."""
_EXACT = 1e-9


class Ground:
    """The drones on the ground and their docks, where no other may land."""

    def __init__(
        self,
        drones: Mapping[str, FleetDrone],
        telemetry: Mapping[str, Telemetry],
        airspace: Airspace,
        step: float,
        place: Callable[[str], Point],
    ) -> None:
        """`place` returns where a drone in the air is, by what it was told."""
        self._drones = drones
        self._telemetry = telemetry
        self._place = place
        self._airspace, self._step = airspace, step

    def below(self, drone: str, here: Point) -> Point | None:
        """Return the point below, if the drone may land there.

        In its own dock it may, however near others are, unless another is in that very dock.
        """
        place, home = (here[0], here[1], 0.0), self._drones[drone].home
        if docked(place, home):
            return None if self._is_taken(drone) else place
        if self._airspace.problem(place) is not None:
            return None
        return place if is_free(place, self._taken(drone), self._step - _EXACT) else None

    def _is_taken(self, drone: str) -> bool:
        """Return whether another drone is in this drone's dock."""
        home = self._drones[drone].home
        return any(
            telemetry.landed and other != drone and docked(telemetry.location, home)
            for other, telemetry in self._telemetry.items()
        )

    def _taken(self, drone: str) -> list[Point]:
        """Return the places of other drones and of their docks."""
        docks = [other.home for other in self._drones.values() if other.id != drone]
        standing = (
            telemetry.location
            for other, telemetry in self._telemetry.items()
            if other != drone and telemetry.landed
        )
        return [*docks, *standing]

    def may_land(self, section: Section) -> bool:
        """Return whether a section's end is still free, or no place is: another may have landed there meanwhile."""
        drone = section.drone
        return (
            self.below(drone, section.points[-1]) is not None
            or next(self.ways_down(drone), None) is None
        )

    def way_down(self, drone: str) -> Section:
        """Return the best way to the ground; straight down if none is free."""
        x, y, z = self._place(drone)
        straight = Section(drone, ((x, y, z), (x, y, 0.0)), False, True, aside=True)
        return next(self.ways_down(drone), straight)

    def ways_down(self, drone: str) -> Iterator[Section]:
        """Yield ways to where a drone that hovers can land: straight below first, its dock last, if it may."""
        here = self._place(drone)
        airspace = self._airspace
        step = self._step
        below, (x, y, z) = self.below(drone, here), here
        if below is not None:
            yield Section(drone, (here, below), False, True, aside=True)
        back = () if airspace.problem(here) is None else (way_back(airspace, here),)
        if back:
            ((x, y, z),) = back
        dock = self.below(drone, self._drones[drone].home)
        spots = islice(free_spots(airspace, (x, y, z), self._taken(drone), step), _SPOTS)
        for spot in chain(spots, () if dock is None else (dock,)):
            if spot[:2] == here[:2]:
                continue
            if z > LOWEST and leg_problem(airspace, (x, y, z), spot) is None:
                slope = (spot[0], spot[1], LOWEST)
                yield Section(drone, (here, *back, slope, spot), False, True, aside=True)
            for level in _LEVELS_ASIDE:
                height = z + level * step
                if level and not LOWEST / 2 <= height <= airspace.ceiling:
                    continue
                route = airspace.route((x, y, height), (spot[0], spot[1], height))
                if route is not None:
                    up = ((x, y, height),) if level else ()
                    points = (here, *back, *up, *route, spot)
                    yield Section(drone, points, False, True, aside=True)
