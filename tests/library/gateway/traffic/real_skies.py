"""Drones that fly like Crazyflies, in virtual time: from rest to rest, and what they tell comes late."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import dist, inf

from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.library.gateway.traffic.skies import ENDURING, Sky

PRECISE = CRAZYFLIE.exact
"""The motion of drones that take exactly as long as they are expected to."""


def quick(speed: float) -> Category:
    """Return a category of such drones whose position controllers follow this peak speed."""
    motion = replace(PRECISE, limit=max(speed, PRECISE.limit))
    return replace(ENDURING, speed=speed, motion=motion)


class RealSky(Sky):
    """Such drones behind a gateway; the others of the fleet stand in their docks."""

    def __init__(
        self, homes: list[Point], places: dict[int, Point], airspace: Airspace, speed: float
    ) -> None:
        super().__init__(
            [home[:2] for home in homes],
            airspace=airspace,
            slack=PRECISE.slack,
            category=quick(speed),
        )
        for index, place in places.items():
            self.put(self.drones[index].id, place)
        self.another()
        self.commander = self.link(self.epoch)

    def look(self) -> None:
        """See how near drones above the ground are to each other."""
        at = [body.location for body in self.navigation.bodies.values()]
        for a, b in combinations([place for place in at if place[2] > 0], 2):
            self.nearest = min(self.nearest, dist(a, b))

    def stop(self, how: Down, most: float = 600.0) -> float:
        """Bring all down, and return when the last had landed."""
        self.look()
        down = self.until(self.gateway.bring_down(how), most)
        return self.kernel.now if down else inf


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
