"""Who goes which way, and lets whom pass, when many come down at once: all of them soon.

Times are only planned with, never relied upon: what comes of it is who waits for whom, and where.
Since everybody waits only for who should have been there earlier, nobody waits for ever.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot, inf
from random import Random

from .courses import Course, near, near_start

MARGIN = 0.3
"""Seconds between one's leaving and another's coming: so much later it may be without a wait."""
_TRIES = 16
"""How often all is planned anew, with whoever is latest going first."""
_MOMENT, _REAL_MOMENT = 1.5, 3.0
"""Seconds that it takes to be gone from where one is: simulated, and for real."""
_GOOD = 1.0
"""Seconds later than the slowest alone: nothing better is looked for."""

_Pairs = list[tuple[int, int]]


@dataclass(slots=True, eq=False)
class Goer:
    """Somebody who is to come down."""

    drone: str
    courses: Sequence[Course]
    """Which ways there are, the best first; at least one."""


@dataclass(slots=True, eq=False)
class Timetable:
    """What everybody does."""

    courses: dict[str, Course] = field(default_factory=dict)
    delays: dict[str, float] = field(default_factory=dict)
    after: dict[str, list[tuple[int, str, int]]] = field(default_factory=dict)
    """For each: before which of its pieces it waits, for whom, until which piece is left."""
    late: float = 0.0
    """When the last is down."""
    without: tuple[Goer, ...] = ()
    """Those for whom there was no way among the others."""


def timetable(goers: Sequence[Goer], limit: float, is_real: bool) -> Timetable:
    """Plan for all, so that no two come nearer than that; the first chooses first, if that does."""
    order = list(goers)
    good = max((goer.courses[0].seconds for goer in goers), default=0.0) + _GOOD
    planner = _Planner(limit, _REAL_MOMENT if is_real else _MOMENT)
    best, chance = Timetable(without=tuple(goers)), Random(0)
    for _ in range(_TRIES):
        plan, worst = planner.planned(order)
        if (len(plan.without), plan.late) < (len(best.without), best.late):
            best = plan
        if worst is None or (plan.late <= good and not plan.without):
            break
        if order[0] is worst:
            chance.shuffle(order)
        order.remove(worst)
        order.insert(0, worst)
    return best


class _Planner:
    """Remembers which pieces of which courses are near to each other."""

    def __init__(self, limit: float, moment: float) -> None:
        self._limit, self._moment = limit, moment
        self._near: dict[tuple[Course, Course], _Pairs] = {}
        self._starts: dict[tuple[Course, Goer], list[int]] = {}

    def planned(self, order: Sequence[Goer]) -> tuple[Timetable, Goer | None]:
        """Plan in this order; return, too, who had better have gone first."""
        plan, worst, latest = Timetable(), None, 0.0
        for place, goer in enumerate(order):
            found = self._first_down(goer, plan, order[place + 1 :])
            if found is None:
                plan.without += (goer,)
                worst, latest = goer, inf
                continue
            _, delay, course = found
            down = delay + course.seconds
            self._goes(plan, goer.drone, course, delay)
            plan.late = max(plan.late, down)
            if down > latest:
                worst, latest = goer, down
        return plan, worst

    def _first_down(
        self, goer: Goer, plan: Timetable, others: Sequence[Goer]
    ) -> tuple[float, float, Course] | None:
        """Return with which way and delay somebody is down first."""
        best: tuple[float, float, Course] | None = None
        for course in goer.courses:
            if best is not None and course.cost >= best[0]:
                break
            delay = self._delay(course, plan, others)
            if delay is not None and (best is None or delay + course.cost < best[0]):
                best = delay + course.cost, delay, course
        return best

    def _delay(self, course: Course, plan: Timetable, others: Sequence[Goer]) -> float | None:
        """Return how long to wait before this way is free all along; None: it is not.

        Others, of whom nobody knows yet where they will go, are left a moment to go there.
        """
        forbidden: list[tuple[float, float]] = []
        most = inf
        for goer in others:
            for mine in self._near_start(course, goer):
                a = course.pieces[mine]
                forbidden.append((-a.leaves - MARGIN, self._moment - a.enters))
        for drone, other in plan.courses.items():
            if self._land_together(course, other):
                return None
            begins = plan.delays[drone]
            for mine, theirs in self._pairs(course, other):
                a, b = course.pieces[mine], other.pieces[theirs]
                comes, goes = begins + b.enters if theirs else 0.0, begins + b.leaves
                if mine:
                    forbidden.append((comes - a.leaves - MARGIN, goes - a.enters + MARGIN))
                else:  # who has not left yet is there from the beginning
                    most = min(most, comes - MARGIN)
        delay = 0.0
        for first, last in sorted(forbidden):
            if first < delay < last:
                delay = last
        return delay if delay == 0.0 or delay <= most else None

    def _land_together(self, one: Course, other: Course) -> bool:
        """Whether two would land too near to each other; in their docks they may."""
        (ax, ay, _), (bx, by, _) = one.section.points[-1], other.section.points[-1]
        is_elsewhere = one.section.aside or other.section.aside
        return is_elsewhere and hypot(ax - bx, ay - by) < self._limit

    def _goes(self, plan: Timetable, drone: str, course: Course, delay: float) -> None:
        """Write down a way, and who lets whom pass on it."""
        after = plan.after[drone] = []
        for other, its in plan.courses.items():
            for mine, theirs in self._pairs(course, its):
                leaves = plan.delays[other] + its.pieces[theirs].leaves
                if theirs == 0 or (mine and leaves <= delay + course.pieces[mine].enters):
                    after.append((mine, other, theirs))
                else:
                    plan.after[other].append((theirs, drone, mine))
        plan.courses[drone], plan.delays[drone] = course, delay

    def _pairs(self, one: Course, other: Course) -> _Pairs:
        """Return which pieces are too near to each other; where both begin, nobody can help it."""
        pairs = self._near.get((one, other))
        if pairs is None:
            pairs = [pair for pair in near(one, other, self._limit) if pair != (0, 0)]
            self._near[one, other] = pairs
        return pairs

    def _near_start(self, course: Course, goer: Goer) -> list[int]:
        """Return which pieces are too near to where somebody is now; the start cannot be helped."""
        key = course, goer
        pieces = self._starts.get(key)
        if pieces is None:
            place = goer.courses[0].section.points[0]
            pieces = self._starts[key] = [
                piece for piece in near_start(course, place, self._limit) if piece
            ]
        return pieces
