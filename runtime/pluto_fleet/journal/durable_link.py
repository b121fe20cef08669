"""The link to the gateway of an app with a journal: write-ahead, no drone leaves before its launch is durable."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Telemetry

    from ..jobs.job import CommandLink, Job
    from ..jobs.reports import DroneReport
    from .recorder import Recorder


class DurableLink:
    """Forwards everything to the gateway; a flight only once its launch is durable.

    Commands that bring drones down are forwarded at once.
    """

    def __init__(self, link: CommandLink, recorder: Recorder) -> None:
        self._link, self._recorder = link, recorder
        self._held: dict[str, Job] = {}
        """The flights that wait for the journal, by the drones' ids."""

    def fly(self, job: Job, report: Callable[[object], None]) -> None:
        """Give a drone its job as soon as its launch is durable."""
        self._held[job.drone] = job
        self._recorder.when_durable(partial(self._fly, job, report))

    def _fly(self, job: Job, report: Callable[[object], None]) -> None:
        if self._held.get(job.drone) is job:
            del self._held[job.drone]
            self._link.fly(job, report)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does; a job that was not forwarded yet is dropped."""
        self._held.pop(drone, None)
        self._link.break_off(drone)

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry."""
        return self._link.telemetry(drone)

    async def hold(self, drone: str) -> None:
        """Hover."""
        await self._link.hold(drone)

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable; the begin of the action is durable already."""
        return await self._link.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter; the begin of the action is durable already."""
        await self._link.write(drone, name, value)

    async def home(self, drone: str) -> None:
        """Fly to its dock, and land there."""
        await self._link.home(drone)

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._link.land(drone)

    def mended(self, drone: str) -> None:
        """Called when a lost drone has been repaired."""
        self._link.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return await self._link.recover(drone)

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        return await self._link.drone_report(drone)
