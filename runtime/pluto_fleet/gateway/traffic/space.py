"""The space of a fleet: what each drone in the air has reserved, and what that blocks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import dist
from typing import TYPE_CHECKING

from .reservations import Reservation, are_near, meets, nearest

if TYPE_CHECKING:
    from ...jobs.controls import FleetDrone
    from ...jobs.telemetry import Telemetry
    from ...shared.domain.model import Point
    from ...shared.time.kernel import Kernel
    from .ways import Section

SWAY = 0.05
"""By how much two real drones may be nearer to each other than the places where they were told to be."""


class Space:
    """The reservations of all drones in the air, or about to take off."""

    def __init__(
        self,
        kernel: Kernel,
        drones: Mapping[str, FleetDrone],
        telemetry: Mapping[str, Telemetry],
        apart: float,
        limit: float,
        is_real: bool,
        most: int,
    ) -> None:
        """`limit` is how near two may come to each other."""
        self._kernel, self._drones, self._telemetry = kernel, drones, telemetry
        self._apart, self._limit, self._is_real = apart, limit, is_real
        self.most = most
        """How many may be in the air."""
        self.claims: dict[str, Reservation] = {}
        """By their drones."""
        self._silent: dict[str, float] = {}
        """Lost drones, and until when each may still be in the air."""
        self.changed: Callable[[Reservation], object] = _ignore
        """Called when a drone has released what it had reserved."""

    def claim(self, drone: str) -> Reservation:
        claim = self.claims.get(drone)
        if claim is None:
            slack = max(0.0, self._limit - self._apart) if self._is_real else 0.0
            claim = self.claims[drone] = Reservation(drone, self._telemetry[drone], slack)
        return claim

    def place(self, drone: str) -> Point:
        """Return where a drone is, by what it was told, if it is there but for what is measured."""
        claim = self.claims.get(drone)
        return self._telemetry[drone].location if claim is None else claim.place

    def drop(self, drone: str) -> None:
        """Release all that a drone has reserved."""
        claim = self.claims.pop(drone, None)
        if claim is not None:
            claim.points = ()  # so that no other takes it for an obstacle
            self.changed(claim)

    def has_room(self, section: Section) -> bool:
        """Return whether a drone may take off, by the limit of drones in the air."""
        claims = self.claims
        if not section.stands or len(claims) < self.most:
            return True
        for claim in [*claims.values()]:  # some may have come down by themselves
            if not claim.moves and self.is_over(claim):
                self.drop(claim.drone)
        return len(claims) < self.most

    def is_over(self, claim: Reservation) -> bool:
        """Whether a drone that should hover, or has failed, is not in the air any more."""
        if claim.telemetry.landed:
            return True
        until = self._silent.get(claim.drone)
        return until is not None and self._kernel.now >= until

    def blocker(
        self, section: Section, clear: dict[str, tuple[Point, ...]] | None = None
    ) -> Reservation | None:
        """Return a drone whose reservation blocks a section.

        Routes in `clear` are taken not to; others that do not are added.
        """
        claims, drone = self.claims, section.drone
        if not claims or (len(claims) == 1 and drone in claims):
            return None
        limit = self._limit
        x, y, z, most_x, most_y, most_z = section.box
        x, y, z = x - limit, y - limit, z - limit
        most_x, most_y, most_z = most_x + limit, most_y + limit, most_z + limit
        for other, claim in claims.items():
            if other == drone or (clear is not None and clear.get(other) is claim.points):
                continue
            box = claim.box
            if (
                box[0] < most_x
                and box[3] > x
                and box[1] < most_y
                and box[4] > y
                and box[2] < most_z
                and box[5] > z
                and self.is_in_the_way(claim, section)
            ):
                return claim
            if clear is not None and claim.moves:
                clear[other] = claim.points
        return None

    def is_in_the_way(self, claim: Reservation, section: Section) -> bool:
        way, shape, limit = section.whole, claim.shape(self._kernel.now), self._limit
        if not are_near(section.box, claim.shape_box, limit):
            return False
        if self._is_real and claim.touches_down(self._kernel.now):
            limit = self._apart - SWAY  # docks may stand just so far apart
        if not meets(way, shape, limit):
            return False
        if claim.moves:
            return True
        if self.is_over(claim):
            return False
        if section.stands:
            return True
        # A drone that is too near to a hovering one already may fly away from it, but no nearer.
        now = nearest(way[:1], shape[:1])
        return now >= limit or meets(way, shape, now - 1e-6)

    def holder(self, place: Point, drone: str) -> Reservation | None:
        """Return what another drone has reserved that hovers too near to a place, or flies there to hover."""
        for other, claim in self.claims.items():
            end = claim.points[-1]
            stays = other != drone and not claim.fails and end[2] > 0.0
            if stays and dist(end, place) < self._limit:
                return claim
        return None

    def lost(self, drone: str) -> None:
        """Called when a drone's position is unknown: it is down when its battery is empty at the latest."""
        self._silent[drone] = self._kernel.now + self._drones[drone].category.endurance

    def found(self, drone: str) -> None:
        """Called when a lost drone has telemetry again."""
        self._silent.pop(drone, None)


def _ignore(_: Reservation) -> None:
    """Do nothing: no callback is set."""
