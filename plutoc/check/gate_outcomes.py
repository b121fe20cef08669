"""The statuses that pass a gate, given those that each branch can bring."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from plutoc.block import Gate
from plutoc.check.flow import Facts, Place
from plutoc_runtime.domain.status import WORST_FIRST, Status

Came = Mapping[int, Iterable[Place]]
"""The arrivals at one gate, by branch."""
Passing = tuple[Status, Facts]
"""A status that passes a gate, with the mission's facts then."""


def passing(gate: Gate, came: Came) -> dict[Passing, Place]:
    """Return what passes when every branch has arrived, with the arrival that brings it."""
    brought: dict[Passing, Place] = {}
    for arrivals in came.values():
        for arrival in arrivals:
            brought.setdefault((arrival.status, arrival.facts), arrival)
    if gate is Gate.FIRST:
        return brought
    # at best, every branch brings the best that it can: nothing better than that passes
    floor = min(_best(arrivals) for arrivals in came.values())
    return {what: place for what, place in brought.items() if _goodness(what[0]) <= floor}


def with_each(gate: Gate, came: Came) -> Iterator[tuple[Place, Status]]:
    """Yield each arrival with every status that can pass together with it."""
    best = {branch: _best(arrivals) for branch, arrivals in came.items()}
    bringers = Counter(s for arrivals in came.values() for s in {a.status: None for a in arrivals})
    lowest = sorted(best.values())
    for branch, arrivals in came.items():
        mine = {arrival.status for arrival in arrivals}
        floor = lowest[0] if best[branch] != lowest[0] else (*lowest[1:2], len(WORST_FIRST))[0]
        for arrival in arrivals:
            for status in WORST_FIRST:
                if status is arrival.status:
                    passes = gate is Gate.FIRST or _goodness(status) <= floor
                else:
                    others = bringers[status] - (status in mine)
                    worse = _goodness(status) <= min(floor, _goodness(arrival.status))
                    passes = gate is Gate.ALL and others > 0 and worse
                if passes:
                    yield arrival, status


def _best(arrivals: Iterable[Place]) -> int:
    return max(_goodness(arrival.status) for arrival in arrivals)


def _goodness(status: Status) -> int:
    return WORST_FIRST.index(status)
