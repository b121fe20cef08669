"""`batch_optimal`: all waiting trips and all free drones at once, least total distance.

The assignment problem is solved by shortest augmenting paths with potentials (the "Hungarian
method": Kuhn 1955; in this O(n²m) form Jonker and Volgenant 1987). A pair that may not be is priced
out of reach, so that as many trips as can be get a drone, and among those the distance is least.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING

from ..policy import Able, BatchPool, Choice

if TYPE_CHECKING:
    from ..model import Drone, Trip

_FORBIDDEN = 1e7  # metres: farther than any drone flies, near enough to keep its decimals


def batch_optimal() -> BatchPool:
    """Share the free drones out so that their way to all trips together is shortest."""
    return Batch()


class Batch(BatchPool):
    """The free drones, for all trips at once."""

    def __init__(self) -> None:
        self._free: dict[Drone, None] = {}

    def add(self, drone: Drone) -> None:
        """A drone is free."""
        self._free[drone] = None

    def remove(self, drone: Drone) -> None:
        """A drone is not free any more."""
        self._free.pop(drone, None)

    def choose(self, trip: Trip, able: Able) -> Choice | None:
        """Return the drone for a trip that waits alone."""
        return self.share([(trip, able)])[0]

    def share(self, offers: Sequence[tuple[Trip, Able]]) -> Sequence[Choice | None]:
        """Return a drone, or None, for each trip."""
        drones = sorted(self._free, key=lambda drone: drone.index)
        costs = [
            [
                drone.distance(trip.source or trip.target) if able(drone) else _FORBIDDEN
                for drone in drones
            ]
            + [_FORBIDDEN] * max(0, len(offers) - len(drones))
            for trip, able in offers
        ]
        why = f"least total way for {len(offers)} waiting trips and {len(drones)} free drones"
        return [
            (
                (drones[column], f"{why}: {row[column]:.1f} m away")
                if row[column] < _FORBIDDEN
                else None
            )
            for row, column in zip(costs, assign(costs), strict=True)
        ]


def assign(costs: Sequence[Sequence[float]]) -> list[int]:
    """Return a column for each row so that the sum is least; at least as many columns as rows."""
    rows, columns = len(costs), len(costs[0])
    row_price, column_price = [0.0] * (rows + 1), [0.0] * (columns + 1)
    row_of = [0] * (columns + 1)  # 1-based; 0 = free
    for row in range(1, rows + 1):
        row_of[0] = row
        least, seen, came_from = [inf] * (columns + 1), [False] * (columns + 1), [0] * (columns + 1)
        column = 0
        while row_of[column]:
            seen[column] = True
            here, step, nearest = row_of[column], inf, 0
            for other in range(1, columns + 1):
                if seen[other]:
                    continue
                rest = costs[here - 1][other - 1] - row_price[here] - column_price[other]
                if rest < least[other]:
                    least[other], came_from[other] = rest, column
                if least[other] < step:
                    step, nearest = least[other], other
            for other in range(columns + 1):
                if seen[other]:
                    row_price[row_of[other]] += step
                    column_price[other] -= step
                else:
                    least[other] -= step
            column = nearest
        while column:
            row_of[column], column = row_of[came_from[column]], came_from[column]
    chosen = [0] * rows
    for column in range(1, columns + 1):
        if row_of[column]:
            chosen[row_of[column] - 1] = column - 1
    return chosen
