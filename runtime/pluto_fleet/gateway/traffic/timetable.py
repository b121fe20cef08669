"""Planning the courses and the precedence of many drones that come down at once, to be down soon.

At first they choose as if all flew in one go, the one with the longest way first. If that is late, with
rests on the way, and the last chooses first. Then the last chooses anew, again and again, together with a
few that are in its way, among all others.

Times are used to plan, but never relied upon: the result is where each rests, and which waits for which.
As each waits only for drones that are planned to pass earlier, there is no deadlock.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from .choosing import Choice, Chooser, DescendingDrone, Stretch
from .courses import Course

Plan = dict[DescendingDrone, Choice]

_HURRIES = (1.0, 0.6, 0.3)
"""The values of `Chooser.hurry` to try: how soon others are expected to make room."""
_EFFORT = 40_000
"""The bound of the work: between one and three tenths of a second."""
_SMALL = 10_000
"""The work for about ten drones, without rests."""
_RESTING = 0.5
"""Seconds that rests may cost: then it is good enough."""
_WORSE = 1.0
"""Seconds by which a plan may initially be worse than the one before, as it may lead to a better one."""
_ALSO, _WITHOUT = 0.05, 1000.0
"""Weights beside the last arrival: of all delays, and of drones without a course."""


def planned(goers: Sequence[DescendingDrone], chooser: Chooser, good: float) -> Plan:
    """Return the choices of all drones that find a course. All being down by a given time is good enough."""
    plan: Plan = {}
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], 0.0)
        if choice is not None:
            plan[goer] = choice
        if (choice is None or choice.down > good) and chooser.effort > _SMALL:
            break  # for so many, the delays of the others do not matter
    if _score(plan, goers, good) <= good:
        return plan
    chooser.rests = True
    good += _RESTING
    plan = _whole(plan, goers, chooser, good)
    return _mended(plan, goers, chooser, good)


def _chosen(
    goers: Sequence[DescendingDrone],
    among: Mapping[DescendingDrone, Choice],
    chooser: Chooser,
    enough: float,
) -> Plan:
    """Choose for one drone after the other."""
    plan = dict(among)
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], enough)
        if choice is not None:
            plan[goer] = choice
    return plan


def _whole(best: Plan, goers: Sequence[DescendingDrone], chooser: Chooser, good: float) -> Plan:
    """Choose anew for all, a few times, the last one first."""
    order, least = list(goers), _score(best, goers, good)
    for chooser.hurry in _HURRIES * 2:
        plan = _chosen(order, {}, chooser, 0.0)
        score = _score(plan, goers, good)
        if score < least:
            best, least = plan, score
        if least <= good or chooser.effort >= _EFFORT:
            break
        last = _last(plan, goers)
        order.remove(last)
        order.insert(0, last)
    return best


def _mended(best: Plan, goers: Sequence[DescendingDrone], chooser: Chooser, good: float) -> Plan:
    """Choose anew for a few, as long as the plan is late and there is time."""
    chance, now = Random(0), best
    least = score = _score(best, goers, good)
    begun = chooser.effort
    while least > good and chooser.effort < _EFFORT:
        few = _few(now, goers, chooser, chance)
        chooser.hurry = chance.choice(_HURRIES)
        others = {goer: choice for goer, choice in now.items() if goer not in few}
        plan = _chosen(few, others, chooser, chance.choice((0.0, good)))
        new = _score(plan, goers, good)
        passed = (chooser.effort - begun) / max(1, _EFFORT - begun)
        if new <= score + _WORSE * (1 - passed):
            now, score = plan, new
        if new < least:
            best, least = plan, new
    return best


def _few(
    plan: Plan, goers: Sequence[DescendingDrone], chooser: Chooser, chance: Random
) -> list[DescendingDrone]:
    """Return the drones to choose anew for: the last, and a few others, mainly those in its way."""
    last = _last(plan, goers)
    rest = [goer for goer in plan if goer is not last]
    in_the_way = [goer for goer in rest if chooser.pairs(last.courses[0], plan[goer].course)]
    chance.shuffle(in_the_way)
    chance.shuffle(rest)
    few = (in_the_way or rest)[: chance.choice((1, 2, 3, 4))]
    if chance.random() < 0.3:
        few += [goer for goer in rest if goer not in few][:2]
    chance.shuffle(few)
    without = [goer for goer in goers if goer not in plan and goer is not last]
    return [last, *without, *few]


def _last(plan: Plan, goers: Sequence[DescendingDrone]) -> DescendingDrone:
    """Return the drone that is down last, or finds no course."""
    without = [goer for goer in goers if goer not in plan]
    return without[0] if without else max(plan, key=lambda goer: plan[goer].down)


def _score(plan: Plan, goers: Sequence[DescendingDrone], good: float) -> float:
    """Return when the last is down, at least the good-enough time, plus a weight for all delays."""
    late = [max(0.0, choice.down - good) for choice in plan.values()]
    without = len(goers) - len(plan)
    return good + max(late, default=0.0) + _ALSO * sum(late) + _WITHOUT * without


GOOD = 0.5
"""Seconds later than the slowest alone that are good enough."""


@dataclass(slots=True, eq=False)
class Timetable:
    """The plan of all drones."""

    courses: dict[str, Course] = field(default_factory=dict)
    stretches: dict[str, tuple[Stretch, ...]] = field(default_factory=dict)
    """The stretches of each drone."""
    after: dict[str, list[tuple[int, str, int]]] = field(default_factory=dict)
    """For each drone: before which of its pieces it waits, for which drone, until which piece is left."""
    awaited: dict[str, set[int]] = field(default_factory=dict)
    """For each drone, its pieces that another waits for."""
    without: tuple[DescendingDrone, ...] = ()
    """The drones without a course."""

    def rest_after(self, drone: str, at: int, free: int) -> int:
        """Return the next resting place of a drone; the present one, if it must wait.

        `free`: up to which piece none has to pass before it. It leaves out a rest where that saves
        time, and none waits for what is behind it then: a long leg leaves its beginning slowly.
        """
        course, to, lasts = self.courses[drone], at, 0.0
        for stretch in self.stretches[drone]:
            if stretch.last <= at:
                continue
            lasts += course.times(stretch.first, stretch.last)[-1]
            if stretch.last > free or course.times(at, stretch.last)[-1] > lasts:
                break
            to = stretch.last
            if any(at <= piece < to for piece in self.awaited[drone]):
                break
        return to


def timetable(goers: Sequence[DescendingDrone], limit: float) -> Timetable:
    """Plan for all, so that no two come nearer than a distance; in this order, if that is good enough."""
    good = max((goer.courses[0].seconds for goer in goers), default=0.0) + GOOD
    chooser = Chooser(limit)
    return _written_down(goers, planned(goers, chooser, good), chooser)


def _written_down(
    goers: Sequence[DescendingDrone], plan: dict[DescendingDrone, Choice], chooser: Chooser
) -> Timetable:
    """Record the precedence."""
    table = Timetable(without=tuple(goer for goer in goers if goer not in plan))
    done: list[tuple[str, Choice]] = []
    for goer, choice in plan.items():
        drone, course = goer.drone, choice.course
        table.courses[drone], table.stretches[drone] = course, choice.way
        table.after[drone], table.awaited[drone] = [], set()
        for other, its in done:
            for mine, first, last in chooser.pairs(course, its.course):
                if mine and its.times[last][1] <= choice.times[mine][0]:
                    table.after[drone].append((mine, other, last))
                    table.awaited[other].add(last)
                else:
                    table.after[other].append((first, drone, mine))
                    table.awaited[drone].add(mine)
        done.append((drone, choice))
    return table
