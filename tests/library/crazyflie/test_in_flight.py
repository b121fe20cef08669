"""What goes wrong with simulated Crazyflies in flight, and before it; test_conformance.py has what goes well."""

from __future__ import annotations

import asyncio
from math import dist, hypot

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.protocol import CRASHED, LOCKED, Crashed, Locked, NotReady, Rejected
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


# How fast they are let fly


@drone(speed=2.0)
async def test_one_that_is_to_fly_faster_than_its_controller_follows_is_not_ready(
    one: Hangar, cf: Crazyflie
) -> None:
    across, aside = await cf.preflight()
    assert across == (
        "it is to fly at up to 2 m/s, and its firmware follows no course faster than 1 m/s"
        " (posCtlPid.xVelMax): give its category a lower speed, or set that parameter"
    )
    assert "posCtlPid.yVelMax" in aside
    with pytest.raises(NotReady, match="follows no course faster than 1 m/s"):
        await cf.takeoff(0.5, 0.5)
    assert not one.did("arm")


@drone(speed=0.8)
async def test_one_that_is_still_telling_its_parameters_is_waited_for(one: Hangar) -> None:
    """Over a busy radio they take longer than it takes to be sure where it is."""
    cf = one.navigation
    await one.let("latency", 0.03)
    await cf.connect()
    one.drone.parameters["posCtlPid.yVelMax"] = 0.5
    (reason,) = await cf.preflight()
    assert "than 0.5 m/s (posCtlPid.yVelMax)" in reason


async def test_a_course_is_as_slow_as_its_controller_though_more_is_asked_for(
    one: Hangar, cf: Crazyflie
) -> None:
    """A drone that is met in the air must come home, however fast its category is."""
    await cf.takeoff(0.5, 3.0)
    await cf.go_to((5.0, 2.0, 0.5), 3.0)
    assert dist(one.position, (5.0, 2.0, 0.5)) < 0.12
    assert hypot(*one.drone.body.velocity) < 0.25
    await cf.land(3.0)
    went = one.did("go_to")[0].values
    assert went["duration"] >= 2.18 * 4.0
    assert not one.drone.supervisor.crashed
