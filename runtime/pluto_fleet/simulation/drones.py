"""A simulated team of drones, on any kernel, in virtual or real time."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

from ..jobs.controls import Act, Cut, GoTo, Hold, Land, Read, TakeOff, Write
from ..jobs.reports import motors_cut
from ..shared.alone.world import CARRYING_HOME, Faults, draw
from ..shared.domain.actions import BUILT_IN, Plain
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.text import place
from ..shared.time.kernel import EventKind, Future, Kernel
from .body import SimulatedBody, Told

if TYPE_CHECKING:
    from ..jobs.controls import Command, FleetDrone
    from ..jobs.reports import DroneReport
    from ..jobs.telemetry import Telemetry
    from ..shared.alone.world import World
    from ..shared.domain.model import Item, Point


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
        world: World,
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
        self._forgotten: dict[str | None, Future[None]] = {}
        """By jobs, what to set when their actions were done and forgotten."""

    def join(self, drone: FleetDrone, _: object = None) -> None:
        """Have one more drone, in its dock."""
        body = SimulatedBody(drone, self._world, self._kernel.time)
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
        """Stop what a drone does, and hover."""
        body = self.bodies[drone]
        if body.over is not None:
            body.halt()
            self._interrupt(body, broken_off(drone))

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone cannot do a built-in action: simulated ones can do all."""
        return None if action in BUILT_IN else f"{drone} has no action {action}"

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        """Begin a flight: draw its faults."""
        body = self.bodies[drone]
        if flight is None:
            body.begin(None)
        else:
            body.begin(flight, draw(self._faults, self._seed, flight, seconds))

    def do(self, drone: str, command: Command) -> Coroutine[Any, Any, Any]:
        """Return what carries out a command."""
        return CARRIES_OUT[type(command)](self, drone, *command)

    async def _take_off(self, drone: str, height: float) -> None:
        """Take off to a height; one that flies stays where it is."""
        body = self.bodies[drone]
        body.check()
        if body.landed:
            x, y, _ = body.place
            await self._until(body, body.follow([(x, y, height)]), "to take off")

    async def _go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        body = self._in_the_air(drone)
        await self._until(body, body.follow([body.place, target]), f"to fly to {place(target)}")

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

    async def _hold(self, drone: str) -> None:
        """Hover until a fault occurs or it is cancelled."""
        body = self._in_the_air(drone)
        body.can_act("the action")
        await self._until(body, inf, "to hover")

    async def _read(self, drone: str, name: str) -> float:
        """Return the value that was written under this name, or else what is measured here."""
        return self._in_the_air(drone).read(name)

    async def _write(self, drone: str, name: str, value: float) -> None:
        """Store a value under this name."""
        self._in_the_air(drone).settings[name] = value

    async def _cut(self, drone: str) -> None:
        """Switch its motors off: it falls, if it flies and can be reached, and stays off."""
        cut = motors_cut(drone)
        body = self.bodies[drone]
        if not self.strike(drone, cut.failure, str(cut)) and not body.landed:
            body.check()

    def mended(self, drone: str) -> None:
        """A person has repaired it, put it into its dock and switched it on."""
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
        """Wait until a drone was carried home."""
        body = self.bodies[drone]
        await self._busy(body, self._kernel.now + CARRYING_HOME, "to recover")
        body.dock()
        return True

    def unload(self, drone: str) -> None:
        """Take off what it carries: a person meets it in its dock."""
        self.bodies[drone].unload()

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
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


_MISHAPS = {"lost": Failure.LINK, "crash": Failure.CRASH, "battery": Failure.BATTERY}


CARRIES_OUT: dict[type[Command], Callable[..., Coroutine[Any, Any, Any]]] = {
    TakeOff: SimulatedNavigation._take_off,
    GoTo: SimulatedNavigation._go_to,
    Land: SimulatedNavigation._land,
    Hold: SimulatedNavigation._hold,
    Act: SimulatedNavigation._act,
    Read: SimulatedNavigation._read,
    Write: SimulatedNavigation._write,
    Cut: SimulatedNavigation._cut,
}


def broken_off(drone: str) -> FlightFailed:
    return FlightFailed(Failure.REFUSED, f"{drone} was told to break it off")
