"""How a drone that hovers gets to the ground, near where it is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from ...spots import free_spots
from .detours import LOWEST, Section

if TYPE_CHECKING:
    from ...airspace import Airspace
    from ...model import Point

_SPOTS = 120
"""How many places are looked at, the nearest first."""
_LEVELS = (0, -1, 1, -2, 2)
"""At which heights a drone flies there, in multiples of what keeps drones apart."""


def sections_down(
    airspace: Airspace,
    drone: str,
    here: Point,
    below: Point | None,
    taken: Sequence[Point],
    step: float,
) -> Iterator[Section]:
    """Yield ways to places where it can land: straight below first, if it may land there at all."""
    x, y, z = here
    if below is not None:
        yield Section(drone, (here, below), False, True, aside=True)
    back = () if airspace.problem(here) is None else (airspace.way_back(here),)
    if back:
        ((x, y, z),) = back
    for spot in islice(free_spots(airspace, (x, y, z), taken, step), _SPOTS):
        if spot[:2] == here[:2]:
            continue
        if z > LOWEST and airspace.leg_problem((x, y, z), spot) is None:
            slope = (spot[0], spot[1], LOWEST)
            yield Section(drone, (here, *back, slope, spot), False, True, aside=True)
        for level in _LEVELS:
            height = z + level * step
            if not (level == 0 or LOWEST / 2 <= height <= airspace.ceiling):
                continue
            route = airspace.route((x, y, height), (spot[0], spot[1], height))
            if route is not None:
                up = ((x, y, height),) if level else ()
                points = (here, *back, *up, *route, spot)
                yield Section(drone, points, False, True, aside=True)
