"""A simulated team of drones, on any kernel, in virtual or real time: each obeys a gateway, command by command."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from typing import Any, cast

from ..jobs.controls import (
    Act,
    Command,
    Cut,
    FleetDrone,
    GoTo,
    Hold,
    Land,
    Read,
    See,
    TakeOff,
    Trigger,
    Write,
)
from ..jobs.reports import DroneReport, motors_cut
from ..jobs.telemetry import Telemetry
from ..shared.alone.drones import Body
from ..shared.alone.world import CARRYING_HOME, Faults, draw
from ..shared.domain.actions import BUILT_IN, Plain
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.model import Item, Point
from ..shared.domain.motion import varies
from ..shared.domain.text import place
from ..shared.domain.trace import Clock
from ..shared.events.world import MovingWorld
from ..shared.fleet.telemetry import Charge, Leg
from ..shared.hooks.plain_data import item_data, item_of, point_of
from ..shared.time.kernel import FLEET, EventKind, Future, Kernel, Key
from ..shared.time.told import VirtualTime


@dataclass(frozen=True, slots=True)
class _Clock:
    """The time of a real-time kernel, which goes on between its events."""

    time: Callable[[], float]

    @property
    def now(self) -> float:
        return self.time()


HEIGHTS = 0.025
"""Metres by which heights vary, from way to way: their standard deviation, where durations vary, too."""


class SimulatedBody(Body):
    """A drone by a kernel's clock."""

    def __init__(self, drone: FleetDrone, world: MovingWorld, kernel: Kernel) -> None:
        self.on_change: Callable[[], object] = lambda: None
        """Called when its state has changed other than by time."""
        is_virtual = isinstance(kernel, VirtualTime)  # time stands still between its events
        clock = kernel if is_virtual else cast("Clock", _Clock(kernel.time))
        super().__init__(drone.id, drone.home, drone.category, world, clock)
        self.above = 0.0
        """How much higher than it is it says that it is."""
        self.key: Key = FLEET + 1 + drone.index
        self.command = ""
        """The command in progress, one at a time."""
        self.over: Future[None] | None = None
        """Set when the command is done, if it takes time; fails if it is aborted."""
        self.cut_short = FlightFailed(Failure.REFUSED, "it was broken off")
        """Why the last command was cut short."""
        self.boot = 0
        """How often it was restarted."""
        self.done: dict[str, object] = {}
        """The jobs whose action it did, with their results."""

    @property
    def place(self) -> Point:
        self.settle()
        return self.location

    @property
    def battery_level(self) -> float:
        self.settle()
        return super().battery_level

    @property
    def landed(self) -> bool:
        self.settle()
        return self._landed

    @property
    def report(self) -> DroneReport:
        """Return its report; one that takes no commands does not answer."""
        return DroneReport(
            drone=self.id,
            reached=self.down is None,
            location=self.place,
            landed=self.landed,
            battery_level=self.battery_level,
            boot=self.boot,
            carrying=None if self.carries is None else self.carries.name,
            done=dict(self.done),
            problems=() if self.down is None else (str(self.down),),
        )

    # Commands

    def follow(self, way: Sequence[Point], *, lands: bool = False) -> float:
        """Set out on a way; return when the drone will be at rest at its end."""
        if self.motion.spread:
            x, y, _ = way[-1]
            self.above = varies(HEIGHTS, f"{self._flight}/{x:.2f}/{y:.2f}/height") - 1.0
        return super().follow(way, lands=lands)

    def turn(self, legs: list[Leg], now: float, *, lands_at: float = inf) -> None:
        """Fly other legs from now on; it has landed at that time."""
        super().turn(legs, now, lands_at=lands_at)
        self.on_change()

    def dock(self) -> None:
        """Stand in its dock, where someone has carried it, and take commands again."""
        if self.down is not None:
            self.reboot()
        super().dock()

    def reboot(self) -> None:
        """Restart it: it forgets what it has done."""
        self.boot = self.boot + 1
        self.done = {}
        self.settings = {}

    def unload(self) -> None:
        self.carries = None
        self.on_change()

    def befall(self, what: Failure, why: str | None = None) -> bool:
        """Cause a fault now; return False if it took no commands before."""
        self.settle()
        if self.down is not None:
            return False
        self._happen(self._clock.now, what)
        if why is not None:
            self.down = FlightFailed(what, why)
        return True

    # Saving and restoring

    @property
    def data(self) -> dict[str, object]:
        """Everything of it as plain data, but for what it has done; all times are its clock's."""
        leg = self._legs[0]
        charge = self._charge
        down = self.down
        return {
            "boot": self.boot,
            "carries": item_data(self.carries),
            "down": None if down is None else [down.failure.name, str(down)],
            "reachable_at": self.reachable_at,
            "flight": self._flight,
            "drawn": {what.name: after for what, after in self._drawn.items()},
            "began": self._began,
            "charge": [charge.level, charge.since, charge.rate],
            "leg": [leg.start, leg.end, leg.leaves, leg.arrives],
            "lands_at": self._lands_at,
            "landed": self._landed,
            "flown": self._flown,
        }

    def restore(self, data: Mapping[str, Any], shift: float = 0.0) -> None:
        """Be as it was by a clock that was so much behind.

        What it was told to do, it does to the end, and then it hovers.
        """
        self.boot = data["boot"]
        self.carries = item_of(data["carries"])
        self.down = None
        self.reachable_at = data["reachable_at"] + shift
        if data["down"] is not None:
            failure, reason = data["down"]
            self.down = FlightFailed(Failure[failure], reason)
        self._flight = data["flight"]
        self._drawn = {Failure[what]: after for what, after in data["drawn"].items()}
        self._began = data["began"] + shift
        level, since, rate = data["charge"]
        self._charge = Charge(level, since + shift, rate, self.motion.taper)
        start, end, leaves, arrives = data["leg"]
        leaves = leaves + shift
        arrives = arrives + shift
        self._legs = [Leg(point_of(start), point_of(end), leaves, arrives, self.motion.smooth)]
        self._lands_at = data["lands_at"] + shift
        self._landed = data["landed"]
        self._flown = data["flown"]
        self._look_ahead()


class Told:
    """The telemetry of a simulated drone, which is never silent."""

    silence = 0.0

    def __init__(self, body: SimulatedBody) -> None:
        self._body = body

    @property
    def location(self) -> Point:
        x, y, z = self._body.place
        return x, y, z + min(1.0, z) * self._body.above

    @property
    def battery_level(self) -> float:
        return self._body.battery_level

    @property
    def landed(self) -> bool:
        return self._body.landed


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldAction:
    """An action of a drone on the world, or an observation of it."""

    drone: str
    action: str
    item: Item | None
    job: str | None
    """The id of its job."""
    boot: int
    """The drone's."""
    value: object
    """Its result."""
    aboard: Item | None
    """The item aboard afterwards."""


class SimulatedNavigation:
    """Flies simulated drones in a simulated world, with randomly drawn faults."""

    def __init__(
        self,
        kernel: Kernel,
        drones: Sequence[FleetDrone],
        world: MovingWorld,
        faults: Faults,
        seed: int,
        record: Callable[[WorldAction], object] | None = None,
    ) -> None:
        self._kernel = kernel
        self._world = world
        self._faults, self._seed = faults, seed
        self.record = record
        """Called right before each action of a drone on the world."""
        self.bodies: dict[str, SimulatedBody] = {}
        self.telemetry: dict[str, Telemetry] = {}
        """The drones' telemetry, always current."""
        for drone in drones:
            self.join(drone)
        self._turned: dict[str, Point] = {}
        """By the drones' ids, where else those fly that were sent elsewhere on their way."""
        self._forgotten: dict[str | None, Future[None]] = {}
        """By jobs, what to set when their actions were done and forgotten."""

    def join(self, drone: FleetDrone, _: object = None) -> None:
        """Have one more drone, in its dock."""
        body = SimulatedBody(drone, self._world, self._kernel)
        self.bodies[drone.id] = body
        self.telemetry[drone.id] = Told(body)

    def down(self, drone: str) -> FlightFailed | None:
        """Return why a drone takes no commands; None: it takes them."""
        body = self.bodies[drone]
        body.settle()
        return body.down

    def carrying(self, drone: str) -> Item | None:
        """Return the item aboard a drone."""
        body = self.bodies[drone]
        body.settle()
        return body.carries

    def flown(self, drone: str) -> float:
        """Return how many metres a drone has flown, up and down included."""
        self.bodies[drone].settle()
        return self.bodies[drone].flown(self._kernel.now)

    def strike(self, drone: str, failure: Failure, why: str | None = None) -> bool:
        """Cause a crash, an empty battery or a lost link now; return False if it was down already."""
        body = self.bodies[drone]
        if not body.befall(failure, why):
            return False
        self._interrupt(body, FlightFailed(failure, str(body.down)))
        return True

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a drone in the air; return why it cannot, or nothing.

        A lost link, a crash and an empty battery happen now. Uncertain: this returns when the action
        of a job was done, and the drone has forgotten that; the job does not go on.
        """
        body = self.bodies[drone]
        if job is not None:
            forgotten = self._forgotten[job] = Future[None]()
            try:
                await forgotten
            finally:
                del self._forgotten[job]
            return ""
        body.settle()
        if body.landed:
            return f"{drone} stands on the ground: mishaps happen in the air"
        return "" if self.strike(drone, _MISHAPS[kind]) else f"{drone} is down already: {body.down}"

    def reboot(self, drone: str) -> None:
        """Restart a drone: it forgets what it has done, and sinks if it flies."""
        body = self.bodies[drone]
        if not body.landed:
            self.strike(drone, Failure.LINK)
        body.reboot()

    def _interrupt(self, body: SimulatedBody, why: FlightFailed) -> None:
        """End its command here with an error."""
        over = body.over
        if over is not None:
            body.over, body.command, body.cut_short = None, "", why
            over.fail(why)

    def break_off(self, drone: str) -> None:
        body = self.bodies[drone]
        if body.over is not None:
            body.halt()
            self._interrupt(body, broken_off(drone))

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        return None if action in BUILT_IN else f"{drone} has no action {action}"

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        """Begin a flight: draw its faults."""
        body = self.bodies[drone]
        if flight is None:
            body.begin(None)
        else:
            body.begin(flight, draw(self._faults, self._seed, flight, seconds))

    def do(self, drone: str, command: Command) -> Coroutine[Any, Any, Any]:
        return CARRIES_OUT[type(command)](self, drone, *command)

    async def _take_off(self, drone: str, height: float) -> None:
        """Take off to a height; one that flies stays where it is."""
        body = self.bodies[drone]
        body.check()
        if body.landed:
            x, y, _ = body.place
            await self._until(body, body.follow([(x, y, height)]), "to take off")

    async def _go_to(self, drone: str, target: Point, _: float) -> None:
        body = self._in_the_air(drone)
        self._turned.pop(drone, None)
        while True:
            when = body.follow([body.place, target])
            await self._until(body, when, f"{TO_FLY}{place(target)}")
            if drone not in self._turned:
                return
            target = self._turned.pop(drone)

    def turn(self, drone: str, command: GoTo) -> bool:
        body = self.bodies[drone]
        if body.over is None or not body.command.startswith(TO_FLY):
            return False
        self._turned[drone] = command.target
        body.over.set(None)
        return True

    async def _act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do a built-in action here, and return its result.

        The drone remembers that it was done for a job.
        """
        body = self._in_the_air(drone)
        if action not in BUILT_IN:
            raise FlightFailed(Failure.REFUSED, f"{drone} has no action {action}")
        await self._until(body, body.begin_action(action, item), f"to {action}")
        before = body.carries
        value = body.act(action, parameters, item)
        if self.record is not None:
            deed = WorldAction(
                drone=drone,
                action=action,
                item=item,
                job=job,
                boot=body.boot,
                value=value,
                aboard=body.carries,
            )
            try:
                self.record(deed)
            except FlightFailed:
                body.carries = before
                raise
        if job is not None:
            body.done[job] = value
        if job in self._forgotten:
            body.reboot()
            self._forgotten[job].set(None)
            await Future[None]()  # until it is broken off
        return value

    async def _trigger(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> object:
        """Do a built-in action at once, be it on its way or not."""
        return self._in_the_air(drone).act(action, parameters, None)

    async def _see(self, drone: str) -> object:
        """Return what moves in the view of its camera: nothing, on the ground."""
        body = self.bodies[drone]
        body.check()
        return () if body.landed else self._world.moving(body.location, self._kernel.now)

    def tracks(self) -> Mapping[str, object]:
        """Return where everything is now that moves in the world."""
        return self._world.tracks(self._kernel.now)

    async def _hold(self, drone: str) -> None:
        body = self._in_the_air(drone)
        body.can_act("the action")
        await self._until(body, inf, "to hover")

    async def _read(self, drone: str, name: str) -> float:
        """Return the value that was written under this name, or else what is measured here."""
        return self._in_the_air(drone).read(name)

    async def _write(self, drone: str, name: str, value: float) -> None:
        self._in_the_air(drone).settings[name] = value

    async def _cut(self, drone: str) -> None:
        """Switch its motors off: it falls, if it flies and can be reached, and stays off."""
        cut = motors_cut(drone)
        body = self.bodies[drone]
        if not self.strike(drone, cut.failure, str(cut)) and not body.landed:
            body.check()

    def mended(self, drone: str) -> None:
        body = self.bodies[drone]
        if body.down is not None:
            body.dock()

    async def _land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        body = self.bodies[drone]
        body.check()
        if not body.landed:
            await self._until(body, body.follow([body.place], lands=True), "to land")

    async def reach(self, drone: str) -> bool:
        """Wait until a drone that lost its link can be reached again; False: it has crashed."""
        body = self.bodies[drone]
        body.settle()
        await self._busy(body, body.reachable_at, "to recover")
        return body.answers()

    async def fetched(self, drone: str) -> bool:
        body = self.bodies[drone]
        await self._busy(body, self._kernel.now + CARRYING_HOME, "to recover")
        body.dock()
        return True

    def unload(self, drone: str) -> None:
        self.bodies[drone].unload()

    async def drone_report(self, drone: str) -> DroneReport:
        return self.bodies[drone].report

    async def _until(self, body: SimulatedBody, when: float, command: str) -> None:
        """Wait for the end of a command; a fault ends it earlier."""
        await self._busy(body, min(when, body.due), command)
        body.check()

    async def _busy(self, body: SimulatedBody, until: float, command: str) -> None:
        """Wait; a cancelled command leaves the drone hovering."""
        if body.command:
            raise RuntimeError(f"{body.id} was told {command} while told {body.command}")
        if until <= self._kernel.now:
            return
        over: Future[None] = Future()
        body.command, body.over = command, over
        timer = self._kernel.at(until, EventKind.FLIGHT, body.key, partial(over.set, None))
        try:
            await over
        except BaseException:  # cancelled
            if body.over is over:
                body.halt()
            raise
        finally:
            timer.cancel()
            is_its_own = body.over is over
            if is_its_own:
                body.command, body.over = "", None
        if not is_its_own:  # it was aborted at the instant at which it was done
            raise body.cut_short

    def _in_the_air(self, drone: str) -> SimulatedBody:
        body = self.bodies[drone]
        body.check()
        if body.landed:
            where = place(body.place)
            reason = f"{drone} is on the ground at {where}: it must take off first"
            raise FlightFailed(Failure.REFUSED, reason)
        return body


TO_FLY = "to fly to "
"""How the command to fly to a point begins."""
_MISHAPS = {"lost": Failure.LINK, "crash": Failure.CRASH, "battery": Failure.BATTERY}


CARRIES_OUT: dict[type[Command], Callable[..., Coroutine[Any, Any, Any]]] = {
    TakeOff: SimulatedNavigation._take_off,
    GoTo: SimulatedNavigation._go_to,
    Land: SimulatedNavigation._land,
    Hold: SimulatedNavigation._hold,
    Act: SimulatedNavigation._act,
    Trigger: SimulatedNavigation._trigger,
    See: SimulatedNavigation._see,
    Read: SimulatedNavigation._read,
    Write: SimulatedNavigation._write,
    Cut: SimulatedNavigation._cut,
}


def broken_off(drone: str) -> FlightFailed:
    return FlightFailed(Failure.REFUSED, f"{drone} was told to break it off")
