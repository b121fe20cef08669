"""Bringing all drones down at once, where they are or each at home, and apart from one another.

Each asks traffic for a way, as for any flight, and gets the best one that is free. To land, the lowest asks
first: layer after layer. A drone that goes home does so even if it is on the ground elsewhere, with what it carries.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import islice
from operator import itemgetter
from typing import TYPE_CHECKING

from ..jobs.reports import Down
from ..shared.domain.errors import FlightFailed
from ..shared.fleet.reach import docked
from ..shared.time.kernel import FLEET, Kernel, Task
from .traffic.reservations import meets
from .traffic.ways import ways_home

if TYPE_CHECKING:
    from ..jobs.controls import FleetDrone
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point
    from .executor import Executor
    from .traffic.traffic import Traffic
    from .traffic.ways import Section

_NEAR = 60
"""How many ways to the ground are considered, straight below first."""
_HINDERS = 5.0
"""Seconds that a drone flies longer rather than where another is, or is to land."""


class Descent:
    """Brings down every drone in the air. One that fails does not hold up the others."""

    def __init__(
        self,
        kernel: Kernel,
        pilots: Executor,
        drones: Sequence[FleetDrone],
        airspace: Airspace,
        traffic: Traffic | None,
    ) -> None:
        self._kernel, self._pilots, self._airspace = kernel, pilots, airspace
        self._drones, self._traffic = drones, traffic

    async def down(self, how: Down) -> None:
        """Bring them down; if cancelled, they hover."""
        order = sorted(self._drones, key=lambda drone: self._turn(drone, how))
        tasks: list[Task[None]] = []
        try:
            for rank, drone in enumerate(order, start=1):
                comes = self._comes(drone, how)
                tasks.append(self._kernel.spawn(comes, FLEET + rank, f"{drone.id} comes down"))
            for task in tasks:
                await task
        finally:
            for task in tasks:
                task.cancel()

    def _turn(self, drone: FleetDrone, how: Down) -> float:
        """Return what orders the drones: who has the longest way home asks first, or the shortest way down."""
        ways = self._ways(drone, how)
        seconds = ways[0].seconds(drone.category) if ways else 0.0
        return seconds if how is Down.LAND else -seconds

    async def _comes(self, drone: FleetDrone, how: Down) -> None:
        """Bring one down; where it has to land aside to let others pass, it goes home from there."""
        ways: list[Section] = []

        def plan() -> Section:
            ways[:] = self._ways(drone, how)
            return ways[0]

        try:
            while self._ways(drone, how):
                begins = partial(self._pilots.begins, drone.id)
                await self._pilots.travels(
                    drone.id, plan, begins, ways=lambda _: ways, anywhere=True
                )
        except FlightFailed:
            pass  # it is lost, or has fallen

    def _ways(self, drone: FleetDrone, how: Down) -> list[Section]:
        """Return the ways to where a drone is to be, the best first; none if it is there, or stays where it stands."""
        ways = self._ways_home(drone) if how is Down.HOME else []
        if ways or self._pilots.telemetry[drone.id].landed:
            return ways
        if self._traffic is not None:
            ways = [*islice(self._traffic.ground.ways_down(drone.id), _NEAR)]
        return ways or [self._pilots.way_down(drone.id)]

    def _ways_home(self, drone: FleetDrone) -> list[Section]:
        """Return ways home; none if it is there, or cannot get there."""
        telemetry, traffic = self._pilots.telemetry[drone.id], self._traffic
        if telemetry.landed and docked(telemetry.location, drone.home):
            return []
        if traffic is not None and traffic.ground.below(drone.id, drone.home) is None:
            return []  # another stands there
        step = 0.0 if traffic is None else traffic.step
        here = self._pilots.place(drone.id)
        enough = telemetry.battery_level * drone.category.endurance
        places = self._places(drone.id)
        found: list[tuple[float, Section]] = []
        for way in ways_home(self._airspace, drone, here, telemetry.landed, step):
            seconds = way.seconds(drone.category)
            if seconds < enough:
                hinders = sum(meets(way.points, place, step) for place in places)
                found.append((seconds + _HINDERS * hinders, way))
        return [way for _, way in sorted(found, key=itemgetter(0))]

    def _places(self, drone: str) -> list[tuple[Point, ...]]:
        """Return where the others hover that are to come down, and where they will land."""
        places: list[tuple[Point, ...]] = []
        if self._traffic is None:
            return places
        for other in self._drones:
            if other.id != drone and not self._pilots.telemetry[other.id].landed:
                x, y, _ = other.home
                places.append((self._pilots.place(other.id),))
                places.append(((x, y, 0.0), (x, y, self._airspace.cruise_height)))
        return places
