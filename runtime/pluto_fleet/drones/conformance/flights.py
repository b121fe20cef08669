"""What the author of a navigation provides to the kit, and its flights, each flown once and recorded for the checks.

A command that raises ends a flight, which then lands and closes; it is recorded up to then.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from functools import partial
from math import dist, nan
from typing import TYPE_CHECKING

from ...shared.domain.model import Point
from ..following import follow
from ..protocol import DroneNavigation
from .recording import FlightRecord, Sample, Step, Truth

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

LOOK = 0.02
"""The sampling interval of the drone, in seconds."""
_MISTAKES: tuple[type[Exception], ...] = (Exception,)


class Author:
    """The settings of `NavigationContract`, which an author may override."""

    height = 0.5
    """The height to take off to, in metres."""
    away = 1.0
    """Metres to fly, along x from where the drone stands: there must be room."""
    speed = 0.5
    """Metres per second: the limit that is given with each command."""
    pace = 0.2
    """Metres per second of what it follows, along x for as far as it flies away."""
    rest = 0.4
    """Seconds to observe a drone after a command, while it should stay where it is."""
    tolerance = 0.1
    """The accuracy that is required of its position and of its arrival, in metres."""
    connect_limit = 15.0
    """The time-out of `connect` in seconds, as in a flight."""
    may_fall = False
    """Whether the motors may be switched off ten centimetres above the ground."""

    together = False
    """Whether the flights may run concurrently, as with simulated drones."""

    loop_factory: Callable[[], asyncio.AbstractEventLoop] | None = None
    """What makes the event loops on which to fly: one of a simulator whose time is not the clock's."""

    # Provided by the author

    def make(self) -> DroneNavigation:
        """Return a fresh navigation of a drone that stands on the ground, ready to fly."""
        raise NotImplementedError("give the kit a navigation: def make(self) -> DroneNavigation")

    def make_unreachable(self) -> DroneNavigation:
        """Return a navigation of a drone that does not exist."""
        raise NotImplementedError

    def silence(self, navigation: DroneNavigation) -> None:
        """Make its drone fall silent."""
        raise NotImplementedError

    def crash(self, navigation: DroneNavigation) -> None:
        """Make its drone crash."""
        raise NotImplementedError

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        """Return the true state of its drone, if a simulator or cameras know it."""
        return None


def now() -> float:
    """Return the time, as the loop knows it: `time.monotonic()`, on an ordinary one."""
    return asyncio.get_running_loop().time()


class Ended(Exception):
    """A command has failed, which ends the flight."""


class Flight:
    """One flight in progress."""

    def __init__(self, subject: Author, navigation: DroneNavigation) -> None:
        self.subject, self.navigation = subject, navigation
        self.record = FlightRecord(made=type(navigation))
        self.during = "before"

    def look(self) -> Sample:
        told, true = self.navigation.telemetry, self.subject.truth(self.navigation)
        sample = Sample(at=now(), during=self.during, telemetry=told, truth=true)
        self.record.samples.append(sample)
        return sample

    async def tries(
        self, name: str, command: Callable[[], Awaitable[object]], limit: float
    ) -> Step:
        """Run a command with a time-out, and record how it ended."""
        self.during = name
        step = Step(name=name, began=now(), ended=0.0, before=(first := self.look()), after=first)
        try:
            async with asyncio.timeout(limit) as timer:
                step.value = await command()
        except TimeoutError as error:
            expired = timer.expired()
            step.error = TimeoutError(f"not over after {limit:.1f} s") if expired else error
        except _MISTAKES as error:
            step.error = error
        step.ended, step.after = now(), self.look()
        self.record.steps[name] = step
        self.during = f"after {name}"
        return step

    async def does(self, name: str, command: Callable[[], Awaitable[object]], limit: float) -> Step:
        """Run a command whose failure ends the flight."""
        step = await self.tries(name, command, limit)
        if step.error is not None:
            raise Ended from step.error
        return step

    def limit(self, metres: float) -> float:
        """Return the runtime's time-out for a leg of this length."""
        return metres / self.subject.speed * 3 + 10

    async def sets_out(self) -> None:
        """Connect and take off."""
        subject, drone = self.subject, self.navigation
        await self.does("connect", drone.connect, subject.connect_limit)
        await self.does("preflight", drone.preflight, 5.0)
        await self.does(
            "takeoff",
            lambda: drone.takeoff(subject.height, subject.speed),
            self.limit(subject.height),
        )

    async def rests(self) -> None:
        await asyncio.sleep(self.subject.rest)
        self.look()  # on a busy machine it may be the only sample

    async def watched(self) -> None:
        """Sample the drone until cancelled."""
        while True:
            self.look()
            await asyncio.sleep(LOOK)

    async def hears(self) -> None:
        """Record its events, until they end."""
        try:
            async for event in self.navigation.events():
                self.record.events.append(event)
            self.record.events_ended = True
        except _MISTAKES as error:
            self.record.events_error = error


@asynccontextmanager
async def flying(subject: Author, make: Callable[[], DroneNavigation]) -> AsyncIterator[Flight]:
    """Make a navigation; land and close it, however its flight ends."""
    flight = Flight(subject, make())
    drone = flight.navigation
    watching = asyncio.create_task(flight.watched())
    hearing = asyncio.create_task(flight.hears())
    try:
        yield flight
    except Ended as ended:
        flight.record.failed = ended.__cause__
    finally:
        if "close" not in flight.record.steps:
            if drone.telemetry.flying:
                await flight.tries("land at the end", lambda: drone.land(0.5), 20.0)
            await flight.tries("close", drone.close, 20.0)
        await asyncio.wait([hearing], timeout=1.0)
        for task in (watching, hearing):
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task


async def tour(subject: Author) -> FlightRecord:
    async with flying(subject, subject.make) as flight:
        drone, speed, height = flight.navigation, subject.speed, subject.height
        await flight.does("connect", drone.connect, subject.connect_limit)
        x, y, _ = home = drone.telemetry.position
        await flight.does("preflight", drone.preflight, 5.0)
        await flight.rests()
        await flight.tries("go_to on the ground", lambda: drone.go_to((x, y, height), speed), 5.0)
        await flight.does("takeoff", lambda: drone.takeoff(height, speed), flight.limit(height))
        for name, target, at in (
            ("go_to a place that is no number", (nan, y, height), speed),
            ("go_to below the ground", (x, y, -1.0), speed),
            ("go_to at no speed", (x + subject.away, y, height), 0.0),
        ):
            await flight.tries(name, partial(drone.go_to, target, at), 5.0)
        await flight.rests()
        there = (x + subject.away, y, height)
        limit = flight.limit(dist(drone.telemetry.position, there))
        await flight.does("go_to", lambda: drone.go_to(there, speed), limit)
        await flight.rests()
        await flight.does("preflight in the air", drone.preflight, 5.0)
        await _cancelled(flight, (home[0], home[1], height))
        await flight.does("hold", drone.hold, 10.0)
        await flight.rests()
        await flight.does("land", lambda: drone.land(speed), flight.limit(height))
        await flight.does("land on the ground", lambda: drone.land(speed), 5.0)
        await flight.does("hold on the ground", drone.hold, 5.0)
        await flight.rests()
        await flight.tries("connect again", drone.connect, subject.connect_limit)
        await flight.rests()
        await flight.does("close", drone.close, 20.0)
    return flight.record


AHEAD = 1.0
AGAIN = 0.5
"""Seconds ahead of what it follows to which a drone is sent, and until it is sent on."""


async def followed(subject: Author) -> FlightRecord:
    """Follow what moves along x, and is known twice a second."""
    async with flying(subject, subject.make) as flight:
        await flight.sets_out()
        drone = flight.navigation
        pace = subject.pace
        x, y, _ = drone.telemetry.position
        lasts = subject.away / pace

        async def follows() -> None:
            began = now()
            while (passed := now() - began) < lasts:
                ahead = min(passed + AHEAD, lasts)
                target = (x + pace * ahead, y, subject.height)
                going = asyncio.create_task(follow(drone, target, subject.speed, ahead - passed))
                await asyncio.wait([going], timeout=AGAIN)
                if not going.done():
                    going.cancel()
                    await asyncio.wait([going], timeout=1.0)
                elif not going.cancelled() and going.exception() is None:
                    await asyncio.sleep(max(0.0, began + passed + AGAIN - now()))
                if not going.cancelled():
                    going.result()

        await flight.does("follow", follows, 2 * lasts + 10)
        await flight.does("hold", drone.hold, 10.0)
        await flight.does("land", lambda: drone.land(subject.speed), flight.limit(subject.height))
    return flight.record


async def _cancelled(flight: Flight, target: Point) -> None:
    """Cancel a go_to half-way, as a Stop does."""
    drone, start = flight.navigation, flight.navigation.telemetry.position
    half = dist(start, target) / 2

    async def broken_off() -> None:
        going = asyncio.create_task(drone.go_to(target, flight.subject.speed))
        while dist(drone.telemetry.position, start) < half and not going.done():
            await asyncio.sleep(LOOK)
        if going.done():
            await going
            return
        flight.during = "cancel"
        going.cancel()
        await asyncio.wait([going], timeout=1.0)
        if not going.done():
            raise TimeoutError("go_to goes on a second after it was cancelled")
        if not going.cancelled() and (error := going.exception()) is not None:
            raise error

    await flight.does("go_to that is cancelled", broken_off, flight.limit(2 * half))


async def closed_in_the_air(subject: Author) -> FlightRecord:
    """Close a navigation while its drone hovers, as a program does that ends too early."""
    async with flying(subject, subject.make) as flight:
        await flight.sets_out()
        await flight.tries("close", flight.navigation.close, 20.0)
        await flight.rests()
    return flight.record


async def struck(subject: Author, strike: Callable[[DroneNavigation], object]) -> FlightRecord:
    """Cause a fault while a drone flies."""
    async with flying(subject, subject.make) as flight:
        await flight.sets_out()
        drone = flight.navigation
        x, y, z = start = drone.telemetry.position
        target = (x + subject.away, y, z)

        async def goes() -> None:
            going = asyncio.create_task(drone.go_to(target, subject.speed))
            try:
                while dist(drone.telemetry.position, start) < subject.away / 4:
                    if going.done():
                        break
                    await asyncio.sleep(LOOK)
                strike(drone)
                flight.during = "struck"
                await going
            finally:
                going.cancel()

        await flight.tries("go_to", goes, flight.limit(subject.away))
    return flight.record


async def unreachable(subject: Author, make: Callable[[], DroneNavigation]) -> FlightRecord:
    """Connect to a drone that does not exist."""
    async with flying(subject, make) as flight:
        await flight.tries("connect", flight.navigation.connect, subject.connect_limit)
    return flight.record


async def cut(subject: Author) -> FlightRecord:
    """Switch the motors off, ten centimetres above the ground."""
    async with flying(subject, subject.make) as flight:
        await flight.sets_out()
        await flight.does("emergency_stop", flight.navigation.emergency_stop, 3.0)
        await flight.rests()
    return flight.record
