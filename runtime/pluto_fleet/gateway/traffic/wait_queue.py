"""Waiting drones, the obstacles on their routes, and when it is worth checking those again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import dist, inf
from typing import TYPE_CHECKING

from ...shared.domain.motion import CLIMB_SPEED
from ...shared.time.future import Future
from .reservations import Reservation, meets, part_way
from .ways import Section

if TYPE_CHECKING:
    from ...shared.domain.model import Category, Point


_HALVINGS = 4
"""Steps of the bisection of how far a drone must fly on a leg before it has left a route."""
_HOVERS = 5.0
"""Seconds after which a hovering obstacle is checked again: it may have come down."""
_EXACT = 1e-6


class Obstacle:
    """A drone on another's route. While its command is unchanged, it is there until it can have left."""

    __slots__ = ("_cruise", "_points", "_until", "_upright", "claim")

    def __init__(self, claim: Reservation, category: Category, is_real: bool) -> None:
        self.claim = claim
        self._cruise = category.speed
        self._upright = max(self._cruise, CLIMB_SPEED) if is_real else CLIMB_SPEED
        """Its maximum vertical speed; for simulated drones the exact one."""
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
        legs = [(a, b, self._cruise) for a, b in pairwise(shape)]
        if self.claim.at == 0 and self._points[0][2] <= 0.0:
            legs[0] = (*legs[0][:2], self._upright)
        if shape[-1][2] <= 0.0:
            legs[-1] = (*legs[-1][:2], self._upright)
        while len(legs) > 1 and not meets(way, legs[-1][:2], limit):
            legs.pop()
        a, b, speed = legs[-1]
        least, most = 0.0, 1.0
        for _ in range(_HALVINGS):
            part = (least + most) / 2
            if meets(way, (part_way(a, b, part), b), limit):
                least = part
            else:
                most = part
        legs[-1] = a, part_way(a, b, least), speed
        return sum(dist(a, b) / speed for a, b, speed in legs)


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
