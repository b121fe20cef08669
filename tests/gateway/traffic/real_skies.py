"""Drones that fly as real ones do, in virtual time: from rest to rest, and what they tell comes late."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import dist, inf, sqrt

from pluto_fleet.files.fleet import PACE
from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.fleet.telemetry import Leg
from pluto_fleet.shared.time.kernel import Kernel
from pluto_fleet.simulation.body import Body, SimulatedDrone
from pluto_fleet.simulation.drones import SimulatedNavigation
from tests.gateway.traffic.skies import ENDURING, Sky

SLACK = 0.15
NOTICED = 0.1
"""Seconds until it is known that a leg is over."""
FLIES_ON = 2.0
"""Seconds for which a drone that has landed says that it flies."""
CLIMB_LIMIT = 0.6
"""Metres per second, up and down, at most."""


class SmoothLeg(Leg):
    """A leg from rest to rest: a polynomial of the seventh order."""

    def at(self, now: float) -> Point:
        """Return the place at a time."""
        if not self.leaves < now < self.arrives:
            return Leg.at(self, now)
        s = (now - self.leaves) / (self.arrives - self.leaves)
        part = s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)
        (ax, ay, az), (bx, by, bz) = self.start, self.end
        return ax + part * (bx - ax), ay + part * (by - ay), az + part * (bz - az)


class RealBody(Body):
    """A body that moves so."""

    def move(self, target: Point, now: float, arrives: float) -> None:
        """Go straight to a point, to be there at a time."""
        if arrives > now:
            self._turn(SmoothLeg(self._leg.at(now), target, now, arrives), now)
        else:
            super().move(target, now, arrives)


class RealNavigation(SimulatedNavigation):
    """Flies drones at a peak speed, and notices late that they have arrived."""

    def __init__(self, kernel: Kernel, drones: list[SimulatedDrone], airspace: Airspace) -> None:
        super().__init__(kernel, drones, World(1, airspace), Faults(), 1, airspace)
        self.telemetry = self.bodies = {drone.id: RealBody(drone, kernel.time) for drone in drones}
        self.landings: dict[str, float] = {}
        """When each one's motors were off."""

    async def _move(self, body: Body, target: Point, speed: float, command: str) -> float:
        lands = command == "to land"
        limit = body.drone.category.speed / PACE
        if lands or command == "to take off":
            limit = min(CLIMB_LIMIT, limit)
        metres, now = dist(body.location, target), self._kernel.now
        seconds = max(1.0, metres / (PACE * limit), sqrt(7.52 * metres / 4.0))
        body.move(target, now, now + seconds)
        if lands:
            self.landings[body.drone.id] = await self._pass(body, seconds, command)
            return await self._pass(body, FLIES_ON, command)
        return await self._pass(body, seconds + NOTICED, command)


class RealSky(Sky):
    """Such drones behind a gateway; the others of the fleet stand in their docks."""

    def __init__(
        self, homes: list[Point], places: dict[int, Point], airspace: Airspace, speed: float
    ) -> None:
        category = replace(ENDURING, speed=speed * PACE)
        super().__init__(
            [home[:2] for home in homes], airspace=airspace, slack=SLACK, category=category
        )
        self.real = RealNavigation(self.kernel, self.drones, airspace)
        self.navigation = self.real
        for index, place in places.items():
            body = self.real.bodies[self.drones[index].id]
            body.lift_off(0.0)
            body.move(place, 0.0, 0.0)
        self.link = self.another().link(self.epoch)

    def look(self) -> None:
        """See how near drones above the ground are to each other."""
        at = [body.location for body in self.navigation.bodies.values()]
        for a, b in combinations([place for place in at if place[2] > 0], 2):
            self.nearest = min(self.nearest, dist(a, b))

    def stop(self, how: Down, most: float = 600.0) -> float:
        """Bring all down, and return when the motors of the last were off."""
        self.look()
        if not self.until(self.gateway.bring_down(how), most):
            return inf
        return max(self.real.landings.values(), default=0.0)


def late(
    homes: list[Point], places: list[Point], airspace: Airspace, speed: float, how: Down
) -> tuple[float, RealSky]:
    """Return how much later than the slowest alone all are down, and the sky in which that was."""
    alone = 0.0
    for index, place in enumerate(places):
        sky = RealSky(homes, {index: place}, airspace, speed)
        alone = max(alone, sky.stop(how))
        sky.kernel.close()
    together = RealSky(homes, dict(enumerate(places)), airspace, speed)
    return together.stop(how) - alone, together
