"""`earliest_deadline`: the trip of the mission with the earliest deadline goes first, to the nearest drone.

Pure earliest-deadline-first fails badly where not all can be in time: it spends drones on what is too late already, and so
makes the next one late (Jackson 1955; Buttazzo et al. 1995). So a mission that can be in time no more goes
after those that can, and one without a deadline after all.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import dist, inf, isfinite
from typing import TYPE_CHECKING

from .batch import Batch
from .durations import pace, upright
from .needs import Request
from .policies import lowest

if TYPE_CHECKING:
    from ..domain.model import Drone
    from .policies import Choice
    from .queue import Queue


@Batch
def earliest_deadline(
    requests: Sequence[Request], free: Sequence[Drone], queue: Queue
) -> Sequence[Choice | None]:
    """Give drones to missions in the order of their deadlines, each the nearest."""
    now, left, chosen = queue.kernel.now, list(free), dict[Request, "Choice"]()
    by_deadline = sorted((*_urgency(one, queue.drones, now), n) for n, one in enumerate(requests))
    for _, deadline, place in by_deadline:
        one = requests[place]
        found = lowest(left, one.able, partial(_away, one))
        if found is not None:
            drone, metres = found
            left.remove(drone)
            due = "no deadline" if deadline == inf else f"due in {deadline - now:.0f} s"
            why = f"{due}; nearest of {len(left) + 1} free: {metres:.1f} m away"
            chosen[one] = drone, why
    return [chosen.get(one) for one in requests]


def _away(one: Request, drone: Drone) -> float:
    return drone.distance(one.goal)


def _urgency(one: Request, drones: Sequence[Drone], now: float) -> tuple[int, float]:
    """Return whether a mission is in time, too late or without a deadline, and its deadline."""
    deadline = one.mission.deadline
    if deadline is None or not isfinite(deadline):
        return 2, inf
    return int(now + _least(one, drones) > deadline), deadline


def _least(one: Request, drones: Sequence[Drone]) -> float:
    """Return about how many seconds a mission takes at least, from now on."""
    here, way = one.goal, 0.0
    for trip in one.trips[1:]:
        there = trip.source or trip.target
        way, here = way + dist(here, there), trip.target
    kinds = [(drone, drone.category) for drone in drones if one.ever(drone)]
    return min(
        (
            len(one.trips) * upright(kind, one) + (way + drone.distance(one.goal)) * pace(kind, one)
            for drone, kind in kinds
        ),
        default=inf,
    )
