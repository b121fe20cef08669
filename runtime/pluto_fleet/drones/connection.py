"""The link to one drone: connected, reconnected when lost, and closed once the drone has landed.

Closing a link may cut the motors, so a drone is landed first. After a failed flight a drone is waited for,
until it takes commands again, or a person has put it home.
"""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from contextlib import suppress
from math import inf

from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.text import duration, place
from .commands import LANDED_LIMIT, land
from .vehicle import LAND, LOOK, TIME_FACTOR, TIME_MARGIN, Vehicle

WAIT_FOR_CONNECTION = 15.0
"""Seconds for which commands wait for a drone to be connected."""
ATTEMPT_LIMIT = 60.0
"""The time-out of one attempt, in seconds: the first over a busy radio is slow."""
PAUSES = (1.0, 2.0, 4.0, 5.0)
"""Seconds between attempts; the last repeats while the drone may fly, or something waits for it."""
PAUSE_ON_GROUND = 30.0
"""Seconds between attempts for a drone on the ground: others need the radio."""
FRESH = 1.0
"""Seconds within which a connected drone must have sent its position."""


class Connection:
    """The link to one drone."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self._wanted, self._tried = asyncio.Event(), asyncio.Event()
        self._was_linked = self._given_up = False
        self._waiting = 0
        """How many callers wait for it."""
        self._task: asyncio.Task[None] | None = None
        vehicle.on_lost = self._wanted.set

    def start(self) -> asyncio.Task[None]:
        """Connect, and reconnect, as long as this task runs."""
        self._task = asyncio.ensure_future(self._keep())
        return self._task

    def stop(self) -> None:
        if self._task is not None:
            self._task.cancel()

    async def once(self) -> bool:
        """Return whether it is linked, if needed after one more attempt."""
        vehicle = self._vehicle
        if not vehicle.linked:
            self._wanted.set()
            try:
                async with asyncio.timeout(WAIT_FOR_CONNECTION):
                    await self._tried.wait()
            except TimeoutError:
                vehicle.out_of_reach = (
                    f"{vehicle.id} did not answer in {duration(WAIT_FOR_CONNECTION)}"
                )
        return vehicle.linked

    async def within(self, limit: float) -> bool:
        """Wait until it is linked, and return whether it is; after the time-out it is given up."""
        self._given_up = False
        self._wanted.set()
        self._waiting += 1
        try:
            async with asyncio.timeout(limit):
                while not self._vehicle.linked:
                    await self._tried.wait()
        except TimeoutError:
            self._given_up = True
        finally:
            self._waiting -= 1
        return self._vehicle.linked

    async def _keep(self) -> None:
        attempts = 0
        while True:
            self._wanted.clear()
            pause: float | None = None
            if not self._vehicle.linked:
                await self._attempt()
                tried, self._tried = self._tried, asyncio.Event()
                tried.set()
                attempts += 1
                pause = self._pause(attempts)
            if self._vehicle.linked:
                attempts, pause = 0, None
            with suppress(TimeoutError):
                async with asyncio.timeout(pause):
                    await self._wanted.wait()

    def _pause(self, attempts: int) -> float:
        if attempts > len(PAUSES) and self._vehicle.telemetry.landed and not self._waiting:
            return PAUSE_ON_GROUND
        return PAUSES[min(attempts, len(PAUSES)) - 1]

    async def _attempt(self) -> None:
        vehicle, telemetry = self._vehicle, self._vehicle.telemetry
        flew = not telemetry.landed
        await vehicle.calls.parted()
        try:
            await vehicle.calls.call("answer", ATTEMPT_LIMIT, vehicle.navigation.connect)
            await vehicle.set_up()
        except FlightFailed as error:
            self._fails(str(error))
            return
        if telemetry.silence > FRESH:
            self._fails(f"{vehicle.id} is connected, but does not tell where it is")
            return
        vehicle.linked, telemetry.rises_until = True, -inf
        if self._was_linked:
            self._is_back(flew)
        self._was_linked, self._given_up = True, False

    def _fails(self, why: str) -> None:
        if why != self._vehicle.out_of_reach:
            self._vehicle.out_of_reach = why
            self._vehicle.calls.say(why)

    def _is_back(self, flew: bool) -> None:
        """Handle a reconnection: it hovers as before, or was restarted."""
        vehicle, telemetry = self._vehicle, self._vehicle.telemetry
        where = place(telemetry.location)
        if telemetry.landed:
            vehicle.boot += flew
            vehicle.calls.say(f"{vehicle.id} is back: it stands at {where}")
            return
        vehicle.calls.say(f"{vehicle.id} is back: it hovers at {where}")
        if self._given_up:
            late = f"{vehicle.id} was out of reach for too long: it lands at {where}"
            vehicle.force_landing(FlightFailed(Failure.LINK, late), needs_person=False)


CLOSE_LIMIT = 20.0
"""The time-out of closing a link, in seconds."""
_LANDING_ATTEMPTS, _BETWEEN_LANDINGS = 3, 1.0
"""How often a landing is tried, and the seconds in between."""


async def close(team: Sequence[tuple[Vehicle, Connection]]) -> None:
    """Land all drones in the air, wait until they have landed, and close each link.

    All landings share one time-out: a drone that must be reconnected first has as long as the highest one.
    """
    slowest = max((_seconds(vehicle) for vehicle, _ in team), default=0.0)
    until = asyncio.get_running_loop().time() + WAIT_FOR_CONNECTION + slowest
    await asyncio.gather(*(_close(vehicle, connection, until) for vehicle, connection in team))


def _seconds(vehicle: Vehicle) -> float:
    """Return how long a landing from where it is may take."""
    return vehicle.sinks * TIME_FACTOR + TIME_MARGIN + LANDED_LIMIT


async def _close(vehicle: Vehicle, connection: Connection, until: float) -> None:
    vehicle.break_off()
    with suppress(TimeoutError):
        async with asyncio.timeout_at(until):
            await _land(vehicle, connection)
    if not vehicle.telemetry.landed:
        vehicle.commands.release()  # a landing in progress continues by itself
        where = place(vehicle.telemetry.location)
        vehicle.calls.say(f"{vehicle.id} could not be landed: it may still hover at {where}")
    connection.stop()
    await vehicle.calls.parted()
    try:
        await vehicle.calls.call("close its link", CLOSE_LIMIT, vehicle.navigation.close)
    except FlightFailed as error:
        vehicle.calls.say(str(error))
    vehicle.linked = False
    await vehicle.calls.parted()


async def _land(vehicle: Vehicle, connection: Connection) -> None:
    for _ in range(_LANDING_ATTEMPTS):
        if vehicle.telemetry.landed:
            return
        await connection.once()
        try:
            await vehicle.does(LAND, land)
        except FlightFailed as error:
            vehicle.calls.say(f"{vehicle.id} was to land: {error}")
            await asyncio.sleep(_BETWEEN_LANDINGS)


RECONNECT_LIMIT = 120.0
"""Seconds for which a lost link is tried to be restored."""
READY_LIMIT = 10.0
"""Seconds that a drone on the ground has to get ready: its position may have to settle."""
HOME_LIMIT = 600.0
"""Seconds within which a person must have put it home."""
BETWEEN_LOOKS = 2.0
"""The polling interval, in seconds."""


async def recover(vehicle: Vehicle, connection: Connection) -> bool:
    """Wait until a drone takes commands, or is down where it needs a person.

    Returns False if it is lost.
    """
    if not await connection.within(RECONNECT_LIMIT):
        return False
    if not await _has_landed(vehicle, connection):
        return False
    if not await vehicle.report_care():
        return False
    if not vehicle.telemetry.landed:
        return vehicle.down is None
    return vehicle.needs_person or await _is_ready(vehicle)


async def _has_landed(vehicle: Vehicle, connection: Connection) -> bool:
    """Wait while a drone lands by itself, or has not reported yet whether it flies."""
    patience = round(READY_LIMIT / LOOK)
    while vehicle.telemetry.is_rising or (
        not vehicle.telemetry.landed and vehicle.down is not None
    ):
        await asyncio.sleep(LOOK)
        patience -= not vehicle.must_land
        if patience < 0 or not (vehicle.linked or await connection.within(RECONNECT_LIMIT)):
            return False
    return True


async def _is_ready(vehicle: Vehicle) -> bool:
    """Return whether a drone on the ground can fly on, or may be waited for."""
    until = vehicle.calls.clock() + READY_LIMIT
    while (reasons := await _reasons(vehicle)) and vehicle.calls.clock() < until:
        await asyncio.sleep(BETWEEN_LOOKS)
    if not reasons:
        vehicle.clear_failure()
    elif vehicle.has_crashed:
        return False
    else:
        why = f"{vehicle.id} is not ready: {'; '.join(reasons)}"
        vehicle.refuse(FlightFailed(Failure.REFUSED, why), needs_person=True)
    return True


async def wait_until_home(vehicle: Vehicle) -> bool:
    """Wait until a drone is at home and ready; return False if not in time, or if it has crashed.

    One that crashes on its way is lost, so that its repair can be confirmed.
    """
    said: tuple[str, ...] = ()
    try:
        async with asyncio.timeout(HOME_LIMIT):
            while missing := await _missing(vehicle):
                if vehicle.has_crashed or not await vehicle.report_care():
                    return False
                _lands(vehicle)
                if missing != said:
                    vehicle.calls.say(f"{vehicle.id} is waited for: {'; '.join(missing)}")
                    said = missing
                await asyncio.sleep(BETWEEN_LOOKS)
    except TimeoutError:
        return False
    vehicle.clear_failure()
    return True


def _lands(vehicle: Vehicle) -> None:
    """Make a drone land that is not commanded any more."""
    if vehicle.linked and not vehicle.telemetry.landed and not vehicle.must_land:
        where = place(vehicle.telemetry.location)
        why = f"{vehicle.id} could not be flown home: it lands at {where}"
        vehicle.force_landing(vehicle.down or FlightFailed(Failure.REFUSED, why))


async def _missing(vehicle: Vehicle) -> tuple[str, ...]:
    """Return what keeps it from flying again."""
    if vehicle.linked and not vehicle.is_docked:
        return (f"put it home, at {place(vehicle.drone.home)}",)
    return await _reasons(vehicle)


async def _reasons(vehicle: Vehicle) -> tuple[str, ...]:
    """Return why it may not fly, apart from a low battery where it can be charged."""
    if not vehicle.linked:
        return (vehicle.out_of_reach,)
    if vehicle.is_docked and vehicle.telemetry.battery_level < vehicle.drone.category.reserve:
        return vehicle.missing_actions()
    return (*await vehicle.preflight(), *vehicle.missing_actions())
