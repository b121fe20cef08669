"""Each fault, on Crazyflies behind one gateway: what it becomes, and that no other suffers.

All drones fly at once, in virtual time, through the unmodified cflib.
"""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.faults import Value
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.model import Point
from tests.flights_crazyflie.judge import dropped
from tests.flights_crazyflie.team import Flown, commanded
from tests.kit.unthreaded import in_virtual_time, passes, the_air

pytest.importorskip("cflib")

HOMES: dict[str, Point] = {
    name: (2.0 * at + 1.0, 1.0, 0.0)
    for at, name in enumerate(
        ("well", "mute", "away", "gone", "tumbler", "flat", "busy", "lossy1", "lossy5")
    )
}
OPTIONS = {"measure": {"temperature": "bme.temp"}}


class Hall:
    """Simulated drones, and what flies them."""

    def __init__(self, server: Server, flown: Flown) -> None:
        self.server, self.flown = server, flown

    def there(self, drone: str) -> Point:
        """Return where a drone's job is."""
        x, y, _ = HOMES[drone]
        return x, y + 3.0, 0.8

    def place(self, drone: str) -> Point:
        """Return where a drone really is."""
        return self.server.drones[drone].body.position

    def flies(self, drone: str) -> bool:
        """Return whether a drone really is in the air."""
        return self.server.drones[drone].body.airborne

    async def let(self, drone: str, fault: str, value: Value = True) -> None:
        """Let something go wrong as soon as a drone is on its way."""
        while self.place(drone)[1] < 2.0:
            await asyncio.sleep(0.05)
        await self.server.let(drone, fault, value)

    def is_home(self, drone: str) -> bool:
        """Return whether a drone stands where it stood."""
        (x, y, z), (hx, hy, _) = self.place(drone), HOMES[drone]
        return abs(x - hx) < 0.15 and abs(y - hy) < 0.15 and z < 0.05

    async def does_well(self, drone: str) -> None:
        """It flies, measures and comes home."""
        value = await self.flown.flies(drone, self.there(drone))
        assert isinstance(value, float), value
        assert await self.flown.do(self.flown.gateway.recover(drone))
        assert self.is_home(drone)


async def silent_at_connect(hall: Hall) -> None:
    """It is not there, and the others have not waited for it; bring it back, and it flies."""
    failed = await hall.flown.fails("mute", hall.there("mute"))
    assert failed.failure is Failure.LINK
    await hall.server.let("mute", "silent", False)
    assert await hall.flown.do(hall.flown.gateway.recover("mute"))
    assert not hall.flies("mute")


async def silent_in_flight(hall: Hall) -> None:
    """It is silent in the midst of a flight, for ten seconds: it hovers, and comes home then."""
    began = asyncio.ensure_future(hall.let("away", "silent"))
    failed = await hall.flown.fails("away", hall.there("away"))
    assert failed.failure is Failure.LINK
    await began
    assert hall.flies("away")
    asyncio.get_running_loop().call_later(
        10, lambda: asyncio.ensure_future(hall.server.let("away", "silent", False))
    )
    assert await hall.flown.do(hall.flown.gateway.recover("away"))
    assert hall.is_home("away")


async def switched_off_in_flight(hall: Hall) -> None:
    """Its port is closed: at once it is known that no drone is there."""
    began = asyncio.ensure_future(hall.let("gone", "gone"))
    failed = await hall.flown.fails("gone", hall.there("gone"))
    assert failed.failure is Failure.LINK
    await began
    await hall.server.let("gone", "gone", False)
    assert await hall.flown.do(hall.flown.gateway.recover("gone"))
    assert hall.is_home("gone")


async def tumbles(hall: Hall) -> None:
    """It lies there until a person has looked after it."""
    began = asyncio.ensure_future(hall.let("tumbler", "tumble"))
    failed = await hall.flown.fails("tumbler", hall.there("tumbler"))
    assert failed.failure is Failure.CRASH
    await began
    gateway = hall.flown.gateway
    assert not await hall.flown.do(gateway.recover("tumbler"))
    await hall.server.let("tumbler", "fetch")
    hall.flown.kernel.post(gateway.navigation.mended, "tumbler")
    assert await hall.flown.do(gateway.recover("tumbler"))


async def has_a_low_battery(hall: Hall) -> None:
    """At 3.2 V it lands where it is, and is waited for."""
    began = asyncio.ensure_future(hall.let("flat", "volts", 3.15))
    failed = await hall.flown.fails("flat", hall.there("flat"), (*HOMES["flat"][:2], 2.0))
    assert failed.failure is Failure.BATTERY
    await began
    recovers = hall.flown.begin(hall.flown.gateway.recover("flat"))
    while hall.flies("flat"):
        await passes(0.1)
    assert not hall.is_home("flat")
    await passes(3.0)
    assert not recovers.is_set
    await hall.server.let("flat", "volts", 4.1)
    await hall.server.let("flat", "fetch")
    async with asyncio.timeout(100):
        assert await hall.flown.kernel.offer(recovers)


async def is_busy(hall: Hall) -> None:
    """It refuses to take off, and nothing of it has moved."""
    await hall.server.let("busy", "busy", True)
    failed = await hall.flown.fails("busy", hall.there("busy"))
    assert failed.failure is Failure.REFUSED
    assert hall.is_home("busy")
    await hall.server.let("busy", "busy", False)
    assert await hall.flown.do(hall.flown.gateway.recover("busy"))
    value = await hall.flown.flies("busy", hall.there("busy"), number=2)
    assert isinstance(value, float), value


STORIES = (
    silent_at_connect,
    silent_in_flight,
    switched_off_in_flight,
    tumbles,
    has_a_low_battery,
    is_busy,
)


def test_each_fault_fails_its_own_flight_and_no_other(tmp_path: Path) -> None:
    """In the end all that flew has landed, with its motors never cut."""

    async def fly() -> None:
        record, began = MemoryLog(), the_air().time()
        server = Server([Build(id=id, home=home) for id, home in HOMES.items()], record)
        await server.start()
        await server.let("mute", "silent")
        await server.let("lossy1", "loss", 0.01)
        await server.let("lossy5", "loss", 0.05)
        try:
            async with commanded(tmp_path, HOMES, server.uris, OPTIONS) as flown:
                hall = Hall(server, flown)
                fleet_report = await flown.do(flown.link.fleet_report())
                silent = [id for id, report in fleet_report.drones.items() if not report.reached]
                assert silent == ["mute"], flown.log
                assert the_air().time() - began < 30.0
                stories = {story.__name__: story(hall) for story in STORIES}
                stories |= {drone: hall.does_well(drone) for drone in ("well", "lossy1", "lossy5")}
                ends = await asyncio.gather(*stories.values(), return_exceptions=True)
            told = zip(stories, ends, strict=True)
            wrong = [f"{story}: {end!r}" for story, end in told if end is not None]
            assert not any(map(hall.flies, HOMES))
            assert list(dropped(record.commands)) == []
            assert not wrong, "\n".join([*wrong, *flown.log])
        finally:
            await server.close()

    in_virtual_time(fly())
