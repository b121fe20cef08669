"""`batch_optimal`: all waiting trips and all free drones at once, least total distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from .assignment import assign
from .batch import Batch
from .needs import Request

if TYPE_CHECKING:
    from ..domain.model import Drone
    from .policies import Choice


@Batch
def batch_optimal(
    offers: Sequence[Request], free: Sequence[Drone], _: object
) -> Sequence[Choice | None]:
    """Give as many trips a drone as can be, so that the way of all together is shortest."""
    goals = [one.goal for one in offers]

    def drones_for(number: int) -> Iterator[tuple[float, int]]:
        away = sorted((drone.distance(goals[number]), place) for place, drone in enumerate(free))
        return (pair for pair in away if offers[number].able(free[pair[1]]))

    def trips_for(place: int) -> Iterator[tuple[float, int]]:
        away = sorted((free[place].distance(goal), number) for number, goal in enumerate(goals))
        return (pair for pair in away if offers[pair[1]].able(free[place]))

    pairs: list[tuple[float, int] | None] = [None] * len(offers)
    if len(offers) <= len(free):  # the fewer choose among the more: so it is quick
        pairs = assign([drones_for(number) for number in range(len(offers))])
    else:
        for place, pair in enumerate(assign([trips_for(place) for place in range(len(free))])):
            if pair is not None:
                pairs[pair[1]] = pair[0], place
    why = f"least total way for {len(offers)} waiting trips and {len(free)} free drones"
    return [pair and (free[pair[1]], f"{why}: {pair[0]:.1f} m away") for pair in pairs]
