"""Choosing a drone's course to come down soon, among the courses that others have chosen.

A drone gets a stretch as a whole, from one resting place to the next: all of it must be free when it
departs, and stay so until it has left it. Short stretches are free sooner than long ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, inf
from typing import NamedTuple

from .courses import Course, Near, near, near_place

Times = tuple[float, float]
Taken = Mapping[int, Sequence[Times]]
"""For pieces of a course: the intervals in which others occupy them."""


class Stretch(NamedTuple):
    """A part of a course that is flown without a stop."""

    first: int
    """The piece at whose end the drone rests before."""
    last: int
    """The piece at whose end it rests then."""
    begins: float


class _Rest(NamedTuple):
    """A drone rests at the end of a piece."""

    since: float
    until: float
    """When another must have that piece."""
    way: tuple[Stretch, ...]


Found = tuple[float, tuple[Stretch, ...]]
"""When a drone reaches the end of its course, and by which stretches."""


def at_once(course: Course, taken: Taken, until: float) -> Found | None:
    """Return when a drone can reach the end without a rest; None: it cannot.

    `until`: when it must have left the place where it is.
    """
    end = len(course.pieces) - 1
    begins = _departure(course, 0, end, taken, 0.0, until)
    if begins is None:
        return None
    return begins + course.seconds, (Stretch(0, end, begins),)


def soonest(course: Course, taken: Taken, until: float, before: float) -> Found | None:
    """Return when a drone can reach the end, with rests where needed; None: not in time."""
    places, least, end = course.rests, course.least, course.rests[-1]
    best: Found | None = None
    rests: dict[int, list[_Rest]] = {0: [_Rest(0.0, until, ())]}
    for number, first in enumerate(places[:-1]):
        for rest in rests.get(first, ()):
            if rest.since + least[first] >= before:
                continue
            for last in places[number + 1 : number + 3]:
                lasts = course.times(first, last)[-1]
                for opens, closes in _gaps(taken.get(last, ())) if last < end else _ANY:
                    since = max(rest.since, opens)
                    begins = _departure(course, first, last, taken, since, rest.until)
                    if begins is None or begins + lasts + least[last] >= before:
                        break
                    then = begins + lasts
                    way = (*rest.way, Stretch(first, last, begins))
                    if last == end:
                        before, best = then, (then, way)
                    elif then < closes:
                        _add(rests.setdefault(last, []), _Rest(then, closes, way))
    return best


_ANY: tuple[Times, ...] = ((0.0, inf),)


def _add(rests: list[_Rest], new: _Rest) -> None:
    """Add a rest, unless another is better in every respect (Pareto front)."""
    if any(one.since <= new.since and one.until >= new.until for one in rests):
        return
    rests[:] = [one for one in rests if one.since < new.since or one.until > new.until]
    rests.append(new)


def _departure(
    course: Course, first: int, last: int, taken: Taken, since: float, until: float
) -> float | None:
    """Return when a stretch may begin; None: not before the drone must have left its place.

    Whether the next resting place is free for long enough is not checked here.
    """
    times = course.times(first, last)
    forbidden: list[Times] = []
    for piece in range(first + 1, last + (last == len(course.pieces) - 1)):
        for comes, goes in taken.get(piece, ()):
            if goes > since:
                forbidden.append((comes - times[piece - first], goes))
    begins = since
    forbidden.sort()
    for comes, goes in forbidden:
        if comes >= begins:
            break
        begins = max(begins, goes)
    return begins if begins + times[0] <= until else None


def _gaps(taken: Sequence[Times]) -> Iterator[Times]:
    """Yield the intervals in which a piece is free."""
    opens = 0.0
    for comes, goes in sorted(taken):
        if comes > opens:
            yield opens, comes
        opens = max(opens, goes)
    yield opens, inf


MARGIN = 0.3
"""Seconds between one drone's leaving and another's departure: the tolerated delay."""
_MOMENT = 1.5
"""The least seconds that a drone takes to leave its place."""


@dataclass(slots=True, eq=False)
class DescendingDrone:
    """A drone that is to come down."""

    drone: str
    courses: Sequence[Course]
    """Its possible courses, the best first; at least one."""


@dataclass(slots=True, eq=False)
class Choice:
    """How a drone comes down."""

    course: Course
    way: tuple[Stretch, ...]
    down: float
    times: list[Times]
    """For each piece, the interval in which the drone occupies it."""


class Chooser:
    """Chooses for one drone after the other; caches which pieces of which courses are near each other."""

    def __init__(self, limit: float) -> None:
        self._limit = limit
        self.rests = False
        """Whether drones may rest on their way."""
        self.hurry = 1.0
        """The share of their time in which others are expected to make room."""
        self.effort = 0
        """A rough measure of the work done: one for each piece."""
        self._pairs: dict[tuple[Course, Course], list[Near]] = {}
        self._starts: dict[tuple[Course, DescendingDrone], list[int]] = {}
        self._gone: dict[tuple[DescendingDrone, bool], float] = {}
        self._ways: dict[tuple[DescendingDrone, bool], list[tuple[float, Course]]] = {}

    def choice(
        self,
        goer: DescendingDrone,
        plan: Mapping[DescendingDrone, Choice],
        others: Sequence[DescendingDrone],
        enough: float,
    ) -> Choice | None:
        """Return the course by which a drone is down first; being down by a given time is good enough.

        As the others' courses are not known yet, they are given a moment to leave.
        """
        best: tuple[Course, Found] | None = None
        cost = inf
        for least, course in self._sorted(goer):
            if least >= cost:
                break
            extra = course.cost - course.seconds
            found = self._found(course, plan, others, cost - extra)
            if found is not None and found[0] + extra < cost:
                best, cost = (course, found), found[0] + extra
                if found[0] <= enough:
                    break
        if best is None:
            return None
        course, (down, way) = best
        return Choice(course, way, down, _times(course, way))

    def _sorted(self, goer: DescendingDrone) -> list[tuple[float, Course]]:
        """Return a drone's courses with their costs without others, the best first."""
        key = goer, self.rests
        if key not in self._ways:
            costs = [
                one.cost - one.seconds + one.least[0] if self.rests else one.cost
                for one in goer.courses
            ]
            order = sorted(range(len(costs)), key=costs.__getitem__)
            self._ways[key] = [(costs[number], goer.courses[number]) for number in order]
        return self._ways[key]

    def _found(
        self,
        course: Course,
        plan: Mapping[DescendingDrone, Choice],
        others: Sequence[DescendingDrone],
        before: float,
    ) -> Found | None:
        """Return when and how a course can be flown; None: not in time."""
        self.effort += len(course.pieces)
        taken: dict[int, list[Times]] = {}
        until = inf
        for goer in others:
            for mine in self._near_start(course, goer):
                taken.setdefault(mine, []).append((0.0, self.hurry * self._leaves(goer)))
        for one in plan.values():
            if self._land_together(course, one.course):
                return None
            for mine, first, last in self.pairs(course, one.course):
                comes, goes = one.times[first][0], one.times[last][1]
                if mine:
                    taken.setdefault(mine, []).append((comes - MARGIN, goes + MARGIN))
                else:  # one that has not left yet is there from the beginning
                    until = min(until, comes - MARGIN)
        if self.rests:
            return soonest(course, taken, until, before)
        return at_once(course, taken, until)

    def _land_together(self, one: Course, other: Course) -> bool:
        """Whether two would land too near to each other; in their docks they may."""
        (ax, ay, _), (bx, by, _) = one.section.points[-1], other.section.points[-1]
        is_elsewhere = one.section.aside or other.section.aside
        return is_elsewhere and hypot(ax - bx, ay - by) < self._limit

    def _leaves(self, goer: DescendingDrone) -> float:
        """Return when a drone has left its place, if none is in the way."""
        found = self._gone.get((goer, self.rests))
        if found is None:
            course, now = goer.courses[0], 0.0
            end = len(course.pieces) - 1
            gone = max(near_place(course, course.pieces[0].start, self._limit))
            for first, last in pairwise(course.rests if self.rests else (0, end)):
                times = course.times(first, last)
                if gone < last:
                    now += times[gone - first]
                    break
                now += times[-1]
            found = self._gone[goer, self.rests] = max(_MOMENT, now)
        return found

    def pairs(self, one: Course, other: Course) -> list[Near]:
        """Return the pieces that are too near to each other, except where both begin."""
        pairs = self._pairs.get((one, other))
        if pairs is None:
            self.effort += len(one.pieces) // 2
            pairs = [pair for pair in near(one, other, self._limit) if pair != (0, 0, 0)]
            self._pairs[one, other] = pairs
        return pairs

    def _near_start(self, course: Course, goer: DescendingDrone) -> list[int]:
        """Return the pieces that are too near to another's present place, except the start."""
        key = course, goer
        pieces = self._starts.get(key)
        if pieces is None:
            place = goer.courses[0].section.points[0]
            pieces = [piece for piece in near_place(course, place, self._limit) if piece]
            self._starts[key] = pieces
        return pieces


def _times(course: Course, way: Sequence[Stretch]) -> list[Times]:
    """Return the interval in which each piece is occupied, from the departure on."""
    times = [(0.0, 0.0)] * len(course.pieces)
    for first, last, begins in way:
        left = course.times(first, last)
        for piece in range(first, last + 1):
            comes = begins if piece > first else times[piece][0]
            times[piece] = comes, begins + left[piece - first]
    return times
