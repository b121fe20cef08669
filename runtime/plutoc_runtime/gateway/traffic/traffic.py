"""Who may fly where, now: a section is given whole, or its drone waits for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from math import hypot
from typing import TYPE_CHECKING

from ...energy import docked
from ...errors import Failure, FlightFailed
from ...kernel import FLEET, Kernel, Kind, Timer
from ...signals import Signal
from .claims import Claim, box_of, meets, nearest
from .detours import Section, sections
from .landing import sections_down

if TYPE_CHECKING:
    from ...airspace import Airspace
    from ...controls import Controls
    from ...model import Point
    from ..descent import Craft

AGAIN = 0.5
"""Seconds after which those who wait are looked at again, even if nobody says to have passed."""
PATIENT = 10.0
"""Seconds that a drone hovers where it is in the way of others; then it lands, and waits there."""
AT_LAST = 30.0
"""Seconds after which it lands even if others are about to let it pass."""
ELDER = 20.0
"""Seconds after which younger ones may take nothing any more of what a drone waits for."""
OVERSHOOT, STOPPING = 0.6, 2.0
"""How far a real drone shoots past where it was told to stop, in metres, and for how long."""
_EXACT = 1e-9

Ways = Callable[[Section], Iterable[Section]]
"""The ways that a drone may take to where it wants to go, the best first."""


@dataclass(slots=True, eq=False)
class _Wait:
    """Somebody waits for a section."""

    section: Section
    since: float
    ways: Ways
    over: Signal[Section] = field(default_factory=Signal)


class Traffic:
    """The air that drones have for themselves. Two have none of it nearer to each other than `apart`."""

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[Craft],
        airspace: Airspace,
        *,
        apart: float,
        slack: float = 0.0,
        max_airborne: int | None = None,
    ) -> None:
        self._kernel, self._airspace = kernel, airspace
        self._drones = {drone.id: drone for drone in drones}
        self._telemetry = {drone.id: controls.telemetry(drone.id) for drone in drones}
        self.apart, self.step = apart, apart + slack
        self.limit = self.step - _EXACT
        self.is_real = slack > 0
        """What is simulated stops at once, and goes on as fast."""
        self._overshoot = OVERSHOOT if self.is_real else 0.0
        self._most = len(drones) if max_airborne is None else max_airborne
        self._claims: dict[str, Claim] = {}
        """Of those in the air, or about to be."""
        self._silent: dict[str, float] = {}
        """Who is lost, and until when it may still be in the air."""
        self._waiting: dict[str, _Wait] = {}
        """The oldest first."""
        self._timer: Timer | None = None
        self.look_around()

    def look_around(self) -> None:
        """See who is in the air that nobody has sent there."""
        for drone, telemetry in self._telemetry.items():
            if drone not in self._claims and not telemetry.landed:
                self._claim(drone).rests((), 0.0)

    def begin_anew(self) -> None:
        """Take drones to be where they are, and nothing else: somebody has flown them otherwise."""
        self._claims.clear()
        self.look_around()
        if self._waiting:
            self._released()

    # A drone's section

    def clear(self, section: Section, ways: Ways | None = None) -> Section | None:
        """Give a drone its section, or another one to the same place; None: it must wait."""
        return self._given(section, self._kernel.now, ways or self._at_other_heights)

    async def cleared(self, section: Section, since: float, ways: Ways | None = None) -> Section:
        """Wait for a section, and return what may be flown: it may only lead out of the way."""
        wait = _Wait(section, since, ways or self._at_other_heights)
        self._waiting[section.drone] = wait
        if self._timer is None:
            self._look_at(self._kernel.now + AGAIN)
        try:
            return await wait.over
        finally:
            if self._waiting.get(section.drone) is wait:
                del self._waiting[section.drone]

    def passed(self, drone: str) -> None:
        """A drone has come to the next point of its section."""
        self._claims[drone].at += 1
        if self._waiting:
            self._released()

    def rests(self, drone: str) -> None:
        """A drone is at the end of its section."""
        if self._telemetry[drone].landed:
            self._claims.pop(drone, None)
        else:
            claim = self._claim(drone)
            claim.rests(claim.tail, self._kernel.now + STOPPING)
        if self._waiting:
            self._released()

    def stopped(self, drone: str, fails: bool) -> None:
        """A drone has broken off what it was doing, or it fails."""
        claim = self._claims.get(drone)
        telemetry = self._telemetry[drone]
        if telemetry.landed:
            self._claims.pop(drone, None)
        elif fails:
            self._claim(drone).sinks()
        elif claim is None:
            self._claim(drone).rests((), 0.0)
        elif claim.moves:
            ahead = _ahead(claim.shape(self._kernel.now), self._overshoot)
            claim.rests(ahead, self._kernel.now + STOPPING)
        if self._waiting:
            self._released()

    def break_off(self, drone: str) -> None:
        """Whatever a drone waits for, it gets it no more."""
        wait = self._waiting.pop(drone, None)
        if wait is not None:
            wait.over.fail(FlightFailed(Failure.REFUSED, f"{drone} was told to break it off"))

    def lost(self, drone: str) -> None:
        """Nobody knows any more where a drone is: it comes down when its battery is empty."""
        flight_time = self._drones[drone].category.flight_time
        self._silent[drone] = self._kernel.now + flight_time

    def found(self, drone: str) -> None:
        """A drone is heard of again."""
        self._silent.pop(drone, None)

    # Where to land

    def place_to_land(self, drone: str, here: Point) -> Point | None:
        """Return where to land: here, if nobody stands in the way; None: nearby, where there is room."""
        below, home = (here[0], here[1], 0.0), self._drones[drone].home
        if docked(below, home):
            stands_there = (
                other != drone and telemetry.landed and docked(telemetry.location, home)
                for other, telemetry in self._telemetry.items()
            )
            return None if any(stands_there) else below
        taken = self.taken(drone)
        if self._airspace.problem(below) is not None or any(
            hypot(below[0] - x, below[1] - y) < self.apart - _EXACT for x, y, _ in taken
        ):
            return None
        return below

    def taken(self, drone: str) -> list[Point]:
        """Return where others stand on the ground, or will want to."""
        docks = [other.home for other in self._drones.values() if other.id != drone]
        standing = (
            telemetry.location
            for other, telemetry in self._telemetry.items()
            if other != drone and telemetry.landed
        )
        return [*docks, *standing]

    def aside(self, drone: str) -> Section | None:
        """Give a drone that hovers a way to where it can land, near here; None: there is none now."""
        for section in self.ways_down(drone):
            if self._blocker(section) is None:
                return self._give(section)
        return None

    def beside(self, drone: str) -> Section:
        """Return the shortest way to where a drone can land that may not land where it is."""
        here = self._telemetry[drone].location
        below = Section(drone, (here, (here[0], here[1], 0.0)), False, True)
        return next(iter(self.ways_down(drone)), below)

    def ways_down(self, drone: str) -> Iterable[Section]:
        """Return ways to the ground, near where a drone hovers: the shortest first."""
        here = self._telemetry[drone].location
        below, taken = self.place_to_land(drone, here), self.taken(drone)
        return sections_down(self._airspace, drone, here, below, taken, self.step)

    # Who waits

    def _released(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._look_at(self._kernel.now)

    def _look_at(self, when: float) -> None:
        self._timer = self._kernel.at(when, Kind.CLOCK, FLEET, self._look)

    def _look(self) -> None:
        """Give those who wait what they can get, the oldest first."""
        now = self._kernel.now
        self._timer = None
        for drone, wait in sorted(self._waiting.items(), key=lambda item: item[1].since):
            section = self._given(wait.section, wait.since, wait.ways)
            if section is None and self._should_land(wait, now):
                section = self.aside(drone)
            if section is not None:
                del self._waiting[drone]
                wait.over.set(section)
        if self._waiting and self._timer is None:
            self._look_at(now + AGAIN)

    def _should_land(self, wait: _Wait, now: float) -> bool:
        """Whether a drone that waits had better do so on the ground."""
        if wait.section.stands or now - wait.since < PATIENT:
            return False
        blocker = self._blocker(wait.section)
        return blocker is None or not blocker.moves or now - wait.since >= AT_LAST

    # Who has what

    def _at_other_heights(self, section: Section) -> Iterable[Section]:
        return sections(section, self.step, self._airspace)

    def _given(self, section: Section, since: float, ways: Ways) -> Section | None:
        claims = self._claims
        if section.stands and len(claims) >= self._most and not self._makes_room(section.drone):
            return None
        for way in ways(section):
            if self._blocker(way) is None and not (self._waiting and self._is_kept(way, since)):
                return self._give(way)
        return None

    def _give(self, section: Section) -> Section:
        claim = self._claim(section.drone)
        claim.moves_along(section.points, section.tail)
        return section

    def _claim(self, drone: str) -> Claim:
        claim = self._claims.get(drone)
        if claim is None:
            claim = self._claims[drone] = Claim(drone, self._telemetry[drone])
        return claim

    def _makes_room(self, drone: str) -> bool:
        """Say whether fewer are in the air than it seems: some have come down by themselves."""
        gone = [
            other
            for other, claim in self._claims.items()
            if not claim.moves and self._is_over(claim)
        ]
        for other in gone:
            del self._claims[other]
        return len(self._claims) < self._most or drone in self._claims

    def _is_over(self, claim: Claim) -> bool:
        """Whether a drone that should hover, or fails, is in the air no more."""
        if claim.telemetry.landed:
            return True
        until = self._silent.get(claim.drone)
        return until is not None and self._kernel.now >= until

    def _blocker(self, section: Section) -> Claim | None:
        """Return somebody who has what a section takes."""
        claims, drone = self._claims, section.drone
        if not claims or (len(claims) == 1 and drone in claims):
            return None
        way = (*section.points, *section.tail) if section.tail else section.points
        limit = self.limit
        x, y, z, most_x, most_y, most_z = box_of(way)
        x, y, z = x - limit, y - limit, z - limit
        most_x, most_y, most_z = most_x + limit, most_y + limit, most_z + limit
        for claim in claims.values():
            box = claim.box
            if (
                box[0] < most_x
                and box[3] > x
                and box[1] < most_y
                and box[4] > y
                and box[2] < most_z
                and box[5] > z
                and claim.drone != drone
                and self._is_in_the_way(claim, way, section.stands)
            ):
                return claim
        return None

    def _is_in_the_way(self, claim: Claim, way: tuple[Point, ...], stands: bool) -> bool:
        shape, limit = claim.shape(self._kernel.now), self.limit
        if not meets(way, shape, limit):
            return False
        if claim.moves:
            return True
        if self._is_over(claim):
            return False
        if stands:
            return True
        # Who is too near to somebody that hovers already, may go away, but no nearer.
        now = nearest(way[:1], shape[:1])
        return now >= limit or meets(way, shape, now - 1e-6)

    def _is_kept(self, section: Section, since: float) -> bool:
        """Whether somebody who has waited for long wants what a section takes.

        Who lands is never kept, nor who leaves that place to somebody older.
        """
        if section.lands:
            return False
        for wait in self._waiting.values():
            wanted = wait.section
            if (
                wait.since < since
                and self._kernel.now - wait.since >= ELDER
                and wanted.drone != section.drone
                and meets(section.points, wanted.points, self.limit)
                and (
                    section.stands
                    or not meets(section.points[:1], wanted.points, self.limit)
                    or meets(section.points[-1:], wanted.points, self.limit)
                )
            ):
                return True
        return False


def _ahead(shape: tuple[Point, ...], metres: float) -> tuple[Point, ...]:
    """Return to where a drone shoots past the place where it is, on its way."""
    if len(shape) < 2 or not metres:
        return ()
    (x, y, z), (tx, ty, tz) = shape[:2]
    far = hypot(tx - x, ty - y, tz - z)
    part = min(1.0, metres / far) if far else 0.0
    return ((x + part * (tx - x), y + part * (ty - y), z + part * (tz - z)),)
