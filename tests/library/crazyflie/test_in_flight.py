"""What goes wrong with simulated Crazyflies in flight, and before it; test_conformance.py has what goes well."""

from __future__ import annotations

import asyncio

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.errors import Crashed, Locked, NotReady, Rejected
from pluto_fleet.drones.protocol import CRASHED, LOCKED
from tests.kit.unthreaded import passes
from tests.library.crazyflie.hangar import FAST, Hangar, drone


async def test_a_drone_that_is_busy_is_a_refusal_and_is_disarmed(
    one: Hangar, cf: Crazyflie
) -> None:
    await one.let("busy")
    with pytest.raises(Rejected, match="refuses the command takeoff"):
        await cf.takeoff(0.5, FAST)
    assert not one.flies and not one.drone.supervisor.armed


async def test_a_drone_that_tumbles_has_crashed(one: Hangar, up: Crazyflie) -> None:
    flying = asyncio.create_task(up.go_to((9.0, 2.0, 0.5), 1.0))
    await passes(0.5)
    await one.let("tumble")
    with pytest.raises(Crashed, match="cf1 has tumbled or crashed"):
        await flying
    assert (await one.hears(CRASHED)).reason == "it lies on its back or has crashed"
    assert await up.preflight() == ["it lies on its back or has crashed"]
    with pytest.raises(Crashed):
        await up.takeoff(0.5, FAST)


async def test_a_drone_that_is_locked_says_so_and_what_to_do(one: Hangar, cf: Crazyflie) -> None:
    await one.let("lock")
    assert (await one.hears(LOCKED)).reason.endswith("switch it off and on")
    assert await cf.preflight() == ["it has locked its motors: switch it off and on"]
    with pytest.raises(Locked):
        await cf.takeoff(0.5, FAST)


@drone(
    options={"decks": ["bcLighthouse4", "bcLoco"]},
    build=Build(id="cf1", home=(1.0, 2.0, 0.0), level=0.05),
)
async def test_preflight_says_all_that_is_wrong(one: Hangar) -> None:
    cf = one.navigation
    await one.let("unsure")
    await cf.connect()
    empty, deck, unsure = await cf.preflight()
    assert empty.startswith("its battery has 3.") and empty.endswith("charge it")
    assert unsure.startswith("it is not sure where it is: to 0.71 m (a variance of 0.5000 m²)")
    assert deck.startswith('it has no deck "bcLoco": it has bc')
    with pytest.raises(NotReady, match="cf1 is not ready: its battery"):
        await cf.takeoff(0.5, FAST)
    assert not one.did("arm")


async def test_the_emergency_stop_stops_in_the_air(one: Hangar, up: Crazyflie) -> None:
    flying = asyncio.create_task(up.go_to((9.0, 2.0, 0.5), 1.0))
    await passes(0.5)
    await up.emergency_stop()
    assert one.drone.supervisor.locked
    with pytest.raises((Locked, Crashed)):
        await flying


@drone(build=Build(id="cf1", home=(1.0, 2.0, 0.0), knows_where=False))
async def test_a_drone_that_cannot_find_itself_flies_by_what_others_see(
    one: Hangar, cf: Crazyflie
) -> None:

    async def see() -> None:
        while True:
            await cf.locate(one.position)
            await asyncio.sleep(0.05)

    seeing = asyncio.create_task(see())
    await passes(1.5)
    assert await cf.preflight() == []
    seeing.cancel()
    await asyncio.wait({seeing})
