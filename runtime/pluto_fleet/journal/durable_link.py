"""The way to the drones, for an app that keeps a journal: no drone leaves before that is on record."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point, Telemetry

    from ..jobs.job import CommandLink, Job
    from ..jobs.reports import DroneReport
    from .recorder import Recorder


class DurableLink:
    """Hands everything on to the gateway; a flight only once its launch is durable.

    What brings drones down waits for nothing.
    """

    def __init__(self, link: CommandLink, recorder: Recorder) -> None:
        self._link, self._recorder = link, recorder
        self._held: dict[str, Job] = {}
        """The flights that wait for the journal, by the drones' ids."""

    def fly(self, job: Job, report: Callable[[object], None]) -> None:
        """Send a drone on its way as soon as its launch is on record."""
        self._held[job.drone] = job
        self._recorder.when_durable(partial(self._fly, job, report))

    def _fly(self, job: Job, report: Callable[[object], None]) -> None:
        if self._held.get(job.drone) is job:
            del self._held[job.drone]
            self._link.fly(job, report)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does; a flight that has not left stays."""
        self._held.pop(drone, None)
        self._link.break_off(drone)

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone."""
        return self._link.telemetry(drone)

    async def hold(self, drone: str) -> None:
        """Hover."""
        await self._link.hold(drone)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures; that its action has begun is on record."""
        return await self._link.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has; that its action has begun is on record."""
        await self._link.write(drone, name, value)

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height."""
        await self._link.takeoff(drone, height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._link.go_to(drone, target)

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._link.land(drone)

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone."""
        self._link.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return await self._link.recover(drone)

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        return await self._link.drone_report(drone)
