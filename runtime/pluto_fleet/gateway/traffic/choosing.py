"""Which way a drone takes among the others that have chosen theirs, to be down soon.

A drone is given a stretch as a whole, from where it rests to where it rests next: everything of it must
be free when it departs, and stay so until it has left it. Short stretches are free sooner than long ones.
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
"""For pieces of a course: from when until when others have them."""


class Stretch(NamedTuple):
    """A part of a course that is flown in one go."""

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
"""When a drone is at the end of its course, and how it gets there."""


def at_once(course: Course, taken: Taken, until: float) -> Found | None:
    """Return when a drone can be at the end without a rest; None: it cannot.

    `until`: when it must have left the place where it is.
    """
    end = len(course.pieces) - 1
    begins = _departure(course, 0, end, taken, 0.0, until)
    if begins is None:
        return None
    return begins + course.seconds, (Stretch(0, end, begins),)


def soonest(course: Course, taken: Taken, until: float, before: float) -> Found | None:
    """Return when a drone can be at the end, resting as often as it must; None: not before that."""
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
    """Keep those rests that are better than all others in something."""
    if any(one.since <= new.since and one.until >= new.until for one in rests):
        return
    rests[:] = [one for one in rests if one.since < new.since or one.until > new.until]
    rests.append(new)


def _departure(
    course: Course, first: int, last: int, taken: Taken, since: float, until: float
) -> float | None:
    """Return when a stretch may begin; None: not before the drone must be gone from where it is.

    Whether the place of the next rest is free for long enough is for others to say.
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
    """Yield from when until when a piece is free."""
    opens = 0.0
    for comes, goes in sorted(taken):
        if comes > opens:
            yield opens, comes
        opens = max(opens, goes)
    yield opens, inf


MARGIN = 0.3
"""Seconds between one's leaving and another's departure: so much later it may be without a wait."""
_MOMENT = 1.5
"""Seconds that it takes at least to be gone from where one is."""


@dataclass(slots=True, eq=False)
class DescendingDrone:
    """A drone that is to come down."""

    drone: str
    courses: Sequence[Course]
    """Which ways there are, the best first; at least one."""


@dataclass(slots=True, eq=False)
class Choice:
    """How a drone comes down."""

    course: Course
    way: tuple[Stretch, ...]
    down: float
    times: list[Times]
    """For each piece, from when it has it for itself, and when it has left it."""


class Chooser:
    """Lets one after the other choose; remembers which pieces of which courses are near to each other."""

    def __init__(self, limit: float) -> None:
        self._limit = limit
        self.rests = False
        """Whether drones may rest on their way."""
        self.hurry = 1.0
        """In which part of the time that they need others are expected to make room."""
        self.effort = 0
        """How much was looked at, roughly: a piece is one."""
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
        """Return with which way a drone is down first; being down by then is good enough.

        Where the others will go is not known yet: they are left a moment to go there.
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
        """Return a drone's ways, with what they cost if none is in the way: the best first."""
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
        """Return when a course can be flown, and how; None: not before that."""
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
                else:  # who has not left yet is there from the beginning
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
        """Return when a drone is gone from where it is, if none is in the way."""
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
        """Return which pieces are too near to each other; where both begin, it cannot be helped."""
        pairs = self._pairs.get((one, other))
        if pairs is None:
            self.effort += len(one.pieces) // 2
            pairs = [pair for pair in near(one, other, self._limit) if pair != (0, 0, 0)]
            self._pairs[one, other] = pairs
        return pairs

    def _near_start(self, course: Course, goer: DescendingDrone) -> list[int]:
        """Return which pieces are too near to where another is now; the start cannot be helped."""
        key = course, goer
        pieces = self._starts.get(key)
        if pieces is None:
            place = goer.courses[0].section.points[0]
            pieces = [piece for piece in near_place(course, place, self._limit) if piece]
            self._starts[key] = pieces
        return pieces


def _times(course: Course, way: Sequence[Stretch]) -> list[Times]:
    """Return from when until when each piece is taken: from the departure on."""
    times = [(0.0, 0.0)] * len(course.pieces)
    for first, last, begins in way:
        left = course.times(first, last)
        for piece in range(first, last + 1):
            comes = begins if piece > first else times[piece][0]
            times[piece] = comes, begins + left[piece - first]
    return times
