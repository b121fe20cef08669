"""Flies jobs and errands, by what each drone can be made to do: the `Navigation` of every gateway."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ..energy import docked, flight_seconds
from ..errors import Failure, FlightFailed
from ..kernel import FLEET, Cancelled, Kernel, Task
from ..navigation import motors_cut, permitted_way

if TYPE_CHECKING:
    from ..airspace import Airspace
    from ..model import Point, Telemetry
    from ..navigation import Job
    from ..standing import Standing
    from .controls import Controls
    from .descent import Craft


class Pilots:
    """One for each drone, as it were: they know the way, and what is permitted."""

    def __init__(
        self, kernel: Kernel, controls: Controls, drones: Sequence[Craft], airspace: Airspace
    ) -> None:
        self._kernel, self._controls, self._airspace = kernel, controls, airspace
        self._drones = {drone.id: drone for drone in drones}
        self._jobs: dict[str, Task[None]] = {}
        """The jobs under way, by the drones' ids."""
        self._rescues: dict[str, Task[bool]] = {}
        """The latest rescue of each drone."""
        self._cut: dict[str, None] = {}
        """The drones whose motors were cut: nothing is asked of them until they are mended."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._controls.telemetry(drone)

    # Jobs

    def fly(self, job: Job, report: Callable[[object], None]) -> None:
        """Take off, fly to the job's stops and do its action; then report."""
        name = f"{job.drone} flies {job.id}"
        self._jobs[job.drone] = self._kernel.spawn(
            self._done(job, report), self._key(job.drone), name
        )

    async def _done(self, job: Job, report: Callable[[object], None]) -> None:
        try:
            result = await self._flown(job)
        except FlightFailed as error:
            result = motors_cut(job.drone) if job.drone in self._cut else error
        del self._jobs[job.drone]
        report(result)

    async def _flown(self, job: Job) -> object:
        controls, airspace, drone = self._controls, self._airspace, job.drone
        self._refuse_if_cut(drone)
        self._check(job)
        telemetry = controls.telemetry(drone)
        category = self._drones[drone].category
        seconds = flight_seconds(category, airspace, telemetry.location, job.stops, job.seconds)
        controls.begins(drone, job, seconds)
        await controls.takeoff(drone, airspace.cruise_height)
        for stop in job.stops:
            for point in permitted_way(airspace, drone, telemetry.location, stop):
                await controls.go_to(drone, point)
        if job.action is None:
            return None
        job.begins()
        return await controls.act(drone, job.action, job.parameters, job.item, job.id)

    def _check(self, job: Job) -> None:
        """Refuse what the hardware cannot do, before it takes off."""
        if job.action is not None:
            why = self._controls.why_not(job.drone, job.action, job.parameters)
            if why is not None:
                raise FlightFailed(Failure.REFUSED, why)

    # Commands

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, and hover."""
        for task in (self._jobs.pop(drone, None), self._rescues.pop(drone, None)):
            if task is not None:
                task.cancel()
        if drone not in self._cut:
            self._controls.break_off(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        self._refuse_if_cut(drone)
        await self._controls.hold(drone)

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height; does nothing for a drone that flies."""
        self._refuse_if_cut(drone)
        self._controls.begins(drone, None, 0.0)
        await self._controls.takeoff(drone, height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        self._refuse_if_cut(drone)
        await self._controls.go_to(drone, target)

    async def land(self, drone: str) -> None:
        """Land here."""
        self._refuse_if_cut(drone)
        await self._controls.land(drone)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name."""
        return await self._controls.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name."""
        await self._controls.write(drone, name, value)

    async def cut_motors(self, drone: str) -> None:
        """Switch a drone's motors off now, wherever it is; it is lost then."""
        self._cut[drone] = None
        try:
            await self._controls.cut(drone)
        except FlightFailed:  # it cannot be told: if it can later on, it shall come home
            del self._cut[drone]
            raise

    def _refuse_if_cut(self, drone: str) -> None:
        """Let no motor turn again before a person has looked after the drone."""
        if drone in self._cut:
            raise motors_cut(drone)

    async def roll_call(self, drone: str) -> Standing:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        return await self._controls.roll_call(drone)

    # After a failure

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked again."""
        self._cut.pop(drone, None)
        self._controls.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it is lost.

        Whoever meets it there takes off what it still carries.
        """
        rescue = self._kernel.spawn(
            self._rescue(drone), self._key(drone), f"{drone} is brought home"
        )
        self._rescues[drone] = rescue
        try:
            await rescue.ended()
        finally:
            rescue.cancel()
        if isinstance(rescue.error, Cancelled):
            raise FlightFailed(Failure.REFUSED, f"{drone} was told to break it off")
        return rescue.result()

    async def _rescue(self, drone: str) -> bool:
        controls = self._controls
        if drone in self._cut or not await controls.reach(drone):
            return False
        if not await self._flies_home(drone) and not await controls.fetched(drone):
            return False
        controls.unload(drone)
        return True

    async def _flies_home(self, drone: str) -> bool:
        """Fly home, or land where no way leads there."""
        controls, (x, y, _) = self._controls, self._drones[drone].home
        telemetry = controls.telemetry(drone)
        try:
            controls.begins(drone, None, 0.0)
            if telemetry.landed and docked(telemetry.location, (x, y, 0.0)):
                return True
            await controls.takeoff(drone, self._airspace.cruise_height)
            here = telemetry.location
            way = self._airspace.route(here, (x, y, here[2]))
            for point in way or ():
                await controls.go_to(drone, point)
            await controls.land(drone)
        except FlightFailed:
            return False
        return way is not None

    def _key(self, drone: str) -> int:
        return FLEET + 1 + self._drones[drone].index
