"""The gateway: all commands of the brain pass through it, and may outlive the brain.

A brain commands through a `Link`. When another brain connects, or the brain's heartbeat is missing, the
old link is cut: its commands are ignored, and it gets no reports.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from ..drones.lag import Lag
from ..drones.real_fleet import RealDrone
from ..jobs.controls import FleetDrone
from ..jobs.reports import Down, DroneReport, FleetReport
from ..shared.domain.errors import BadInput, Cancelled, Failure, FlightFailed
from ..shared.time.future import Future
from ..shared.time.kernel import FLEET, EventKind, Kernel, Task
from ..simulation.body import SimulatedDrone
from .descent import Descent
from .envelope import Envelope
from .executor import Executor, Leaving
from .jobs import Jobs
from .measuring import MeasuringControls
from .settings import joining_of
from .traffic.traffic import Traffic

if TYPE_CHECKING:
    from ..jobs.controls import Controls
    from ..jobs.flown import Flown
    from ..jobs.job import Job, Report
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point
    from .ledger import Ledger


T = TypeVar("T")

Rehearse = Callable[[str, str, "str | None"], Coroutine[Any, Any, str]]
TakeIn = Callable[[SimulatedDrone, RealDrone | None], object]


LOOKS = 6
"""How often it is looked, in the time that a brain may be silent, whether it is."""


class Busy(RuntimeError):
    """A drone was given a second command at once: a bug of the brain, not a failed flight."""

    @property
    def as_failure(self) -> FlightFailed:
        """Return it as a failure, for a brain in another process."""
        return FlightFailed(Failure.REFUSED, str(self))


class Link:
    """The `Navigation` of a brain, served by the gateway until the link is cut.

    After a cut no command ever returns: a caller must not mistake a lost link for a failed flight.
    The same holds from `bring_down` until `fleet_report`.
    """

    def __init__(self, gateway: Gateway, lost: Callable[[], object] | None) -> None:
        self._gateway, self._navigation, self._lost = gateway, gateway.navigation, lost
        self.flown: Callable[[Flown], object] | None = None
        """Called with each command that a drone has flown, while this link is in command."""
        self._line = gateway.line
        self._is_heard = gateway.descent is None
        self._under_way: dict[str, None] = {}
        """The commands in progress, by drone."""

    # The navigation protocol

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry, which is always current."""
        return self._navigation.telemetry[drone]

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command now."""
        return self._gateway.moves(drone)

    def fly(self, job: Job, report: Report) -> None:
        """Give a drone its job. A job that was done already is reported again, and not flown."""
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
        """Return a sensor or variable of a drone, also while it flies."""
        return await self._asked(self._navigation.read(drone, name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone, also while it flies."""
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
        """Take off to a height."""
        self._gateway.envelope.check_height(height)
        await self._command(drone, self._navigation.takeoff(drone, height))

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        self._gateway.envelope.check(target)
        await self._command(drone, self._navigation.go_to(drone, target))

    async def join(self, joining: Mapping[str, Any]) -> str:
        """Take a drone into the fleet; return why that cannot be, or nothing."""
        if not self._gateway.is_commanded_by(self):
            await _for_ever()
        return self._gateway.join(joining)

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a simulated drone; return why it cannot, or nothing."""
        if not self._gateway.is_commanded_by(self):
            await _for_ever()
        why = await self._gateway.mishap(drone, kind, job)
        if not self._is_heard:
            await _for_ever()
        return why

    async def home(self, drone: str) -> None:
        """Fly to its dock, and land there."""
        await self._command(drone, self._navigation.home(drone))

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._command(drone, self._navigation.land(drone))

    def mended(self, drone: str) -> None:
        """Called when a lost drone has been repaired: it can be recovered again."""
        if self._is_heard:
            self._navigation.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return await self._command(drone, self._gateway.recover(drone))

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        report = await self._gateway.ask(drone)
        if not self._is_heard:
            await _for_ever()
        return report

    async def _command(
        self, drone: str, command: Coroutine[Any, Any, T], *, stays: bool = False
    ) -> T:
        """Run a command, and return when it is done; never, once the link is cut."""
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

    # Beyond the navigation protocol

    async def fleet_report(self) -> FleetReport:
        """Query all drones and the ledger; from now on this link is in command.

        If the drones are being brought down, that is completed first.
        """
        gateway = self._gateway
        while gateway.descent is not None:
            await gateway.descent.ended()
        fleet_report = await gateway.fleet_report()
        if not gateway.is_commanded_by(self):
            await _for_ever()
        self._is_heard = True
        return fleet_report

    def attach(self, id: str, report: Report) -> None:
        """Register for the report of an earlier job: called when it ends, or now if it has."""
        if self._is_heard:
            if id in self._gateway.jobs.beside:
                self._gateway.flown(self._gateway.jobs.beside[id])
            self._gateway.jobs.attach(id, report if self._line is None else self._line(report))

    def forget(self, id: str) -> None:
        """Forget a job: its id may be used again."""
        if self._is_heard:
            self._gateway.jobs.forget(id)

    def on_flown(self, hear: Callable[[Flown], object]) -> None:
        """Call this with each command that a drone has flown."""
        self.flown = hear

    def heartbeat(self) -> None:
        """Signal that the brain is alive."""
        if self._gateway.is_commanded_by(self):
            self._gateway.heard = self._gateway.kernel.now

    async def bring_down(self, how: Down) -> None:
        """Abort everything and bring all drones down; return when all that can have landed.

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

    # Called by the gateway

    def cut(self) -> None:
        """Ignore it from now on, and notify its brain."""
        self._is_heard = False
        for drone in list(self._under_way):
            self._navigation.break_off(drone)
        if self._lost is not None:
            kernel = self._gateway.kernel
            kernel.schedule(kernel.now, EventKind.FLIGHT, FLEET, self._lost)


def _take_in_none(drone: SimulatedDrone, _: RealDrone | None) -> NoReturn:
    raise BadInput(f"{drone.id} cannot join: these drones are all that there are")


async def _for_ever() -> NoReturn:
    """Never return."""
    await Future[None]()
    raise AssertionError


class Gateway:
    """All drones of one fleet, and the jobs that they were given.

    Without a ledger, finished jobs are forgotten. Without `patience`,
    a silent brain is no reason to land. `measures`: the brain in command is told how long each
    command took.
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
        measures: bool = False,
    ) -> None:
        self.kernel = kernel
        self.take_in: TakeIn = _take_in_none
        """Gives a drone that joins to the controls; raises `BadInput` if they cannot have it."""
        self.rehearse: Rehearse | None = None
        """Has mishaps happen to simulated drones; None: they are real."""
        self._measuring: MeasuringControls | None = None
        if measures:
            self._measuring = MeasuringControls(kernel, controls, drones, self.flown)
            controls = self._measuring
        self.traffic: Traffic | None = None
        """Keeps drones apart, if configured."""
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
            kernel, controls, drones, airspace, self.traffic, ledger, leaving, self._acts_beside
        )
        self.envelope = Envelope(airspace)
        self.drones, self._airspace = tuple(drones), airspace
        self._keys = {drone.id: FLEET + 1 + drone.index for drone in drones}
        self.jobs = Jobs(kernel, self.navigation.fly, self._keys, self.envelope, ledger)
        self.commander: Link | None = None
        """The link in command."""
        self.line: Callable[[Report], Report] | None = None
        """Wraps the listeners of reports, to simulate a lossy line to the brain."""
        self._epoch = 0
        self.descent: Task[None] | None = None
        """The task that brings all drones down, if any."""
        self._how = Down.LAND
        self._over = False
        self.heard = kernel.now
        """When the brain was heard of last."""
        self.patience = inf if patience is None else patience
        """Seconds of its own time without its brain, after which all drones land."""
        self._lag = Lag()
        if patience is not None:
            self._watch()

    # The link in command

    def link(self, epoch: int, lost: Callable[[], object] | None = None) -> Link:
        """Put a brain in command, instead of the one before.

        `lost` is called, once, when this link is cut in turn.
        """
        if epoch < self._epoch:
            raise BadInput("another run of this app has taken over the drones meanwhile")
        self.cut()
        self._epoch, self.heard = epoch, self.kernel.now
        self.commander = link = Link(self, lost)
        return link

    def cut(self) -> None:
        """Cut the link of the brain. Jobs go on; the brain's single commands are aborted."""
        link, self.commander = self.commander, None
        if link is not None:
            self.jobs.mute()
            link.cut()

    def is_commanded_by(self, link: Link) -> bool:
        """Return whether this link is in command."""
        return link is self.commander

    def _acts_beside(self, told: Flown) -> None:
        """Tell where an action is done beside its target, now and to each brain that asks for the job."""
        self.jobs.beside[str(told["flight"])] = told
        self.flown(told)

    def flown(self, command: Flown) -> None:
        """Tell the brain in command, if there is one, how a command went."""
        if self.commander is not None and self.commander.flown is not None:
            self.commander.flown(command)

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command now, as far as that is measured."""
        return self._measuring is not None and drone in self._measuring.moving

    def join(self, joining: Mapping[str, Any]) -> str:
        """Take a drone in, unless it is there already; return why that cannot be, or nothing."""
        try:
            drone, real = joining_of(joining)
            if drone.id in self._keys:
                return ""
            self.take_in(drone, real)
        except BadInput as error:
            return str(error)
        except (KeyError, TypeError, ValueError) as error:
            return f"that is no drone: {type(error).__name__}: {error}"
        self.drones = (*self.drones, drone)
        self._keys[drone.id] = FLEET + 1 + drone.index  # its jobs have the same mapping
        self.jobs.boots[drone.id] = 0
        for part in (self.navigation, self.traffic, self._measuring):
            if part is not None:
                part.join(drone)
        return ""

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a simulated drone; return why it cannot, or nothing."""
        if self.rehearse is None:
            return "mishaps happen to simulated drones only"
        why = await self.rehearse(drone, kind, job)
        if not why and job is not None:
            self.break_off(drone)  # what has been done is not reported
        return why

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self.jobs.break_off(drone)
        self.navigation.break_off(drone)

    # Without a brain

    @property
    def flies(self) -> bool:
        """Whether any drone is in the air."""
        return any(not known.landed for known in self.navigation.telemetry.values())

    def _watch(self) -> None:
        """Land everything when the brain was silent for too long while it could be heard; look again."""
        if self._over:
            return
        now = self.kernel.now
        self._lag.called(now, now)
        due = self.heard + self._lag.since(self.heard, now) + self.patience
        if now >= due:
            due = now + self.patience
            if self.descent is None and self.flies:
                self.fail_safe(Down.LAND)
        self._lag.due = min(due, now + self.patience / LOOKS)
        self.kernel.schedule(self._lag.due, EventKind.CLOCK, FLEET, self._watch)

    def fail_safe(self, how: Down) -> Task[None]:
        """Bring all drones down without the brain, which is cut off."""
        self.cut()
        return self.bring_down(how)

    def crash(self) -> None:
        """End like a killed process: the drones hover, and the memory is gone."""
        self._over = True
        self.jobs.leave()
        if self.descent is not None:
            self.descent.cancel()
        self.cut()
        for drone in self.drones:
            self.navigation.break_off(drone.id)

    async def cut_motors(self, drone: str) -> str:
        """Switch a drone's motors off now, with or without a brain; return why if it cannot be reached."""
        try:
            await self.navigation.cut_motors(drone)
        except FlightFailed as error:
            return str(error)
        return ""

    # All drones

    async def fleet_report(self) -> FleetReport:
        """Query every drone, and settle the outcome of every job by that."""
        spawn = self.kernel.spawn
        asked = [
            spawn(self.ask(drone), key, f"{drone} is asked") for drone, key in self._keys.items()
        ]
        drones = {drone: await task for drone, task in zip(self._keys, asked, strict=True)}
        return FleetReport(drones=drones, jobs=self.jobs.settle(drones, self._epoch > 1))

    async def ask(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; its next jobs are known by its boot."""
        report = await self.navigation.drone_report(drone)
        if report.reached:
            self.jobs.boots[drone] = report.boot
        return report

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight; it may have been restarted meanwhile."""
        found = await self.navigation.recover(drone)
        if found:
            await self.ask(drone)
        return found

    def bring_down(self, how: Down) -> Task[None]:
        """Abort everything, and bring all drones down; the task ends when they have landed."""
        descent = self.descent
        if descent is not None:
            if self._how is Down.LAND or how is Down.HOME:
                return descent  # it is at least as fast
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
