"""One drone of the team: its state, its commands one after the other, and why it takes none.

Real drones cannot report what they carry: that is stored in a file beside their ledger.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from ..jobs.controls import FleetDrone, GoTo
from ..process.whole_file import write_whole
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.motion import CLIMB_SPEED
from ..shared.domain.text import place
from ..shared.fleet.reach import docked
from .protocol import CaredFor, DroneNavigation, Readable
from .telemetry import EMPTY, VehicleTelemetry
from .timeouts import NavigationCalls, shortened

T = TypeVar("T")

_CANNOT_HOVER = frozenset({Failure.LINK, Failure.CRASH})
"""Failures after which a drone cannot be commanded to hover."""


class CommandQueue:
    """The commands of one drone."""

    def __init__(self, hold: Callable[[], Coroutine[Any, Any, None]]) -> None:
        self._hold = hold
        self._turn = asyncio.Lock()
        self._over: asyncio.Future[None] | None = None
        """Fails when the command in progress is aborted."""
        self._brake: asyncio.Task[None] | None = None
        self.doing = ""
        """The command in progress."""

    async def run(self, doing: str, work: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """Run a command after all earlier ones; raise `FlightFailed` as soon as it is aborted.

        When it is cancelled, aborted or fails, the drone is left hovering.
        """
        async with self._turn:
            await self._braked()
            over = self._over = asyncio.get_running_loop().create_future()
            self.doing = doing
            task = asyncio.ensure_future(work())
            task.add_done_callback(_heard)
            try:
                await asyncio.wait((task, over), return_when=asyncio.FIRST_COMPLETED)
                if over.done():
                    over.result()
                return task.result()
            except FlightFailed as error:
                self._stop(task, error.failure not in _CANNOT_HOVER)
                raise
            except asyncio.CancelledError:
                self._stop(task, True)
                raise
            finally:
                over.cancel()
                self._over = None
                self.doing = ""

    def fail(self, error: FlightFailed) -> None:
        """Abort the command in progress, if any: it raises this."""
        if self._over is not None and not self._over.done():
            self._over.set_exception(error)

    @property
    def brakes(self) -> bool:
        """Whether it was told to hover, and does not yet."""
        return self._brake is not None and not self._brake.done()

    def release(self) -> None:
        """Stop waiting until it hovers."""
        if self._brake is not None:
            self._brake.cancel()

    def _stop(self, task: asyncio.Task[Any], holds: bool) -> None:
        task.cancel()  # here, as one that is sent on at this instant lets the brake not even begin
        self._brake = asyncio.ensure_future(self._braking(task, holds))

    async def _braking(self, task: asyncio.Task[Any], holds: bool) -> None:
        """End the last command in a hover before the next one begins."""
        await asyncio.wait((task,))
        if holds:
            await self._hold()

    async def _braked(self) -> None:
        """Wait until it hovers, or cannot; that goes on when this is cancelled."""
        brake = self._brake
        if brake is not None:
            await asyncio.wait((brake,))
            if self._brake is brake:
                self._brake = None
            with suppress(asyncio.CancelledError, FlightFailed):
                brake.result()


def _heard(task: asyncio.Task[Any]) -> None:
    """Retrieve the exception: the caller has been told already."""
    if not task.cancelled():
        task.exception()


NAME = "aboard.json"


class Cargo:
    """The names of the items aboard, by drone, stored in a file."""

    def __init__(self, folder: Path, say: Callable[[str], object]) -> None:
        self._file, self._say = folder / NAME, say
        self._aboard: dict[str, str] = {}
        with suppress(OSError, ValueError):
            known = json.loads(self._file.read_text(encoding="utf-8"))
            if isinstance(known, dict):
                self._aboard = {str(drone): str(item) for drone, item in known.items()}

    def of(self, drone: str) -> str | None:
        return self._aboard.get(drone)

    def carries(self, drone: str, item: str | None) -> None:
        """Store the item aboard a drone; None: it has none."""
        if self._aboard.get(drone) == item:
            return
        if item is None:
            del self._aboard[drone]
        else:
            self._aboard[drone] = item
        try:
            write_whole(self._file, json.dumps(self._aboard), durable=True)
        except OSError as error:
            self._say(f"{self._file} cannot be written: {error}")


LAND, RISE = "land", "take off"
"""The names of its commands to land and to take off."""
PREFLIGHT = 12.0
HOLD = 8.0
RECOVER = 8.0
SET = 20.0
"""Time-outs in seconds."""
LOOK = 0.05
"""The polling interval of its telemetry, in seconds."""
CLIMB_LIMIT = 2 * CLIMB_SPEED
"""Metres per second, up and down, at most: the mean is about what plans count with."""
TIME_FACTOR, TIME_MARGIN = 3.0, 10.0
"""The time-out of a flight: a multiple of its duration at full speed, plus a margin in seconds."""
SLOWEST_PLANNED = 1.0
"""The speed that time-outs assume at most: a drone may be slower than its category."""
MOST_REASONS = 20
"""The most reasons of one preflight that are used."""
STALE = 0.5
"""Seconds of silence that confirm a navigation's report of a lost link."""
RECENTLY = 3.0
"""Seconds after being seen in the air within which a crash counts as a fall from the air."""


class Vehicle:
    """A drone flown by its navigation, in asyncio's loop."""

    def __init__(
        self,
        drone: FleetDrone,
        navigation: DroneNavigation,
        cargo: Cargo,
        say: Callable[[str], object],
        clock: Callable[[], float],
        parameters: Mapping[str, float] | None = None,
    ) -> None:
        """`parameters`: what it is set to when it is connected to."""
        self.drone = drone
        self.id = drone.id
        self.navigation = navigation
        self.parameters = parameters or {}
        self.position_problem: Callable[[], str | None] = lambda: None
        """Returns why it has no position from its localization, if it needs one."""
        self.missing_actions: Callable[[], tuple[str, ...]] = tuple
        """Returns the actions that the plan needs, and its hardware cannot do."""
        self.cargo, self.calls = cargo, NavigationCalls(drone.id, say, clock)
        self.telemetry = VehicleTelemetry(
            drone.home, drone.category.endurance, lambda: self.navigation.telemetry, self.calls
        )
        self.commands = CommandQueue(self.hover)
        self.turned: asyncio.Future[GoTo] | None = None
        """Set when it is sent elsewhere on its way to a point; None: it is on no such way."""
        self.linked = False
        self.on_lost: Callable[[], object] = lambda: None
        """Called when its link is lost."""
        self.out_of_reach = f"{drone.id} has not been reached yet"
        """Why it is not linked, if it is not."""
        self.unset: tuple[str, ...] = ()
        """Why its parameters are not what they are to be: it does not take off."""
        self.boot = 0
        """How often it was found to have restarted."""
        self.down: FlightFailed | None = None
        """Why it takes no commands although it is linked, if it takes none."""
        self.needs_person = False
        """Whether only a person can end that, by putting it home."""
        self.looked_after = False
        """Whether it was repaired, and has not been notified yet."""
        self.is_cut = False
        """Whether its motors are being cut, or were: nothing may turn them on again."""
        self.must_land = False
        """Whether it is to be landed as soon as possible."""
        self.position_lost = False
        """Whether it is landed because it lost its position: it must not fly elsewhere."""
        self.speed = drone.category.speed
        motion = drone.category.motion
        self.climb = min(max(CLIMB_LIMIT, motion.up, motion.down), self.speed)
        self._motion = motion

    def climbs(self, height: float) -> float:
        """Return the seconds of a take-off to a height, for its time-out."""
        motion = self._motion
        return height / self.climb if motion.smooth else motion.climb(height, self.speed)

    @property
    def sinks(self) -> float:
        """The seconds of a landing from where it is, for its time-out."""
        height = max(0.0, self.telemetry.location[2])
        motion = self._motion
        return height / self.climb if motion.smooth else motion.sink(height, self.speed)

    # Its state

    @property
    def is_docked(self) -> bool:
        return self.telemetry.landed and docked(self.telemetry.location, self.drone.home)

    @property
    def has_crashed(self) -> bool:
        """Whether it takes no commands because it fell."""
        return self.down is not None and self.down.failure is Failure.CRASH

    @property
    def flew_lately(self) -> bool:
        """Whether it flies, or did so a moment ago."""
        return not self.telemetry.landed or self.calls.clock() - self.telemetry.flew < RECENTLY

    def check(self) -> None:
        """Raise the reason why it takes no commands, if it takes none."""
        if self.down is not None:
            raise FlightFailed(self.down.failure, str(self.down))
        if not self.linked:
            raise FlightFailed(Failure.LINK, self.out_of_reach)

    def lost(self, why: str) -> None:
        """Mark its link as lost, and fail its command."""
        if not self.linked:
            return
        telemetry, now = self.telemetry, self.calls.clock()
        self.linked = False
        self.out_of_reach = f"{self.id} lost its link at {place(telemetry.location)}: {why}"
        self.calls.say(self.out_of_reach)
        self.on_lost()
        if now < telemetry.rises_until:  # it was about to take off, and may have done so
            telemetry.rises_until = now + EMPTY * self.drone.category.endurance
        self.commands.fail(FlightFailed(Failure.LINK, self.out_of_reach))

    def crashed(self, why: str) -> None:
        """Mark it as crashed: it needs a person."""
        self.must_land = False
        self.refuse(FlightFailed(Failure.CRASH, why))

    def force_landing(self, why: FlightFailed, *, needs_person: bool = True) -> None:
        """Abort its command, and land it."""
        self.must_land = True
        self.refuse(why, needs_person=needs_person)

    def lose_position(self, why: str) -> None:
        """Mark its position as lost: it must do no action, and lands."""
        self.position_lost = True
        if self.must_land:
            return
        reason = f"{self.id} does not know where it is, and lands: {why}"
        self.force_landing(FlightFailed(Failure.LINK, reason), needs_person=False)

    def refuse(self, why: FlightFailed, *, needs_person: bool = False) -> None:
        """Refuse all commands from now on, and fail the current one."""
        self.calls.say(str(why))
        self.down, self.needs_person = why, needs_person
        if not (self.must_land and self.commands.doing == LAND):
            self.commands.fail(why)

    def clear_failure(self) -> None:
        """Accept commands again."""
        self.down, self.needs_person = None, False
        self.must_land = self.is_cut = self.position_lost = False

    async def report_care(self) -> bool:
        """Notify it of its repair, if needed; return False if that failed.

        Not while it flies: a later failure has not been repaired.
        """
        if not (self.looked_after and self.linked):
            return True
        self.looked_after = False
        if self.telemetry.landed and isinstance(self.navigation, CaredFor):
            try:
                await self.calls.call("recover", RECOVER, self.navigation.looked_after)
            except FlightFailed as error:
                self.calls.say(str(error))
                self.looked_after = error.failure is Failure.LINK  # it may not have received it
                return self.looked_after
        return True

    async def preflight(self) -> tuple[str, ...]:
        """Return why it may not take off now."""
        try:
            reasons = await self.calls.call(
                "answer its preflight", PREFLIGHT, self.navigation.preflight
            )
        except FlightFailed as error:
            return (str(error),)
        one = (reasons,) if isinstance(reasons, str) else reasons
        told = self.calls.ask(
            "preflight", lambda: tuple(shortened(str(why)) for why in one)[:MOST_REASONS], None
        )
        if told is None:
            told = ("its preflight gave no list of reasons",)
        told = (*self.unset, *told)
        blind = self.position_problem()
        return told if blind is None else (*told, blind)

    async def set_up(self) -> None:
        """Set its parameters, on the ground; raise `FlightFailed` if its link is lost over that."""
        navigation = self.navigation
        unset = list[str]()
        if not isinstance(navigation, Readable) or navigation.telemetry.flying:
            return  # in the air it has them since it was connected to first
        for name, value in self.parameters.items():
            try:
                await self.calls.call(f"set {name}", SET, navigation.write, name, value)
            except FlightFailed as error:
                if error.failure is Failure.LINK:
                    raise
                unset.append(str(error))
        self.unset = tuple(unset)

    def turn(self, command: GoTo) -> bool:
        """Send it elsewhere if it is on its way to a point; return whether it is."""
        turned = self.turned
        if turned is None or turned.done() or not self.linked or self.down is not None:
            return False
        turned.set_result(command)
        return True

    def break_off(self) -> None:
        """Abort its command, and hover; one that must land continues."""
        if not self.must_land:
            why = f"{self.id} was told to break it off"
            self.commands.fail(FlightFailed(Failure.REFUSED, why))

    # Implementation

    async def does(
        self, doing: str, command: Callable[..., Coroutine[Any, Any, T]], *facts: object
    ) -> T:
        """Carry out a command of `commands.py`, after all earlier ones of this drone."""
        return await self.commands.run(doing, partial(command, self, *facts))

    async def go(
        self, what: str, seconds: float, method: Callable[..., Awaitable[T]], *args: object
    ) -> T:
        """Run a command of this duration at full speed with a time-out, and return its result."""
        try:
            return await self.calls.call(what, seconds * TIME_FACTOR + TIME_MARGIN, method, *args)
        except FlightFailed as error:
            self._hears(error)
            raise

    def _hears(self, error: FlightFailed) -> None:
        """Update the state by a failed command, which may be known before the telemetry shows it."""
        if error.failure is Failure.LINK and self.telemetry.silence > STALE:
            self.lost(str(error))
        elif error.failure is Failure.CRASH and self.flew_lately:
            self.crashed(str(error))
        elif error.failure is Failure.BATTERY and not self.telemetry.landed:
            self.force_landing(error)

    async def until(self, holds: Callable[[], bool], limit: float) -> bool:
        """Wait until its telemetry fulfils a condition; return whether it did so in time."""
        for _ in range(round(limit / LOOK)):
            if holds():
                return True
            await asyncio.sleep(LOOK)
        return holds()

    async def hover(self) -> None:
        """Hover after an aborted command; log it if that fails."""
        await self.calls.parted()
        if self.linked and not self.telemetry.landed and not self.is_cut:
            try:
                await self.calls.call("hover", HOLD, self.navigation.hold)
            except FlightFailed as error:
                self.calls.say(f"{self.id} was to hover: {error}")
