"""One drone of the team: what it can be told, and why it takes no commands when it takes none.

Real drones cannot tell what they carry: it is kept in a file beside their ledger.
"""

from __future__ import annotations

import asyncio
import json
import os
from collections.abc import Awaitable, Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import place
from plutoc_runtime.fleet.reach import CLIMB_SPEED, docked

from .command_queue import CommandQueue
from .protocol import CaredFor
from .telemetry import EMPTY, VehicleTelemetry
from .timeouts import NavigationCalls, shortened

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Category, Point

    from .protocol import DroneNavigation


NAME = "aboard.json"


class Cargo:
    """The names of the items aboard, by drone; they outlive the gateway."""

    def __init__(self, folder: Path, say: Callable[[str], object]) -> None:
        self._file, self._say = folder / NAME, say
        self._aboard: dict[str, str] = {}
        with suppress(OSError, ValueError):
            known = json.loads(self._file.read_text(encoding="utf-8"))
            if isinstance(known, dict):
                self._aboard = {str(drone): str(item) for drone, item in known.items()}

    def of(self, drone: str) -> str | None:
        """Return what a drone has aboard."""
        return self._aboard.get(drone)

    def carries(self, drone: str, item: str | None) -> None:
        """A drone has picked an item; None: it has none aboard any more."""
        if self._aboard.get(drone) == item:
            return
        if item is None:
            del self._aboard[drone]
        else:
            self._aboard[drone] = item
        part = self._file.with_name(f".{NAME}.part")
        try:
            with part.open("w", encoding="utf-8") as file:
                json.dump(self._aboard, file)
                file.flush()
                os.fsync(file.fileno())
            part.replace(self._file)
        except OSError as error:
            self._say(f"{self._file} cannot be written: {error}")


T = TypeVar("T")

LAND, RISE = "land", "take off"
"""What it does while it lands, or rises."""
PREFLIGHT, HOLD, RECOVER = 12.0, 8.0, 8.0
"""Seconds that these may take."""
LOOK = 0.05
"""Seconds between two looks at what it tells."""
CLIMB_LIMIT = 2 * CLIMB_SPEED
"""Metres per second, up and down, at most: the mean is about what plans count with."""
TIME_FACTOR, TIME_MARGIN = 3.0, 10.0
"""A flight may take so many times what it takes at full speed, and so many seconds more."""
SLOWEST_PLANNED = 1.0
"""Metres per second at which a flight is waited for, where a category is faster: a drone may not be."""
MOST_REASONS = 20
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


class Vehicle:
    """A drone in the hands of its navigation. All of it happens in asyncio's loop."""

    def __init__(
        self,
        drone: TeamDrone,
        cargo: Cargo,
        say: Callable[[str], object],
        clock: Callable[[], float],
    ) -> None:
        self.drone, self.id, self.navigation = drone, drone.id, drone.navigation
        self.position_problem: Callable[[], str | None] = _seeing
        """Says why it does not know where it is, if it must be told its position and is not."""
        self.missing_actions: Callable[[], tuple[str, ...]] = tuple
        """Says what the plan asks for, and its hardware does not do."""
        self.cargo, self.calls = cargo, NavigationCalls(drone.id, say, clock)
        self.telemetry = VehicleTelemetry(
            drone.home,
            drone.category.flight_time,
            lambda: self.navigation.telemetry,
            self.calls,
        )
        self.commands = CommandQueue(self.hover)
        self.linked = False
        self.on_lost: Callable[[], object] = _nothing
        """Told when its link is lost."""
        self.out_of_reach = f"{drone.id} has not been reached yet"
        """Why it is not linked, if it is not."""
        self.boot = 0
        """How often it was found switched off and on again."""
        self.down: FlightFailed | None = None
        """Why it takes no commands though it is linked, if it takes none."""
        self.needs_person = False
        """Only a person who has put it home ends that."""
        self.looked_after = False
        """A person has looked after it, which it has not been told yet."""
        self.is_cut = False
        """Its motors are being cut, or were: nothing may turn them on again."""
        self.must_land = False
        """It comes down by itself, as soon as it can."""
        self.position_lost = False
        """It comes down because it does not know where it is: it is not to go anywhere else."""
        self.speed = drone.category.top_speed or drone.category.speed
        self.climb = min(CLIMB_LIMIT, self.speed)

    # How it is

    @property
    def is_docked(self) -> bool:
        """Whether it stands at home."""
        return self.telemetry.landed and docked(self.telemetry.location, self.drone.home)

    @property
    def has_crashed(self) -> bool:
        """Whether it takes no commands because it fell."""
        return self.down is not None and self.down.failure is Failure.CRASH

    @property
    def flew_lately(self) -> bool:
        """Whether it flies, or did a moment ago."""
        return not self.telemetry.landed or self.calls.clock() - self.telemetry.flew < RECENTLY

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
        telemetry, now = self.telemetry, self.calls.clock()
        self.linked = False
        self.out_of_reach = f"{self.id} lost its link at {place(telemetry.location)}: {why}"
        self.calls.say(self.out_of_reach)
        self.on_lost()
        if now < telemetry.rises_until:  # it was about to take off, and may have done so
            telemetry.rises_until = now + EMPTY * self.drone.category.flight_time
        self.commands.fail(FlightFailed(Failure.LINK, self.out_of_reach))

    def crashed(self, why: str) -> None:
        """It fell out of the air: a person must look after it."""
        self.must_land = False
        self.refuse(FlightFailed(Failure.CRASH, why))

    def force_landing(self, why: FlightFailed, *, needs_person: bool = True) -> None:
        """It flies no further: from now on it comes down by itself."""
        self.must_land = True
        self.refuse(why, needs_person=needs_person)

    def lose_position(self, why: str) -> None:
        """It does not know any more where it is: what it would do there it must not do."""
        self.position_lost = True
        if self.must_land:
            return
        reason = f"{self.id} does not know where it is, and lands: {why}"
        self.force_landing(FlightFailed(Failure.LINK, reason), needs_person=False)

    def refuse(self, why: FlightFailed, *, needs_person: bool = False) -> None:
        """It takes no commands from now on; what it does ends here."""
        self.calls.say(str(why))
        self.down, self.needs_person = why, needs_person
        if not (self.must_land and self.commands.doing == LAND):
            self.commands.fail(why)

    def clear_failure(self) -> None:
        """It takes commands again."""
        self.down, self.needs_person = None, False
        self.must_land = self.is_cut = self.position_lost = False

    async def report_care(self) -> bool:
        """Tell it that a person has looked after it, if one has and it wants to know; False: in vain.

        One that flies need not know: what befalls it later has not been looked after.
        """
        if not (self.looked_after and self.linked):
            return True
        self.looked_after = False
        if self.telemetry.landed and isinstance(self.navigation, CaredFor):
            try:
                await self.calls.call("recover", RECOVER, self.navigation.looked_after)
            except FlightFailed as error:
                self.calls.say(str(error))
                self.looked_after = error.failure is Failure.LINK  # it may not have heard
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
        blind = self.position_problem()
        return told if blind is None else (*told, blind)

    def break_off(self) -> None:
        """Stop what it does, and hover; but one that must land does."""
        if not self.must_land:
            why = f"{self.id} was told to break it off"
            self.commands.fail(FlightFailed(Failure.REFUSED, why))

    # How that is done

    async def go(
        self, what: str, seconds: float, method: Callable[..., Awaitable[T]], *args: object
    ) -> T:
        """Have it do something that takes so long at full speed, and return what came of it."""
        try:
            return await self.calls.call(what, seconds * TIME_FACTOR + TIME_MARGIN, method, *args)
        except FlightFailed as error:
            self._hears(error)
            raise

    def _hears(self, error: FlightFailed) -> None:
        """Believe what a failed command says of the drone: that may be known before it is seen."""
        if error.failure is Failure.LINK and self.telemetry.silence > STALE:
            self.lost(str(error))
        elif error.failure is Failure.CRASH and self.flew_lately:
            self.crashed(str(error))
        elif error.failure is Failure.BATTERY and not self.telemetry.landed:
            self.force_landing(error)

    async def until(self, holds: Callable[[], bool], limit: float) -> bool:
        """Wait until something holds of what it tells, and say whether it does within the limit."""
        for _ in range(round(limit / LOOK)):
            if holds():
                return True
            await asyncio.sleep(LOOK)
        return holds()

    async def hover(self) -> None:
        """Hover, after a command was broken off; where it cannot, the log says why."""
        await self.calls.parted()
        if self.linked and not self.telemetry.landed and not self.is_cut:
            try:
                await self.calls.call("hover", HOLD, self.navigation.hold)
            except FlightFailed as error:
                self.calls.say(f"{self.id} was to hover: {error}")


def _nothing() -> None:
    """Tells of no lost link."""


def _seeing() -> None:
    """It knows where it is by itself."""
