"""Waiting drones, the obstacles on their routes, and when it is worth checking those again."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import dist, inf
from typing import TYPE_CHECKING

from ...shared.domain.motion import CLIMB_SPEED, smoothly
from ...shared.time.future import Future
from .reservations import NEARLY, Reservation, meets, part_way
from .ways import Section

if TYPE_CHECKING:
    from ...shared.domain.model import Category, Point


_HALVINGS = 4
"""Steps of the bisection of how far a drone must fly on a leg before it has left a route."""
_HOVERS = 5.0
"""Seconds after which a hovering obstacle is checked again: it may have come down."""
_EXACT = 1e-6
_ALMOST = 0.9
"""The share of the expected time of a leg that it takes at least: no drone flies exactly as expected."""
_STEPS = 1000
_SMOOTHLY = [smoothly(step / _STEPS) for step in range(_STEPS + 1)]
"""The share of a smooth leg that is flown after each step of its time."""


class Obstacle:
    """A drone on another's route. While its command is unchanged, it is there until it can have left."""

    __slots__ = ("_category", "_is_real", "_points", "_until", "claim")

    def __init__(self, claim: Reservation, category: Category, is_real: bool) -> None:
        self.claim, self._category, self._is_real = claim, category, is_real
        self._points: tuple[Point, ...] = ()
        self._until = -inf

    def seen(self, way: tuple[Point, ...], limit: float, now: float) -> None:
        """Called when it was found on the route."""
        claim = self.claim
        self._points = claim.points
        if claim.moves:
            self._until = now + self._seconds(way, limit, claim.shape(now)) - _EXACT
        elif claim.tail and now < claim.until:  # until it has stopped
            self._until = claim.until
        else:
            self._until = now + _HOVERS

    def is_sure(self, now: float) -> bool:
        """Return whether it must still be there; if not, it has to be checked."""
        return now < self._until and self.claim.points is self._points

    def _seconds(self, way: tuple[Point, ...], limit: float, shape: tuple[Point, ...]) -> float:
        """Return the least seconds until the rest of its route is clear of another route."""
        last = len(shape) - 2
        while last and not meets(way, shape[last : last + 2], limit):
            last -= 1
        if last:  # when it is on its last leg, it is looked at again
            return sum(self._takes(shape, leg, 1.0) for leg in range(last))
        a, b = shape[:2]
        least, most = 0.0, 1.0
        for _ in range(_HALVINGS):
            part = (least + most) / 2
            if meets(way, (part_way(a, b, part), b), limit):
                least = part
            else:
                most = part
        if self._is_real and b[2] <= 0.0 < a[2]:  # others come nearer once it touches down
            least = min(least, max(0.0, 1.0 - NEARLY / a[2]))
        return self._takes(shape, 0, least)

    def _takes(self, shape: tuple[Point, ...], leg: int, part: float) -> float:
        """Return the least seconds in which it flies a part of a leg that lies before it, from where it is."""
        motion, (start, end) = self._category.motion, shape[leg : leg + 2]
        rises = leg == 0 == self.claim.at and self._points[0][2] <= 0.0
        flies = motion.climb if rises else motion.sink if end[2] <= 0.0 else motion.leg
        speed = self._category.speed
        if (
            self._is_real and not motion.smooth
        ):  # real drones may go up and down as fast as they fly
            flies = motion.leg if speed > CLIMB_SPEED else flies
        if leg or not motion.smooth:
            gone, metres = 0.0, dist(start, end)
        else:  # it flies slowly where that leg begins and ends
            left, behind = dist(start, end), dist(self._points[self.claim.at], start)
            metres = left + behind
            gone = behind / metres if metres else 1.0
        seconds = flies(metres, speed) * min(_ALMOST, 1.0 - 3.0 * motion.spread)
        if not motion.smooth:
            return seconds * part
        begins = bisect_left(_SMOOTHLY, gone) / _STEPS
        ends = (bisect_right(_SMOOTHLY, gone + part * (1.0 - gone)) - 1) / _STEPS
        return seconds * max(0.0, ends - begins)


@dataclass(slots=True, eq=False)
class Wait:
    """A drone that waits for a section."""

    section: Section
    since: float
    ways: Sequence[Section]
    over: Future[Section] = field(default_factory=Future)
    obstacles: list[Obstacle | None] = field(init=False)
    """For each alternative, the obstacle at the last check."""
    elders: list[Wait | None] = field(init=False)
    """For each alternative without an obstacle, the elder drone that was to have it first."""

    def __post_init__(self) -> None:
        self.obstacles, self.elders = [None] * len(self.ways), [None] * len(self.ways)

    def was_kept_by(self, drones: Iterable[str]) -> bool:
        """Whether one of these drones was an obstacle."""
        return any(
            obstacle is not None and obstacle.claim.drone in drones for obstacle in self.obstacles
        )
