"""One real drone of the team: what it can be told, and why it takes no commands when it takes none."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from math import dist, inf
from typing import TYPE_CHECKING, TypeVar

from ..actions import BUILT_IN, PICK, RELEASE, Plain
from ..energy import CLIMB_SPEED, docked
from ..errors import Failure, FlightFailed
from ..words import percent, place
from .calls import Calls, shortened
from .lane import Lane
from .outcome import outcome_of
from .protocol import Acts, Readable
from .seen import EMPTY, RISING, Seen

if TYPE_CHECKING:
    from ..model import Category, Item, Point
    from .cargo import Cargo
    from .protocol import DroneNavigation

T = TypeVar("T")

LAND, RISE = "land", "take off"
"""What it does while it lands, or rises."""
PREFLIGHT, HOLD, CUT, READ = 5.0, 5.0, 2.0, 5.0
"""Seconds that these may take."""
DOWN, LOOK = 3.0, 0.05
"""Seconds after a landing until a drone must have told that it flies no more; between two looks."""
CLIMB_LIMIT = 2 * CLIMB_SPEED
"""Metres per second, up and down, at most: the mean is about what plans count with."""
AMPLE, SPARE = 3.0, 10.0
"""A flight may take so many times what it takes at full speed, and so many seconds more."""
MANY = 20
"""Reasons of one preflight that are heard."""
STALE = 0.5
"""Seconds of silence that bear a navigation out which says that the link is lost."""
RECENTLY = 3.0
"""Seconds for which a drone that was seen in the air is believed to have fallen out of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TeamDrone:
    """A drone of the fleet, and what flies it."""

    id: str
    category: Category
    home: Point
    navigation: DroneNavigation


class Member:
    """A drone in the hands of its navigation. All of it happens in asyncio's loop."""

    def __init__(
        self,
        drone: TeamDrone,
        cargo: Cargo,
        say: Callable[[str], object],
        clock: Callable[[], float],
    ) -> None:
        self.drone, self.id, self.navigation = drone, drone.id, drone.navigation
        self.blind: Callable[[], str | None] = _seeing
        """Says why it does not know where it is, if somebody else must tell it and does not."""
        self.lacks: Callable[[], tuple[str, ...]] = tuple
        """Says what the plan asks for, and its hardware does not do."""
        self.cargo, self.calls = cargo, Calls(drone.id, say, clock)
        self.seen = Seen(
            drone.home,
            drone.category.flight_time,
            lambda: self.navigation.telemetry,
            self.calls,
        )
        self.lane = Lane(self._hover)
        self.linked = False
        self.on_lost: Callable[[], object] = _nobody
        """Told when its link is lost."""
        self.out_of_reach = f"{drone.id} has not been reached yet"
        """Why it is not linked, if it is not."""
        self.boot = 0
        """How often it was found switched off and on again."""
        self.down: FlightFailed | None = None
        """Why it takes no commands though it is linked, if it takes none."""
        self.needs_a_hand = False
        """Only somebody who has put it home ends that."""
        self.must_land = False
        """It comes down by itself, as soon as it can."""
        self.speed = drone.category.top_speed or drone.category.speed
        self.climb = min(CLIMB_LIMIT, self.speed)

    # How it is

    @property
    def is_docked(self) -> bool:
        """Whether it stands at home."""
        return self.seen.landed and docked(self.seen.location, self.drone.home)

    @property
    def flew_lately(self) -> bool:
        """Whether it flies, or did a moment ago."""
        return not self.seen.landed or self.calls.clock() - self.seen.flew < RECENTLY

    def check(self) -> None:
        """Raise why it takes no commands, if it takes none."""
        if self.down is not None:
            raise FlightFailed(self.down.failure, str(self.down))
        if not self.linked:
            raise FlightFailed(Failure.LINK, self.out_of_reach)

    def lost(self, why: str) -> None:
        """Its link is gone: what it does ends here, as far as anybody can tell."""
        if not self.linked:
            return
        seen, now = self.seen, self.calls.clock()
        self.linked = False
        self.out_of_reach = f"{self.id} lost its link at {place(seen.location)}: {why}"
        self.calls.say(self.out_of_reach)
        self.on_lost()
        if now < seen.rises_until:  # it was about to take off, and may have done so
            seen.rises_until = now + EMPTY * self.drone.category.flight_time
        self.lane.fail(FlightFailed(Failure.LINK, self.out_of_reach))

    def crashed(self, why: str) -> None:
        """It fell out of the air: somebody must look after it."""
        self.must_land = False
        self.refuse(FlightFailed(Failure.CRASH, why))

    def must_come_down(self, why: FlightFailed, *, needs_a_hand: bool = True) -> None:
        """It flies no further: from now on it comes down by itself."""
        self.must_land = True
        self.refuse(why, needs_a_hand=needs_a_hand)

    def refuse(self, why: FlightFailed, *, needs_a_hand: bool = False) -> None:
        """It takes no commands from now on; what it does ends here."""
        self.calls.say(str(why))
        self.down, self.needs_a_hand = why, needs_a_hand
        if not (self.must_land and self.lane.doing == LAND):
            self.lane.fail(why)

    def is_well(self) -> None:
        """It takes commands again."""
        self.down, self.needs_a_hand, self.must_land = None, False, False

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
            "preflight", lambda: tuple(shortened(str(why)) for why in one)[:MANY], None
        )
        if told is None:
            told = ("its preflight gave no list of reasons",)
        blind = self.blind()
        return told if blind is None else (*told, blind)

    # What it is told

    async def takeoff(self, height: float) -> None:
        """Rise straight up to a height; does nothing for a drone that flies."""
        await self.lane.run(RISE, lambda: self._take_off(height))

    async def _take_off(self, height: float) -> None:
        self.check()
        if not self.seen.landed:
            return
        reasons = await self.preflight()
        level, reserve = self.seen.battery_level, self.drone.category.reserve
        if level < reserve:
            left = f"{percent(level)} in its battery, and {percent(reserve)} are its reserve"
            reasons = (*reasons, left)
        if reasons:
            why = f"{self.id} is not ready: {'; '.join(reasons)}"
            raise FlightFailed(Failure.REFUSED, why)
        self.seen.rises_until = inf
        try:
            await self._go(
                "take off", height / self.climb, self.navigation.takeoff, height, self.climb
            )
        finally:
            if self.linked:  # until it says whether it flies: the command may have reached it
                self.seen.rises_until = self.calls.clock() + RISING

    async def go_to(self, target: Point) -> None:
        """Fly straight to a point."""
        await self.lane.run("fly", lambda: self._fly_to(target))

    async def _fly_to(self, target: Point) -> None:
        self.check()
        self._in_the_air()
        await self.fly(target)

    async def fly(self, target: Point) -> None:
        """Fly straight to a point, whatever it takes no commands for."""
        seconds = dist(self.seen.location, target) / self.speed
        what = f"arrive at {place(target)}"
        await self._go(what, seconds, self.navigation.go_to, target, self.speed)

    async def land(self) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        await self.lane.run(LAND, self.come_down)

    async def come_down(self) -> None:
        """Land here, whatever it takes no commands for, if only it is linked."""
        if self.seen.landed:
            return
        if not self.linked:
            self.check()
        seconds = max(0.0, self.seen.location[2]) / self.climb
        await self._go("land", seconds, self.navigation.land, self.climb)
        self.seen.rises_until = -inf
        for _ in range(round(DOWN / LOOK)):  # what it told last may be older than that
            if self.seen.landed:
                return
            await asyncio.sleep(LOOK)
        raise FlightFailed(Failure.ACTION, f"{self.id} was to land, and flies all the same")

    async def hold(self) -> None:
        """Hover, until it is told not to or something goes wrong."""
        await self.lane.run("hover", self._hold)

    async def _hold(self) -> None:
        self.check()
        self._in_the_air()
        await asyncio.get_running_loop().create_future()

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        """Do one of the built-in actions here."""
        return await self.lane.run(action, lambda: self._act(action, parameters, item))

    async def _act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        self.check()
        self._in_the_air()
        why = self.why_not(action, parameters)
        if why is not None or not isinstance(self.navigation, Acts):
            raise FlightFailed(Failure.REFUSED, why or f"{self.id} has no action {action}")
        given = parameters.get("seconds")
        seconds = given if isinstance(given, (int, float)) else BUILT_IN[action].seconds
        value = await self._go(
            action, seconds + SPARE, self.navigation.act, action, parameters, item
        )
        if action in (PICK, RELEASE):
            self.cargo.carries(self.id, item.name if action == PICK and item is not None else None)
        return outcome_of(self.id, action, value)

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why its hardware cannot do an action, or None."""
        navigation = self.navigation
        if action not in BUILT_IN or not isinstance(navigation, Acts):
            return f"{self.id} has no action {action}"
        believed: str | None = (
            f"the navigation of {self.id} cannot say whether it has the action {action}"
        )
        why = self.calls.ask("why_not", lambda: navigation.why_not(action, parameters), believed)
        return why if why is None else shortened(str(why))

    async def read(self, name: str) -> float:
        """Return what it measures under this name."""
        self.check()
        if not isinstance(self.navigation, Readable):
            raise FlightFailed(Failure.ACTION, f"{self.id} has nothing that can be read")
        value = await self.calls.call(f"read {name}", READ, self.navigation.read, name)
        try:
            return float(value)
        except (TypeError, ValueError) as error:
            raise self.calls.mistake("read", error) from error

    async def write(self, name: str, value: float) -> None:
        """Set what it has under this name."""
        self.check()
        if not isinstance(self.navigation, Readable):
            raise FlightFailed(Failure.ACTION, f"{self.id} has nothing that can be written")
        await self.calls.call(f"write {name}", READ, self.navigation.write, name, value)

    async def cut(self) -> None:
        """Switch its motors off, now: whatever it does ends so."""
        cut = FlightFailed(Failure.CRASH, f"{self.id}'s motors were cut")
        self.lane.release()
        await self.calls.call("switch its motors off", CUT, self.navigation.emergency_stop)
        self.must_land = False
        self.refuse(cut)

    def break_off(self) -> None:
        """Stop whatever it does, and hover; but who must land does."""
        if not self.must_land:
            why = f"{self.id} was told to break it off"
            self.lane.fail(FlightFailed(Failure.REFUSED, why))

    # How that is done

    async def _go(
        self, what: str, seconds: float, method: Callable[..., Awaitable[T]], *args: object
    ) -> T:
        try:
            return await self.calls.call(what, seconds * AMPLE + SPARE, method, *args)
        except FlightFailed as error:
            self._hears(error)
            raise

    def _hears(self, error: FlightFailed) -> None:
        """Believe what a failed command says of the drone: that may be known before it is seen."""
        if error.failure is Failure.LINK and self.seen.silence > STALE:
            self.lost(str(error))
        elif error.failure is Failure.CRASH and self.flew_lately:
            self.crashed(str(error))
        elif error.failure is Failure.BATTERY and not self.seen.landed:
            self.must_come_down(error)

    def _in_the_air(self) -> None:
        if self.seen.landed:
            where = place(self.seen.location)
            reason = f"{self.id} is on the ground at {where}: it must take off first"
            raise FlightFailed(Failure.REFUSED, reason)

    async def _hover(self) -> None:
        """Hover after whatever was broken off; where it cannot, the log says why."""
        await self.calls.parted()
        if self.linked and not self.seen.landed:
            try:
                await self.calls.call("hover", HOLD, self.navigation.hold)
            except FlightFailed as error:
                self.calls.say(f"{self.id} was to hover: {error}")


def _nobody() -> None:
    """Nobody is told."""


def _seeing() -> None:
    """It knows where it is by itself."""
