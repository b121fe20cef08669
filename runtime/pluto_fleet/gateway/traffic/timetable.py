"""Which drone goes which way, and lets which pass, when many come down at once: all of them soon.

At first they choose as if all flew in one go, the one with the longest way first. If that is late, with
rests on the way, and the last chooses first. Then the last chooses anew, again and again, together with a
few that are in its way, among all others.

Times are only planned with, never relied upon: what comes of it is where each rests, and which waits for
which. Since each waits only for drones that should have been there earlier, none waits for ever.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from .choosing import Choice, Chooser, DescendingDrone, Stretch
from .courses import Course

Plan = dict[DescendingDrone, Choice]

_HURRIES = (1.0, 0.6, 0.3)
"""How much sooner than they need others may be expected to make room. They find a way, or they do not."""
_EFFORT = 40_000
"""How much may be looked at: between one and three tenths of a second."""
_SMALL = 10_000
"""What the ways of ten drones or so take, in one go."""
_RESTING = 0.5
"""Seconds that rests may cost: then it is good enough."""
_WORSE = 1.0
"""By how many seconds a plan may be worse than the one before, at first: it may lead to a better one."""
_ALSO, _WITHOUT = 0.05, 1000.0
"""What counts beside the last: seconds of all who are late, and who finds no way."""


def planned(goers: Sequence[DescendingDrone], chooser: Chooser, good: float) -> Plan:
    """Return how all come down; who is not in it finds no way. All being down by then is good enough."""
    plan: Plan = {}
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], 0.0)
        if choice is not None:
            plan[goer] = choice
        if (choice is None or choice.down > good) and chooser.effort > _SMALL:
            break  # of so many, how late the others are does not matter
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
    """Let them choose, one after the other."""
    plan = dict(among)
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], enough)
        if choice is not None:
            plan[goer] = choice
    return plan


def _whole(best: Plan, goers: Sequence[DescendingDrone], chooser: Chooser, good: float) -> Plan:
    """Let all choose anew, a few times, the last one first."""
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
    """Let a few choose anew, as long as it is late and there is time."""
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
    """Return who chooses anew: the last, and a few others, above all of those in its way."""
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
    """Return who is down last, or finds no way."""
    without = [goer for goer in goers if goer not in plan]
    return without[0] if without else max(plan, key=lambda goer: plan[goer].down)


def _score(plan: Plan, goers: Sequence[DescendingDrone], good: float) -> float:
    """Return when the last is down, or that it is good enough, and a little more for all that is late."""
    late = [max(0.0, choice.down - good) for choice in plan.values()]
    without = len(goers) - len(plan)
    return good + max(late, default=0.0) + _ALSO * sum(late) + _WITHOUT * without


GOOD = 0.5
"""Seconds later than the slowest alone: nothing better is looked for."""


@dataclass(slots=True, eq=False)
class Timetable:
    """What everybody does."""

    courses: dict[str, Course] = field(default_factory=dict)
    stretches: dict[str, tuple[Stretch, ...]] = field(default_factory=dict)
    """From where to where each flies without a rest."""
    after: dict[str, list[tuple[int, str, int]]] = field(default_factory=dict)
    """For each: before which of its pieces it waits, for whom, until which piece is left."""
    awaited: dict[str, set[int]] = field(default_factory=dict)
    """Which of each one's pieces another waits for."""
    without: tuple[DescendingDrone, ...] = ()
    """Those for whom there was no way among the others."""

    def rest_after(self, drone: str, at: int, free: int) -> int:
        """Return where a drone that rests at the end of a piece rests next; there, if it must wait.

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
    """Plan for all, so that no two come nearer than that; the first chooses first, if that does."""
    good = max((goer.courses[0].seconds for goer in goers), default=0.0) + GOOD
    chooser = Chooser(limit)
    return _written_down(goers, planned(goers, chooser, good), chooser)


def _written_down(
    goers: Sequence[DescendingDrone], plan: dict[DescendingDrone, Choice], chooser: Chooser
) -> Timetable:
    """Write down who lets whom pass."""
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
