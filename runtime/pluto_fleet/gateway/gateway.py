"""The gateway: all orders of the brain pass through it, and may outlive the brain.

A brain commands through a `Line`. When another brain connects, or the brain's heartbeat is missing, the
old line is cut: its orders are ignored, and it is told nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any, NoReturn

from ..drones.real_fleet import RealDrone
from ..drones.timeouts import Lag
from ..jobs.controls import FleetDrone, Read, See, Trigger, Write
from ..jobs.link import Link
from ..jobs.reports import (
    Down,
    DroneReport,
    FleetReport,
    drone_report_data,
    fleet_report_data,
    result_data,
)
from ..shared.domain.errors import BadInput, Cancelled, FlightFailed
from ..shared.hooks.plain_data import point_of, value_data
from ..shared.time.kernel import FLEET, EventKind, Kernel, Task
from .descent import Descent
from .executor import Executor, Leaving
from .jobs import Jobs
from .settings import joining_of
from .traffic.traffic import Traffic

if TYPE_CHECKING:
    from ..jobs.controls import Controls
    from ..jobs.flown import Flown
    from ..jobs.link import Message, Order
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point
    from .jobs import Report
    from .ledger import Ledger


Rehearse = Callable[[str, str, "str | None"], Coroutine[Any, Any, str]]
TakeIn = Callable[[FleetDrone, RealDrone | None], object]
Answered = Callable[["Gateway", "Order"], Coroutine[Any, Any, object]]


TRACKED = 0.5
"""Seconds from one look at what moves to the next."""
LOOKS = 6
"""How often it is looked, in the time that a brain may be silent, whether it is."""


class Busy(RuntimeError):
    """A drone was given a second order at once: a bug of the brain, not a failed flight."""


class Line(Link):
    """A brain's link inside the gateway's process: the one place that obeys its orders, until it is cut.

    After a cut nothing is told any more: a caller must not mistake a lost line for a failed flight.
    The same holds from `down` until `call`.
    """

    def __init__(self, gateway: Gateway, lost: Callable[[], object] | None) -> None:
        super().__init__()
        self.gateway = gateway
        self._lost = lost
        self._is_heard = gateway.descent is None
        self.under_way: dict[object, Task[Any]] = {}
        """The orders that are answered when they are done, by their ids."""
        self._busy: dict[str, Order] = {}
        """Those that drones carry out, by drone."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry, which is always current."""
        return self.gateway.executor.telemetry[drone]

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command now."""
        return self.gateway.executor.moves(drone)

    def send(self, order: Order) -> None:
        """Obey an order, unless another brain is obeyed; raise `Busy` if its drone does something else."""
        do = order["do"]
        gateway = self.gateway
        if gateway.is_commanded_by(self):
            gateway.heard = gateway.kernel.now
        if not self._is_obeyed(do):
            return
        gateway.look_at_tracks()
        if do in _AT_ONCE:
            _AT_ONCE[do](self, order)
        else:
            self._begin(order, _ANSWERED[do])

    def _is_obeyed(self, do: str) -> bool:
        return self._is_heard or (do in _ALWAYS and self.gateway.is_commanded_by(self))

    def fly(self, order: Order) -> None:
        """Give a drone its job; one that was done already is reported again, and not flown."""
        drone = order["drone"]
        if drone in self._busy:
            raise Busy(f"{drone} was told to fly while it does something for itself")
        self.gateway.jobs.fly(order, partial(self._reported, order["id"]))

    def attach(self, order: Order) -> None:
        """Register for the report of an earlier job."""
        self.gateway.attach(order["flight"], partial(self._reported, order["id"]))

    def cancel(self, order: Order) -> None:
        """Call off what was begun; it needs no answer any more."""
        task = self.under_way.get(order["order"])
        if task is not None:
            task.cancel()

    def _begin(self, order: Order, answered: Answered) -> None:
        """Begin what is answered when it is done."""
        do = order["do"]
        drone = order.get("drone", "")
        gateway = self.gateway
        if do == "go" and self._goes_on(order):
            return
        if do in _ONE_AT_A_TIME:
            self._replace_what_waits(drone)
            if drone in self._busy or gateway.jobs.is_flown_by(drone):
                raise Busy(f"{drone} was told to do something while it does something else")
            self._busy[drone] = order
            if do != "hold":
                gateway.jobs.moves_on(drone)
        if do == "down":
            self._is_heard = False
        key = gateway.keys.get(drone, FLEET)
        task = gateway.kernel.spawn(answered(gateway, order), key, f"{drone} is told to {do}")
        self.under_way[order["id"]] = task
        task.over = partial(self._ended, order)

    def _goes_on(self, order: Order) -> bool:
        """Send a drone elsewhere that goes somewhere: it answers this order, and not the one before."""
        drone = order["drone"]
        before = self._busy.get(drone)
        if before is None or before["do"] != "go":
            return False
        if not self.gateway.executor.turn(drone, *_way_of(order)):
            return False
        self._busy[drone] = order
        self.under_way[order["id"]] = task = self.under_way.pop(before["id"])
        task.over = partial(self._ended, order)
        return True

    def _replace_what_waits(self, drone: str) -> None:
        """Call off that a drone hovers, or goes somewhere, for an order that comes in its place."""
        order = self._busy.get(drone)
        if order is not None and order["do"] in _WAITS:
            self.cancel({"order": order["id"]})

    def _ended(self, order: Order, task: Task[Any]) -> None:
        do = order["do"]
        number = order["id"]
        error = task.error
        del self.under_way[number]
        if do in _ONE_AT_A_TIME:
            self._busy.pop(order["drone"], None)
        if do == "call" and error is None and self.gateway.is_commanded_by(self):
            self._is_heard = True
        if error is None:
            self._tell(do, {"done": number, "value": task.result()})
        elif isinstance(error, FlightFailed):
            self._tell(do, {"failed": number, **result_data(error)})
        elif not isinstance(error, Cancelled):
            self.gateway.kernel.crash(error)

    def _tell(self, do: str, message: Message) -> None:
        if self._is_obeyed(do):
            self.take(message)

    def _reported(self, number: int, result: object) -> None:
        """Tell what came of a job."""
        said = "failed" if isinstance(result, FlightFailed) else "done"
        if self._is_heard:
            self.take({said: number, **result_data(result)})

    def leave(self) -> None:
        """Handle the end of its connection: jobs go on, all else is called off."""
        self._call_off()
        if self.gateway.is_commanded_by(self):
            self.gateway.cut()

    def call_off_commands(self) -> None:
        """Call off what single drones were told to do: one that has not begun yet begins no more."""
        for order in list(self._busy.values()):
            self.cancel({"order": order["id"]})

    def _call_off(self) -> None:
        for task in list(self.under_way.values()):
            task.cancel()

    def cut(self) -> None:
        """Obey it no more, and notify its brain."""
        self._is_heard = False
        for drone in list(self._busy):
            self.gateway.executor.break_off(drone)
        self._call_off()
        if self._lost is not None:
            kernel = self.gateway.kernel
            kernel.at(kernel.now, EventKind.FLIGHT, FLEET, self._lost)


def _take_in_none(drone: FleetDrone, _: RealDrone | None) -> NoReturn:
    raise BadInput(f"{drone.id} cannot join: these drones are all that there are")


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
        self.controls = controls
        self.take_in: TakeIn = _take_in_none
        """Gives a drone that joins to the controls; raises `BadInput` if they cannot have it."""
        self.rehearse: Rehearse | None = None
        """Has mishaps happen to simulated drones; None: they are real."""
        self.tracker: Callable[[], Mapping[str, Any]] | None = None
        """Says where things are that move; None: none is tracked."""
        self._looks = False
        """Whether it is looked at them."""
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
        self.executor = Executor(
            kernel,
            controls,
            drones,
            airspace,
            self.traffic,
            ledger,
            leaving,
            self._acts_beside,
            self.flown if measures else None,
        )
        self.executor.arrived = self._arrives
        self.drones, self._airspace = tuple(drones), airspace
        self.keys = {drone.id: FLEET + 1 + drone.index for drone in drones}
        """The keys of their events in the kernel."""
        self.jobs = Jobs(kernel, self.executor.fly, self.keys, airspace, ledger)
        self.commander: Line | None = None
        """The line of the brain in command."""
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

    def link(self, epoch: int, lost: Callable[[], object] | None = None) -> Line:
        """Put a brain in command, instead of the one before.

        `lost` is called, once, when this line is cut in turn.
        """
        if epoch < self._epoch:
            raise BadInput("another run of this app has taken over the drones meanwhile")
        self.cut()
        self._epoch, self.heard = epoch, self.kernel.now
        self.commander = line = Line(self, lost)
        return line

    def cut(self) -> None:
        """Cut the line of the brain. Jobs go on; the brain's single commands are aborted."""
        line = self.commander
        self.commander = None
        if line is not None:
            self.jobs.mute()
            line.cut()

    def is_commanded_by(self, line: Line) -> bool:
        """Return whether this line is in command."""
        return line is self.commander

    def _acts_beside(self, told: Flown) -> None:
        """Tell where an action is done beside its target, now and to each brain that asks for the job."""
        self.jobs.beside[str(told["flight"])] = told
        self.flown(told)

    def flown(self, command: Flown) -> None:
        """Tell the brain in command, if there is one, how a command went."""
        if self.commander is not None:
            self.commander.take({"flown": command})

    def _arrives(self, flight: str) -> None:
        """Tell the brain in command, if there is one, that a flight is at the end of its last leg."""
        if self.commander is not None:
            self.commander.take({"arrived": flight})

    def look_at_tracks(self) -> None:
        """Tell the brain again and again where what moves is, as long as any drone flies."""
        if self.tracker is not None and not self._looks:
            self._looks = True
            self._look()

    def _look(self) -> None:
        kernel = self.kernel
        if self.tracker is not None and self.commander is not None:
            tell = partial(self.commander.take, {"tracks": self.tracker()})
            kernel.at(kernel.now, EventKind.FLIGHT, FLEET, tell)
        self._looks = self.flies or self.executor.is_busy
        if self._looks:
            kernel.at(kernel.now + TRACKED, EventKind.FLIGHT, FLEET, self._look)

    def join(self, joining: Mapping[str, Any]) -> str:
        """Take a drone in, unless it is there already; return why that cannot be, or nothing."""
        try:
            told = joining_of(joining)
            drone = told.drone
            if drone.id in self.keys:
                return ""
            self.take_in(drone, told.real)
        except BadInput as error:
            return str(error)
        except ValueError as error:
            return f"that is no drone: {error}"
        self.drones = (*self.drones, drone)
        self.keys[drone.id] = FLEET + 1 + drone.index  # its jobs have the same mapping
        self.jobs.boots[drone.id] = 0
        self.executor.join(drone)
        if self.traffic is not None:
            self.traffic.join(drone)
        return ""

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a simulated drone; return why it cannot, or nothing."""
        if self.rehearse is None:
            return "mishaps happen to simulated drones only"
        why = await self.rehearse(drone, kind, job)
        if not why and job is not None:
            self.break_off(drone)  # what has been done is not reported
        return why

    def attach(self, id: str, report: Report) -> None:
        """Register for the report of an earlier job: called when it ends, or now if it has."""
        if id in self.jobs.beside:
            self.flown(self.jobs.beside[id])
        self.jobs.attach(id, report)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self.jobs.break_off(drone)
        self.executor.break_off(drone)

    # Without a brain

    @property
    def flies(self) -> bool:
        """Whether any drone is in the air."""
        return any(not known.landed for known in self.executor.telemetry.values())

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
        self.kernel.at(self._lag.due, EventKind.CLOCK, FLEET, self._watch)

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
            self.executor.break_off(drone.id)

    async def cut_motors(self, drone: str) -> str:
        """Switch a drone's motors off now, with or without a brain; return why if it cannot be reached."""
        try:
            await self.executor.cut_motors(drone)
        except FlightFailed as error:
            return str(error)
        return ""

    # All drones

    async def fleet_report(self) -> FleetReport:
        """Query every drone, and settle the outcome of every job by that."""
        spawn = self.kernel.spawn
        asked = [
            spawn(self.ask(drone), key, f"{drone} is asked") for drone, key in self.keys.items()
        ]
        drones = {drone: await task for drone, task in zip(self.keys, asked, strict=True)}
        return FleetReport(drones=drones, jobs=self.jobs.settle(drones, self._epoch > 1))

    async def ask(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; its next jobs are known by its boot."""
        report = await self.executor.drone_report(drone)
        if report.reached:
            self.jobs.boots[drone] = report.boot
        return report

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight; it may have been restarted meanwhile."""
        found = await self.executor.recover(drone)
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
        if self.commander is not None:
            self.commander.call_off_commands()
        for drone in self.drones:
            self.break_off(drone.id)
        ways = Descent(self.kernel, self.executor, self.drones, self._airspace, self.traffic)
        self._how = how
        self.descent = task = self.kernel.spawn(ways.down(how), FLEET, "all drones come down")
        task.over = self._is_down
        return task

    def _is_down(self, task: Task[None]) -> None:
        if self.descent is task:
            self.descent = None
        if task.error is not None and not isinstance(task.error, Cancelled):
            self.kernel.crash(task.error)


def _way_of(order: Order) -> tuple[list[Point], float]:
    """Return where an order leads, and how long it may take its time for that, at least."""
    return [*map(point_of, order["stops"])], order["seconds"]


async def _read(gateway: Gateway, order: Order) -> object:
    return value_data(await gateway.controls.do(order["drone"], Read(order["name"])))


async def _write(gateway: Gateway, order: Order) -> None:
    await gateway.controls.do(order["drone"], Write(order["name"], order["value"]))


async def _trigger(gateway: Gateway, order: Order) -> object:
    trigger = Trigger(order["action"], order["parameters"])
    return value_data(await gateway.controls.do(order["drone"], trigger))


async def _see(gateway: Gateway, order: Order) -> object:
    seen = await gateway.controls.do(order["drone"], See())
    return [[one.track, one.kind, [*one.at]] for one in seen]


async def _recover(gateway: Gateway, order: Order) -> bool | str:
    """Bring a drone home; if it is lost, return what it says of that itself."""
    if await gateway.recover(order["drone"]):
        return True
    return "; ".join((await gateway.ask(order["drone"])).problems)


async def _report(gateway: Gateway, order: Order) -> object:
    return drone_report_data(await gateway.ask(order["drone"]))


async def _call(gateway: Gateway, _: Order) -> object:
    """Query all; if the drones are being brought down, that is completed first."""
    while gateway.descent is not None:
        await gateway.descent.ended()
    return fleet_report_data(await gateway.fleet_report())


async def _join(gateway: Gateway, order: Order) -> str:
    return gateway.join(order["joining"])


async def _down(gateway: Gateway, order: Order) -> None:
    """Bring all down, which goes on even if the brain ends."""
    gateway.bring_down(Down(order["how"]))
    while gateway.descent is not None:
        await gateway.descent.ended()


# How each order is obeyed

_AT_ONCE: Mapping[str, Callable[[Line, Order], object]] = {
    "fly": Line.fly,
    "attach": Line.attach,
    "cancel": Line.cancel,
    "heartbeat": lambda line, order: None,
    "break_off": lambda line, order: line.gateway.break_off(order["drone"]),
    "redirect": lambda line, order: line.gateway.executor.turn(order["drone"], *_way_of(order)[:1]),
    "mended": lambda line, order: line.gateway.executor.mended(order["drone"]),
    "forget": lambda line, order: line.gateway.jobs.forget(order["flight"]),
}
_ANSWERED: Mapping[str, Answered] = {
    "hold": lambda gateway, order: gateway.executor.hold(order["drone"]),
    "go": lambda gateway, order: gateway.executor.go(order["drone"], *_way_of(order)),
    "act": _trigger,
    "sees": _see,
    "home": lambda gateway, order: gateway.executor.home(order["drone"]),
    "land": lambda gateway, order: gateway.executor.land(order["drone"]),
    "recover": _recover,
    "read": _read,
    "write": _write,
    "report": _report,
    "call": _call,
    "join": _join,
    "mishap": lambda gateway, order: gateway.mishap(order["drone"], order["kind"], order["job"]),
    "down": _down,
}
"""What is answered when it is done."""
_ONE_AT_A_TIME = frozenset({"hold", "go", "home", "land", "recover"})
"""What a drone does only while it does nothing else."""
_WAITS = frozenset({"hold", "go"})
"""In whose place another of those may come."""
_ALWAYS = frozenset({"call", "join", "mishap", "down", "cancel"})
"""What is also obeyed while all drones are brought down."""
