"""The ground: where a drone may land, and how one that hovers gets there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING

from plutoc_runtime.fleet.energy import docked
from plutoc_runtime.fleet.landing_sites import free_spots, is_free

from .detours import LOWEST, Section

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point, Telemetry

    from ..descent import Craft

_SPOTS = 120
"""How many places are looked at, the nearest first."""
_LEVELS = (0, -1, 1, -2, 2)
"""At which heights a drone flies there, in multiples of what keeps drones apart."""
_EXACT = 1e-9


class Ground:
    """Where drones stand, and where their docks are: there no other lands."""

    def __init__(
        self,
        drones: Mapping[str, Craft],
        telemetry: Mapping[str, Telemetry],
        airspace: Airspace,
        step: float,
    ) -> None:
        self._drones, self._telemetry = drones, telemetry
        self._airspace, self._step = airspace, step

    def below(self, drone: str, here: Point) -> Point | None:
        """Return the place below, where a drone may land; None: it may not.

        In its own dock it may, however near others stand, if none stands in that very dock.
        """
        place, home = (here[0], here[1], 0.0), self._drones[drone].home
        if docked(place, home):
            return None if self._is_taken(drone) else place
        if self._airspace.problem(place) is not None:
            return None
        return place if is_free(place, self._taken(drone), self._step - _EXACT) else None

    def _is_taken(self, drone: str) -> bool:
        """Say whether another stands in a drone's dock."""
        home = self._drones[drone].home
        return any(
            docked(telemetry.location, home) and telemetry.landed and other != drone
            for other, telemetry in self._telemetry.items()
        )

    def _taken(self, drone: str) -> list[Point]:
        """Return where others stand, or will want to."""
        docks = [other.home for other in self._drones.values() if other.id != drone]
        standing = (
            telemetry.location
            for other, telemetry in self._telemetry.items()
            if other != drone and telemetry.landed
        )
        return [*docks, *standing]

    def way_down(self, drone: str) -> Section:
        """Return the best way to the ground; straight down where there is none that is free."""
        x, y, z = self._telemetry[drone].location
        straight = Section(drone, ((x, y, z), (x, y, 0.0)), False, True, aside=True)
        return next(self.ways_down(drone), straight)

    def ways_down(self, drone: str) -> Iterator[Section]:
        """Yield ways to where a drone that hovers can land: straight below first, if it may."""
        here, airspace, step = self._telemetry[drone].location, self._airspace, self._step
        below, (x, y, z) = self.below(drone, here), here
        if below is not None:
            yield Section(drone, (here, below), False, True, aside=True)
        back = () if airspace.problem(here) is None else (airspace.way_back(here),)
        if back:
            ((x, y, z),) = back
        for spot in islice(free_spots(airspace, (x, y, z), self._taken(drone), step), _SPOTS):
            if spot[:2] == here[:2]:
                continue
            if z > LOWEST and airspace.leg_problem((x, y, z), spot) is None:
                slope = (spot[0], spot[1], LOWEST)
                yield Section(drone, (here, *back, slope, spot), False, True, aside=True)
            for level in _LEVELS:
                height = z + level * step
                if level and not LOWEST / 2 <= height <= airspace.ceiling:
                    continue
                route = airspace.route((x, y, height), (spot[0], spot[1], height))
                if route is not None:
                    up = ((x, y, height),) if level else ()
                    points = (here, *back, *up, *route, spot)
                    yield Section(drone, points, False, True, aside=True)
