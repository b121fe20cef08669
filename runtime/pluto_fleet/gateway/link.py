"""What a brain commands its drones through, for as long as it is the one that does."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET, Kind

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point, Telemetry

    from ..jobs.job import Job
    from ..jobs.reports import Down, DroneReport, FleetReport
    from .gateway import Gateway
    from .job import Report

T = TypeVar("T")


class Busy(RuntimeError):
    """A drone was told to do a second thing at once: a mistake of the brain, not of a flight."""

    @property
    def as_failure(self) -> FlightFailed:
        """The same for a brain in another process."""
        return FlightFailed(Failure.REFUSED, str(self))


class Link:
    """A `Navigation` that the gateway answers: none of it is heard once the link is cut.

    Nothing is refused then, and no command ever returns: whoever gave it is about to be told that
    the link is lost, and must not take silence for a drone that failed. The same holds from
    `bring_down` until the roll is called.
    """

    def __init__(self, gateway: Gateway, lost: Callable[[], object] | None) -> None:
        self._gateway, self._navigation, self._lost = gateway, gateway.navigation, lost
        self._line = gateway.line
        self._is_heard = gateway.descent is None
        self._under_way: dict[str, None] = {}
        """The drones that do something for themselves."""

    # What every navigation does

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._navigation.telemetry[drone]

    def fly(self, job: Job, report: Report) -> None:
        """Give a drone its job. One that was done already is not flown, but reported once more."""
        if self._is_heard:
            if job.drone in self._under_way:
                raise Busy(f"{job.drone} was told to fly while it does something for itself")
            self._gateway.jobs.fly(job, report if self._line is None else self._line(report))

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, and hover."""
        if self._is_heard:
            self._gateway.break_off(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._command(drone, self._navigation.hold(drone), stays=True)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name, whatever else it does."""
        return await self._asked(self._navigation.read(drone, name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name, whatever else it does."""
        await self._asked(self._navigation.write(drone, name, value))

    async def _asked(self, question: Coroutine[Any, Any, T]) -> T:
        """Ask a drone beside what it does; there is no answer once nobody is heard."""
        if not self._is_heard:
            question.close()
            await _for_ever()
        try:
            answer = await question
        except FlightFailed:
            if self._is_heard:
                raise
            await _for_ever()
        return answer

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height."""
        self._gateway.envelope.check_height(height)
        await self._command(drone, self._navigation.takeoff(drone, height))

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        self._gateway.envelope.check(target)
        await self._command(drone, self._navigation.go_to(drone, target))

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._command(drone, self._navigation.land(drone))

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        if self._is_heard:
            self._navigation.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return await self._command(drone, self._gateway.recover(drone))

    async def roll_call(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        standing = await self._navigation.roll_call(drone)
        if not self._is_heard:
            await _for_ever()
        return standing

    async def _command(
        self, drone: str, command: Coroutine[Any, Any, T], *, stays: bool = False
    ) -> T:
        """Let a drone do something, and return when it has; never, once nobody is heard."""
        if not self._is_heard:
            command.close()
            await _for_ever()
        if drone in self._under_way or self._gateway.jobs.is_flown_by(drone):
            command.close()
            raise Busy(f"{drone} was told to do something while it does something else")
        self._under_way[drone] = None
        if not stays:
            self._gateway.jobs.moves_on(drone)
        try:
            result = await command
        except FlightFailed:
            if self._is_heard:
                raise
            await _for_ever()
        finally:
            self._under_way.pop(drone, None)
        return result

    # What only the gateway does

    async def call(self) -> FleetReport:
        """Ask all drones and the ledger how everything stands; from now on the link is heard.

        If the drones are being brought down, that is seen through first.
        """
        gateway = self._gateway
        while gateway.descent is not None:
            await gateway.descent.ended()
        roll = await gateway.call()
        if not gateway.is_commanded_by(self):
            await _for_ever()
        self._is_heard = True
        return roll

    def attach(self, id: str, report: Report) -> None:
        """Hear of a job that was given before: when it ends, or now if it has."""
        if self._is_heard:
            self._gateway.jobs.attach(id, report if self._line is None else self._line(report))

    def forget(self, id: str) -> None:
        """Nobody will ask for a job any more: its id may be given again."""
        if self._is_heard:
            self._gateway.jobs.forget(id)

    def heartbeat(self) -> None:
        """Say that the brain is alive."""
        if self._gateway.is_commanded_by(self):
            self._gateway.hear()

    async def bring_down(self, how: Down) -> None:
        """Break off everything and bring all drones down; return when all that can are down.

        This goes on whatever becomes of the brain.
        """
        gateway = self._gateway
        if not gateway.is_commanded_by(self):
            await _for_ever()
        self._is_heard = False
        gateway.bring_down(how)
        while gateway.descent is not None:
            await gateway.descent.ended()
        if not gateway.is_commanded_by(self):
            await _for_ever()

    # What the gateway does to it

    def cut(self) -> None:
        """Hear nothing of it any more, and say so."""
        self._is_heard = False
        for drone in list(self._under_way):
            self._navigation.break_off(drone)
        if self._lost is not None:
            kernel = self._gateway.kernel
            kernel.schedule(kernel.now, Kind.FLIGHT, FLEET, self._lost)


async def _for_ever() -> NoReturn:
    """Wait for what never happens."""
    await Future[None]()
    raise AssertionError
