"""`earliest_deadline`: the trip of the mission with the earliest deadline goes first, to the nearest drone.

It waits for one that will be there sooner than any free one. Pure earliest-deadline-first fails badly where not all can
be in time: it spends drones on what is too late already, and so makes the next one late (Jackson 1955; Buttazzo et al.
1995). So a mission that can be in time no more goes after those that can, and one without a deadline after all.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from math import dist, inf, isfinite
from typing import TYPE_CHECKING

from .batch import Batch
from .durations import FLIES, busy, ends, free_again, look_again, pace, upright
from .policies import lowest
from .reach import LOW

if TYPE_CHECKING:
    from ..domain.model import Drone, Point
    from .policies import Choice
    from .queue import Queue, Request


@Batch
def earliest_deadline(
    requests: Sequence[Request], free: Sequence[Drone], queue: Queue
) -> Sequence[Choice | None]:
    """Give drones to missions in the order of their deadlines, each the one that is there first."""
    now = queue.kernel.now
    left = list(free)
    chosen: dict[Request, Choice] = {}
    until = queue.plans.setdefault("until", {})
    again = inf
    soon = {one: free_again(one, queue) for one in until if one.status in FLIES and one not in left}
    by_deadline = sorted((*_urgency(one, queue.drones, now), n) for n, one in enumerate(requests))
    for _, deadline, number in by_deadline:
        one = requests[number]
        found = lowest(left, one.able, partial(_way, one))
        if found is None:
            continue
        drone, way = found
        if queue.stay_out and not one.hurries and (sooner := _sooner(one, soon, way)):
            del soon[sooner]
            again = min(again, way)
            continue
        left.remove(drone)
        seconds = way + busy(drone.category, one)
        soon[drone] = (seconds, ends(one))
        until[drone] = (now + seconds, ends(one))
        due = "no deadline" if deadline == inf else f"due in {deadline - now:.0f} s"
        metres = f"{drone.distance(one.goal):.1f} m away"
        chosen[one] = (drone, f"{due}; nearest of {len(left) + 1} free: {metres}")
    if again < inf:
        look_again(queue, (earliest_deadline, requests[0].rank[0]), again)
    return [chosen.get(one) for one in requests]


def _way(one: Request, drone: Drone, here: Point | None = None) -> float:
    return pace(drone.category, one) * dist((here or drone.location)[:2], one.goal[:2])


def _sooner(one: Request, soon: dict[Drone, tuple[float, Point]], least: float) -> Drone | None:
    """Return the drone that is there first, of others than free ones; None: in no less than so many seconds."""
    first = None
    for drone, (waits, place) in soon.items():
        way = waits + _way(one, drone, place)
        if way < least and one.ever(drone):
            level = drone.battery_level - waits / drone.category.endurance
            if level >= max(drone.category.reserve + LOW, one.at_least(drone, (*place[:2], 0.0))):
                least = way
                first = drone
    return first


def _urgency(one: Request, drones: Sequence[Drone], now: float) -> tuple[int, float]:
    """Return whether a mission is in time, too late or without a deadline, and its deadline."""
    deadline = one.mission.deadline
    if deadline is None or not isfinite(deadline):
        return 2, inf
    return int(now + _least(one, drones) > deadline), deadline


def _least(one: Request, drones: Sequence[Drone]) -> float:
    """Return about how many seconds a mission takes at least, from now on."""
    metres = sum(dist(a.target, b.source or b.target) for a, b in pairwise(one.trips))
    metres += sum(dist(trip.source, trip.target) for trip in one.trips if trip.source)
    seconds = (
        len(one.trips) * upright(drone.category, one)
        + metres * pace(drone.category, one)
        + _way(one, drone)
        for drone in drones
        if one.ever(drone)
    )
    return min(seconds, default=inf)
