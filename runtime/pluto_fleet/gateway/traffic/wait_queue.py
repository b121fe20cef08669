"""Waiting drones, what keeps each, and when it is worth looking at it again."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from math import dist, inf
from typing import TYPE_CHECKING, NamedTuple

from ...shared.domain.motion import CLIMB_SPEED, smoothly
from ...shared.time.kernel import Future
from .legs import leaves
from .reservations import NEARLY, Reservation, are_near, legs_of, meets
from .ways import Section

if TYPE_CHECKING:
    from ...shared.domain.model import Category, Point


HOVERS = 5.0
"""Seconds after which it is checked again what hovering drones are in the way: they may have drifted, or come down."""
_EXACT = 1e-6
_ALMOST = 0.9
"""The share of the expected time of a leg that it takes at least: no drone flies exactly as expected."""
_STEPS = 1000
_SMOOTHLY = [smoothly(step / _STEPS) for step in range(_STEPS + 1)]
"""The share of a smooth leg that is flown after each step of its time."""


class Obstacle:
    """A drone on another's route. While its command is unchanged, it is there until it can have left."""

    __slots__ = ("_category", "_clear", "_is_real", "_last", "_points", "_until", "claim")

    def __init__(self, claim: Reservation, category: Category, is_real: bool) -> None:
        self.claim, self._category, self._is_real = claim, category, is_real
        self._points: tuple[Point, ...] = ()
        self._last = 0
        """The last leg of its own route that comes too near."""
        self._clear = 0.0
        """How many metres at the end of that leg do not; 0: not known yet."""
        self._until = -inf

    def seen(self, way: tuple[Point, ...], limit: float, now: float) -> None:
        """Called when it was found on the route."""
        claim = self.claim
        if not claim.moves:
            stops = claim.tail and now < claim.until  # it has not stopped yet
            self._points, self._last = claim.points, 0
            self._until = claim.until if stops else now + HOVERS
            return
        if claim.shoots and now < claim.until:  # then it is on its route alone
            self._points = ()
            self._last = 0
            self._until = claim.until
            return
        shape = claim.shape(now)
        if claim.points is not self._points or claim.at > self._last:
            self._points, self._clear = claim.points, 0.0
            self._last = claim.at + _last_leg(way, shape, limit)
        self._until = now
        if claim.at == self._last and len(shape) > 1:
            self._until += self._seconds(way, limit, shape[0], shape[1]) - _EXACT

    @property
    def due(self) -> float:
        """When it has to be checked, unless it reports something before."""
        return inf if self.claim.at < self._last else self._until

    def is_sure(self, now: float) -> bool:
        """Return whether it must still be there; if not, it has to be checked."""
        return now < self.due and self.claim.points is self._points

    def _seconds(self, way: tuple[Point, ...], limit: float, here: Point, end: Point) -> float:
        """Return the least seconds until the rest of its leg is clear of another route."""
        metres = dist(here, end)
        if not metres:
            return 0.0
        if not self._clear:
            part = max(leaves(here, end, c, d, limit) for c, d in legs_of(way))
            self._clear = (1.0 - part) * metres
            if self._is_real and end[2] <= 0.0 < here[2]:  # others come nearer once it touches down
                self._clear = max(self._clear, min(metres, NEARLY * metres / here[2]))
        return self._takes(here, end, max(0.0, 1.0 - self._clear / metres))

    def _takes(self, here: Point, end: Point, part: float) -> float:
        """Return the least seconds in which it flies a part of what lies before it of a leg."""
        motion = self._category.motion
        rises = self.claim.at == 0 and self._points[0][2] <= 0.0
        flies = motion.climb if rises else motion.sink if end[2] <= 0.0 else motion.leg
        speed = self._category.speed
        if (
            self._is_real and not motion.smooth
        ):  # real drones may go up and down as fast as they fly
            flies = motion.at_speed if speed > CLIMB_SPEED else flies
        left = dist(here, end)
        # it flies slowly where a smooth leg begins and ends
        behind = dist(self._points[self.claim.at], here) if motion.smooth else 0.0
        metres = left + behind
        seconds = flies(metres, speed) * min(_ALMOST, 1.0 - 3.0 * motion.spread)
        if not motion.smooth:
            return seconds * part
        gone = behind / metres if metres else 1.0
        begins = bisect_left(_SMOOTHLY, gone) / _STEPS
        ends = (bisect_right(_SMOOTHLY, gone + part * (1.0 - gone)) - 1) / _STEPS
        return seconds * max(0.0, ends - begins)


def _last_leg(way: tuple[Point, ...], shape: tuple[Point, ...], limit: float) -> int:
    """Return the last leg of a shape that comes too near to a route that the shape meets."""
    last = len(shape) - 2
    while last > 0 and not meets(way, shape[last : last + 2], limit):
        last -= 1
    return max(0, last)


class Elder(NamedTuple):
    """A drone that has waited longer, and is to have what another asks for first."""

    wait: Wait
    always: bool
    """For as long as it waits; else only while it is its turn."""


@dataclass(slots=True, eq=False)
class Wait:
    """A drone that waits for a section."""

    section: Section
    since: float
    ways: Sequence[Section]
    beside: bool = False
    """It may end beside its target, if another drone has taken that."""
    over: Future[Section | None] = field(default_factory=Future)
    """Set with what it gets; None: it wants another section by now."""
    due: float = -inf
    """When it has to be looked at again, unless what keeps it changes before."""
    keepers: Collection[str] = ()
    """The drones that were obstacles at the last look."""
    obstacles: list[Obstacle | None] = field(init=False)
    """For each alternative, the obstacle at the last check."""
    elders: list[Elder | None] = field(init=False)
    """For each alternative without an obstacle, the elder drone that was to have it first."""
    clear: list[dict[str, tuple[Point, ...]]] = field(init=False)
    """For each alternative, the routes of others that do not meet it, by their drones: they only get shorter."""

    def __post_init__(self) -> None:
        self.obstacles, self.elders = [None] * len(self.ways), [None] * len(self.ways)
        self.clear = [{} for _ in self.ways]

    def looked(self, due: float) -> None:
        """Called when it was looked at in vain."""
        self.due = due
        self.keepers = {one.claim.drone for one in self.obstacles if one is not None}


class WaitQueue:
    """All drones that wait. One is due again when what it waits for has changed, or may have."""

    def __init__(self, limit: float) -> None:
        self._waits: dict[str, Wait] = {}
        self._limit = limit

    def __len__(self) -> int:
        return len(self._waits)

    def __iter__(self) -> Iterator[Wait]:
        return iter(self._waits.values())

    def __contains__(self, wait: Wait) -> bool:
        return self._waits.get(wait.section.drone) is wait

    def of(self, drone: str) -> Wait | None:
        """Return what a drone waits for, if anything."""
        return self._waits.get(drone)

    def in_turn(self) -> list[Wait]:
        """Return all, those that have waited longest first."""
        return sorted(self, key=lambda wait: wait.since)

    def add(self, wait: Wait) -> None:
        """Add a drone that begins to wait."""
        self._waits[wait.section.drone] = wait

    def remove(self, wait: Wait) -> None:
        """Remove one that waits no more; those that were to let it pass are due."""
        del self._waits[wait.section.drone]
        for other in self:
            if any(elder is not None and elder.wait is wait for elder in other.elders):
                other.due = -inf

    def changed(self, claim: Reservation) -> None:
        """Called when a drone has reserved something else, or less: those that it keeps, or may keep, are due."""
        for wait in self:
            if claim.drone in wait.keepers or (
                wait.obstacles[0] is None and are_near(wait.section.box, claim.box, self._limit)
            ):
                wait.due = -inf
