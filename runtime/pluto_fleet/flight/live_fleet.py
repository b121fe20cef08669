"""The fleet of a real flight: drones report their state, and are repaired by people."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import DroneStatus
from plutoc_runtime.domain.text import cut_off, place, printable
from plutoc_runtime.fleet.fleet import LONGEST, Fleet

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Drone
    from plutoc_runtime.flow.mission import Core

    from ..jobs.job import CommandLink
    from ..jobs.reports import DroneReport

_HELPLESS = 12.0
"""Seconds after which a drone on the ground would have begun to fly home, if it could."""


class LiveFleet(Fleet):
    """A fleet whose drones may have been lost, retired or flying before this run."""

    _navigation: CommandLink

    def __init__(self, *parts: Any) -> None:
        super().__init__(*parts)
        self.retired: set[Drone] = set()
        """Drones that are not allocated until they are brought back."""
        self.lost: dict[Drone, str] = {}
        """Drones that were lost in an earlier run, and not brought back since."""
        self.carried_home = True
        """Whether drones that need a person are waited for when all missions have ended."""

    def dismiss(self, drone: Drone) -> None:
        """Take a drone back whose trip has ended well; a retired one goes home."""
        if drone not in self.retired:
            super().dismiss(drone)
        elif not self._rests(drone):
            self.send_home(drone)

    def _rests(self, drone: Drone) -> bool:
        """Free it, or charge it first; a retired drone must be home, and is OFFLINE."""
        if drone not in self.retired:
            return super()._rests(drone)
        if not self._is_docked(drone):
            return False
        self._become(drone, DroneStatus.OFFLINE)
        return True

    async def _why_lost(self, drone: Drone, reason: str) -> str:
        """Return the drone's own reason, which may be newer than that of the failed flight."""
        report = await self._navigation.drone_report(drone.id)
        return _in_words(report) or await super()._why_lost(drone, reason)

    def take_up(self, drone: Drone, report: DroneReport) -> None:
        """Take over a drone that no mission needs now, when an app starts or resumes.

        It is allocated only once it is on the ground, healthy, with nothing aboard; a lost one only
        once it has been repaired, even if it reports to be healthy.
        """
        if drone in self.lost:
            self._leave_lost(drone, report)
            return
        why = self._say_why_not(drone, report)
        well = report.reached and report.landed and not report.problems
        if not (well and report.carrying is None and self._rests(drone)):
            self.recover(drone, why or f"{drone.id} does not answer")
            if why and report.landed:
                self.unready[drone] = why

    def _leave_lost(self, drone: Drone, report: DroneReport) -> None:
        """Leave a lost drone where it is, unless it is in the air: then it comes home, and stays lost."""
        if report.reached and not report.landed:
            down = partial(self._bring_down, reason=self.lost[drone])
            self._send(drone, DroneStatus.RECOVERING, down, "comes down")
        else:
            self._lose(drone, self.lost[drone])

    async def _bring_down(self, drone: Drone, reason: str) -> None:
        await self._navigation.recover(drone.id)
        self._lose(drone, reason)

    def _lose(self, drone: Drone, reason: str) -> None:
        self.unready[drone] = reason
        self._become(drone, DroneStatus.LOST)

    def _say_why_not(self, drone: Drone, report: DroneReport) -> str:
        """Log why a drone may not fly, and return the reason."""
        if not report.problems:
            return ""
        why = _in_words(report)
        self._trace.note("drone.not_ready", drone=drone.id, reason=why)
        return why

    def retire(self, drone: Drone) -> None:
        """Allocate this drone to no further mission; its current trip goes on to its end."""
        self.retired.add(drone)
        if drone.status in (DroneStatus.FREE, DroneStatus.CHARGING) and not self._rests(drone):
            self.send_home(drone)

    def bring_back(self, drone: Drone) -> None:
        """Make a retired drone available again; a lost one once it has come home."""
        self.retired.discard(drone)
        self.lost.pop(drone, None)
        if drone.status is DroneStatus.LOST:
            self._navigation.mended(drone.id)
            self._send(drone, DroneStatus.RECOVERING, self._come_back, "comes back")
            return
        if drone in self.unready:  # its task may be waiting for this
            self._navigation.mended(drone.id)
        if drone.status is DroneStatus.OFFLINE and not self._rests(drone):
            self.send_home(drone)

    def flies_on(self, drone: Drone) -> None:
        """Take over a drone that has been flying for a mission since before the interruption."""
        self._become(drone, DroneStatus.BUSY)

    def halt(self) -> None:
        """End all errands: the gateway brings the drones down."""
        for errand in list(self.errands.values()):
            errand.cancel()
        self.errands.clear()

    async def all_down(self) -> None:
        """Wait until no drone is returning, landing or recovering.

        A drone on the ground that needs a person is waited for only with `carried_home`.
        """
        stands_since: dict[Drone, float] = {}
        while under_way := {one: task for one, task in self.errands.items() if not task.is_set}:
            if self.carried_home:
                await next(iter(under_way.values())).ended()
                continue
            now = self._kernel.now
            for drone in self.drones:
                if drone not in under_way or not self._stands(drone):
                    stands_since.pop(drone, None)
                else:
                    stands_since.setdefault(drone, now)
            if all(now - stands_since.get(drone, now) >= _HELPLESS for drone in under_way):
                self._leave_to_a_person(tuple(under_way))
                return
            await self._kernel.sleep(1.0)

    def _stands(self, drone: Drone) -> bool:
        return drone.status is DroneStatus.RECOVERING and drone.telemetry.landed

    def _leave_to_a_person(self, drones: Sequence[Drone]) -> None:
        for drone in drones:
            text = f"{drone.id} stands at {place(drone.location)} and needs a person: go and look"
            self._trace.note("log", mission=None, text=text)

    async def _come_back(self, drone: Drone) -> None:
        """Bring a repaired drone home, or log why that failed."""
        self._become(drone, DroneStatus.RECOVERING)
        if await self._navigation.recover(drone.id):
            await self._settle(drone)
        else:
            report = await self._navigation.drone_report(drone.id)
            self._lose(drone, self._say_why_not(drone, report) or _STILL)


def live_fleet(core: Core) -> LiveFleet:
    """Return the fleet of a real flight."""
    assert isinstance(core.fleet, LiveFleet)
    return core.fleet


def _in_words(report: DroneReport) -> str:
    """Return why a drone may not fly, in its own words."""
    return cut_off("; ".join(map(printable, report.problems)), LONGEST)


_STILL = "it was brought back, and could not be reached"
"""Why a drone is lost, if it gives no reason."""
