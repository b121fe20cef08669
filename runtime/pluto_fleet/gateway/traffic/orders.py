"""Who chooses before whom, so that the last is down soon.

At first as if all flew in one go, and who has the longest way chooses first. If that is late, with rests on
the way, and whoever is last chooses first. And then again and again the last chooses anew, together with a
few who are in its way, among all others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random

from .choosing import Choice, Chooser, Goer

Plan = dict[Goer, Choice]

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


def planned(goers: Sequence[Goer], chooser: Chooser, good: float) -> Plan:
    """Return how all come down; who is not in it finds no way. All being down by then is good enough."""
    plan: Plan = {}
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], 0.0)
        if choice is not None:
            plan[goer] = choice
        if (choice is None or choice.down > good) and chooser.effort > _SMALL:
            break  # of so many, nobody needs to know how late the others are
    if _score(plan, goers, good) <= good:
        return plan
    chooser.rests = True
    good += _RESTING
    plan = _whole(plan, goers, chooser, good)
    return _mended(plan, goers, chooser, good)


def _chosen(
    goers: Sequence[Goer], among: Mapping[Goer, Choice], chooser: Chooser, enough: float
) -> Plan:
    """Let them choose, one after the other."""
    plan = dict(among)
    for place, goer in enumerate(goers):
        choice = chooser.choice(goer, plan, goers[place + 1 :], enough)
        if choice is not None:
            plan[goer] = choice
    return plan


def _whole(best: Plan, goers: Sequence[Goer], chooser: Chooser, good: float) -> Plan:
    """Let all choose anew, a few times, whoever was last first."""
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


def _mended(best: Plan, goers: Sequence[Goer], chooser: Chooser, good: float) -> Plan:
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


def _few(plan: Plan, goers: Sequence[Goer], chooser: Chooser, chance: Random) -> list[Goer]:
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


def _last(plan: Plan, goers: Sequence[Goer]) -> Goer:
    """Return who is down last, or finds no way."""
    without = [goer for goer in goers if goer not in plan]
    return without[0] if without else max(plan, key=lambda goer: plan[goer].down)


def _score(plan: Plan, goers: Sequence[Goer], good: float) -> float:
    """Return when the last is down, or that it is good enough, and a little more for all that is late."""
    late = [max(0.0, choice.down - good) for choice in plan.values()]
    without = len(goers) - len(plan)
    return good + max(late, default=0.0) + _ALSO * sum(late) + _WITHOUT * without
