"""Between the brain and its drones: every command passes here, and may outlive the brain that gave it.

A brain commands through a `Link`. When another brain links, or the brain's heartbeat stays away, the
old link is cut: it commands nothing any more, and hears nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from plutoc_runtime.domain.errors import BadInput, Cancelled, Failure, FlightFailed
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET, EventKind, Kernel, Task

from ..jobs.controls import FleetDrone
from ..jobs.reports import Down, DroneReport, FleetReport
from .descent import Descent
from .envelope import Envelope
from .executor import Executor, Leaving
from .jobs import Jobs
from .traffic.traffic import Traffic

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point, Telemetry

    from ..jobs.controls import Controls
    from ..jobs.job import Job, Report
    from .ledger import Ledger


T = TypeVar("T")


class Busy(RuntimeError):
    """A drone was told to do a second thing at once: a mistake of the brain, not of a flight."""

    @property
    def as_failure(self) -> FlightFailed:
        """The same for a brain in another process."""
        return FlightFailed(Failure.REFUSED, str(self))


class Link:
    """A `Navigation` that the gateway answers: none of it is heard once the link is cut.

    After a cut no command ever returns: a caller must not mistake a lost link for a failed flight.
    The same holds from `bring_down` until `fleet_report`.
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
        """Stop what a drone does, and hover."""
        if self._is_heard:
            self._gateway.break_off(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._command(drone, self._navigation.hold(drone), stays=True)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name, also while it flies."""
        return await self._asked(self._navigation.read(drone, name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name, also while it flies."""
        await self._asked(self._navigation.write(drone, name, value))

    async def _asked(self, question: Coroutine[Any, Any, T]) -> T:
        """Ask a drone; there is no answer once the link is cut."""
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

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        standing = await self._navigation.drone_report(drone)
        if not self._is_heard:
            await _for_ever()
        return standing

    async def _command(
        self, drone: str, command: Coroutine[Any, Any, T], *, stays: bool = False
    ) -> T:
        """Let a drone do something, and return when it has; never, once the link is cut."""
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
            return await self._asked(command)
        finally:
            self._under_way.pop(drone, None)

    # What only the gateway does

    async def fleet_report(self) -> FleetReport:
        """Ask all drones and the ledger how everything stands; from now on the link is heard.

        If the drones are being brought down, that is seen through first.
        """
        gateway = self._gateway
        while gateway.descent is not None:
            await gateway.descent.ended()
        roll = await gateway.fleet_report()
        if not gateway.is_commanded_by(self):
            await _for_ever()
        self._is_heard = True
        return roll

    def attach(self, id: str, report: Report) -> None:
        """Hear of a job that was given before: when it ends, or now if it has."""
        if self._is_heard:
            self._gateway.jobs.attach(id, report if self._line is None else self._line(report))

    def forget(self, id: str) -> None:
        """Forget a job: its id may be given again."""
        if self._is_heard:
            self._gateway.jobs.forget(id)

    def heartbeat(self) -> None:
        """Say that the brain is alive."""
        if self._gateway.is_commanded_by(self):
            self._gateway.heard = self._gateway.kernel.now

    async def bring_down(self, how: Down) -> None:
        """Break off everything and bring all drones down; return when all that can are down.

        This goes on even if the brain ends.
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
            kernel.schedule(kernel.now, EventKind.FLIGHT, FLEET, self._lost)


async def _for_ever() -> NoReturn:
    """Wait for what never happens."""
    await Future[None]()
    raise AssertionError


class Gateway:
    """All drones of one fleet, and the jobs that they were given.

    Without a ledger what is over is forgotten. Without patience
    nothing is landed because the brain is silent.
    """

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[FleetDrone],
        airspace: Airspace,
        *,
        ledger: Ledger | None = None,
        apart: float = 0.5,
        slack: float = 0.0,
        max_airborne: int | None = None,
        patience: float | None = None,
        leaving: Leaving | None = None,
    ) -> None:
        self.kernel = kernel
        self.traffic: Traffic | None = None
        """Keeps drones apart from each other, if anybody wants that."""
        if apart > 0:
            self.traffic = Traffic(
                kernel,
                controls,
                drones,
                airspace,
                apart=apart,
                slack=slack,
                max_airborne=max_airborne,
            )
        self.navigation = Executor(
            kernel, controls, drones, airspace, self.traffic, ledger, leaving
        )
        self.envelope = Envelope(airspace)
        self.drones, self._airspace = tuple(drones), airspace
        self._keys = {drone.id: FLEET + 1 + drone.index for drone in drones}
        self.jobs = Jobs(kernel, self.navigation.fly, self._keys, self.envelope, ledger)
        self.commander: Link | None = None
        """The link through which the drones are commanded now."""
        self.line: Callable[[Report], Report] | None = None
        """What lies between a brain and its reports in a simulation: it wraps their listener."""
        self._epoch = 0
        self.descent: Task[None] | None = None
        """Brings all drones down, while that is so."""
        self._how = Down.LAND
        self._over = False
        self.heard = kernel.now
        """When the brain was heard of last."""
        if patience is not None:
            self._watch(patience)

    # Who commands

    def link(self, epoch: int, lost: Callable[[], object] | None = None) -> Link:
        """Let a brain command; the one before does not any more.

        `lost` is told, once, when this link is cut in turn.
        """
        if epoch < self._epoch:
            raise BadInput("another run of this app has taken over the drones meanwhile")
        self.cut()
        self._epoch, self.heard = epoch, self.kernel.now
        self.commander = link = Link(self, lost)
        return link

    def cut(self) -> None:
        """Let no brain command. Jobs go on; what else the drones do for the brain is broken off."""
        link, self.commander = self.commander, None
        if link is not None:
            self.jobs.mute()
            link.cut()

    def is_commanded_by(self, link: Link) -> bool:
        """Say whether this is the link through which the drones are commanded."""
        return link is self.commander

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self.jobs.break_off(drone)
        self.navigation.break_off(drone)

    # Without a brain

    @property
    def flies(self) -> bool:
        """Whether any drone is in the air."""
        return any(not known.landed for known in self.navigation.telemetry.values())

    def _watch(self, patience: float) -> None:
        """Land everything when nothing was heard for too long; look again when that may be so."""
        if self._over:
            return
        due = self.heard + patience
        if self.kernel.now >= due:
            due = self.kernel.now + patience
            if self.descent is None and self.flies:
                self.fail_safe(Down.LAND)
        self.kernel.schedule(due, EventKind.CLOCK, FLEET, partial(self._watch, patience))

    def fail_safe(self, how: Down) -> Task[None]:
        """Bring all drones down without the brain, which is cut off."""
        self.cut()
        return self.bring_down(how)

    def crash(self) -> None:
        """End as a process that is killed: the drones hover, and what is in memory is gone."""
        self._over = True
        self.jobs.leave()
        if self.descent is not None:
            self.descent.cancel()
        self.cut()
        for drone in self.drones:
            self.navigation.break_off(drone.id)

    async def cut_motors(self, drone: str) -> str:
        """Switch a drone's motors off now, with or without a brain; say why if it cannot be told."""
        try:
            await self.navigation.cut_motors(drone)
        except FlightFailed as error:
            return str(error)
        return ""

    # All drones

    async def fleet_report(self) -> FleetReport:
        """Ask every drone how it stands, and settle by that what has become of every job."""
        spawn = self.kernel.spawn
        asked = [
            spawn(self._ask(drone), key, f"{drone} is asked") for drone, key in self._keys.items()
        ]
        drones = {drone: await task for drone, task in zip(self._keys, asked, strict=True)}
        return FleetReport(drones=drones, jobs=self.jobs.settle(drones, self._epoch > 1))

    async def _ask(self, drone: str) -> DroneReport:
        standing = await self.navigation.drone_report(drone)
        if standing.reached:
            self.jobs.boots[drone] = standing.boot
        return standing

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight; it may have been switched off for that."""
        found = await self.navigation.recover(drone)
        if found:
            await self._ask(drone)
        return found

    def bring_down(self, how: Down) -> Task[None]:
        """Break off everything, and bring all drones down; the task is over when they are."""
        descent = self.descent
        if descent is not None:
            if self._how is Down.LAND or how is Down.HOME:
                return descent  # they come down no later than that
            descent.cancel()
        for drone in self.drones:
            self.break_off(drone.id)
        ways = Descent(self.kernel, self.navigation, self.drones, self._airspace, self.traffic)
        self._how = how
        self.descent = task = self.kernel.spawn(ways.down(how), FLEET, "all drones come down")
        task.over = self._is_down
        return task

    def _is_down(self, task: Task[None]) -> None:
        if self.descent is task:
            self.descent = None
        if task.error is not None and not isinstance(task.error, Cancelled):
            self.kernel.crash(task.error)
