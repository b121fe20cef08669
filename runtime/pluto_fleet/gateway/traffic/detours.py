"""The same way at other heights: over the others evenly, or rise, cross, sink."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import dist
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point

FURTHEST, SHARE = 1.5, 0.05
"""How many metres higher or lower a drone flies to let another pass; on long ways, which share."""
LOWEST = 0.5
"""Below this height a drone only takes off and lands."""


@dataclass(frozen=True, slots=True)
class Section:
    """A drone's way from where it rests to where it rests next, on the ground or hovering."""

    drone: str
    points: tuple[Point, ...]
    """The first is where it is now."""
    stands: bool
    """It begins on the ground: the second point is right above the first."""
    lands: bool
    """It ends on the ground: the last point is right below the one before."""
    tail: tuple[Point, ...] = ()
    """Where it goes at once after that, if nobody tells it otherwise: to its dock."""
    aside: bool = False
    """It only goes out of the way of others."""

    def bent(self, offset: float) -> Section:
        """Return the same way, so much higher in the middle of its one leg, which costs next to nothing."""
        index = 2 if self.stands else 1
        (ax, ay, az), (bx, by, bz) = self.points[index - 1 : index + 1]
        middle = (ax + bx) / 2, (ay + by) / 2, (az + bz) / 2 + offset
        points = (*self.points[:index], middle, *self.points[index:])
        return Section(self.drone, points, self.stands, self.lands, self.tail, self.aside)

    def at_height(self, offset: float) -> Section:
        """Return the same way, so much higher; where it rests stays where it is."""
        points = self.points
        way = points[1 if self.stands else 0 : -1 if self.lands else None]
        shifted = tuple((x, y, z + offset) for x, y, z in way)
        ends = points[-1:]
        return Section(
            self.drone, (points[0], *shifted, *ends), self.stands, self.lands, self.tail, self.aside
        )


def sections(section: Section, step: float, airspace: Airspace) -> Iterator[Section]:
    """Yield a section, and then the same at other heights: the smallest detour first.

    None is lower than where drones fly anyway: nobody knows what stands there.
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
