"""Simulated Crazyflies that do not know well where they are: before a take-off, and in the air."""

from __future__ import annotations

import asyncio
from math import dist

import pytest

from pluto_fleet.crazyflie import preflight
from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.protocol import POSITION_LOST, PositionLost
from tests.kit.unthreaded import passes, the_air
from tests.library.crazyflie.hangar import FAST, Hangar, drone


async def test_one_that_is_unsure_for_a_moment_is_waited_for(one: Hangar, cf: Crazyflie) -> None:
    """A person may just pass between it and its beacons."""
    await one.let("unsure")
    taking_off = asyncio.create_task(cf.takeoff(0.5, FAST))
    await passes(2.0)
    assert not one.did("arm")
    await one.let("unsure", False)
    await taking_off
    assert one.flies


@drone(options={"sure_within": 0.8})
async def test_how_sure_it_must_be_is_said_by_the_fleet_file(one: Hangar, cf: Crazyflie) -> None:
    await one.let("unsure")
    assert await cf.preflight() == []


GRIP = {"parameter": "gripper.closed", "pick": 1, "release": 0}


@drone(options={"measure": {"temperature": "bme.temp"}, "grip": GRIP})
async def test_one_that_loses_its_place_in_the_air_arrives_nowhere_and_does_nothing_there(
    one: Hangar, up: Crazyflie
) -> None:
    await one.let("unsure")
    with pytest.raises(PositionLost, match=r"cf1 does not know where it is: it may be 0\.71 m"):
        await up.go_to((1.3, 2.0, 0.5), FAST)
    assert (await one.hears(POSITION_LOST)).reason.startswith("it may be 0.71 m from where")
    for action in ("measure", "pick_item"):
        with pytest.raises(PositionLost):
            await up.act(action, {}, None)
    assert not one.did("set gripper.closed")
    await up.hold()  # as well as it can
    await up.land(FAST)
    assert not one.flies and [event.kind for event in one.events] == [POSITION_LOST]


async def test_one_that_has_lost_its_place_lands_in_half_the_time(one: Hangar) -> None:
    """It drifts ever farther; firmware took 8.7 s from here, and drifted 1.9 m."""
    cf = await one.connected()
    await cf.takeoff(1.5, 0.5)
    await passes(15.0)
    await one.let("fixes", False)
    await one.hears(POSITION_LOST)
    began = the_air().time()
    x, y, _ = one.position
    await cf.hold()
    await cf.land(0.5)
    assert the_air().time() - began < 6.0  # two of them until it tells that it has landed
    assert dist(one.position[:2], (x, y)) < 0.9
    assert not one.flies and not one.drone.supervisor.locked


async def test_after_an_emergency_stop_it_does_not_say_that_it_does_not_know_its_place(
    one: Hangar, up: Crazyflie
) -> None:
    await up.emergency_stop()
    await one.let("unsure")
    await passes(2.0)
    assert await up.preflight() == ["it has locked its motors: switch it off and on"]
    assert "0.00 m" not in preflight._uncertain(0.0, 0.07)


@drone(options={"measure": {"temperature": "bme.temp"}, "measure_seconds": 0.2})
async def test_one_that_doubts_its_place_for_a_moment_does_there_what_it_came_for(
    one: Hangar, up: Crazyflie
) -> None:
    await one.let("unsure")
    await passes(0.6)  # until it has told so
    measuring = asyncio.create_task(up.act("measure", {}, None))
    await passes(0.2)
    assert not measuring.done()
    await one.let("unsure", False)
    assert await measuring == pytest.approx(21.0, abs=0.1)
    await up.land(FAST)
    assert one.events == []


@drone(build=Build(id="cf1", home=(1.0, 2.0, 0.0), noise=0.15))
async def test_one_that_goes_by_radio_beacons_is_sure_enough(one: Hangar, cf: Crazyflie) -> None:
    assert one.drone.variance > 0.0025
    await cf.takeoff(0.5, FAST)
    await cf.go_to((1.3, 2.0, 0.5), FAST)
    await cf.land(FAST)
    assert one.events == []


async def test_one_that_sees_its_beacons_no_more_on_its_way_does_not_arrive(
    one: Hangar, up: Crazyflie
) -> None:
    """Its firmware flies on, reports no fault, and would be there by its own word."""
    flying = asyncio.create_task(up.go_to((4.0, 2.0, 0.5), FAST))
    while one.position[0] < 1.5:
        await asyncio.sleep(0.02)
    await one.let("fixes", False)
    with pytest.raises(PositionLost, match="does not see its beacons any more"):
        await flying
    await one.hears(POSITION_LOST)
    await up.hold()
    await up.land(FAST)
    assert not one.flies


@drone(options={"starts_at_home": True}, build=Build(id="cf1", home=(0.1, 0.0, 0.0)))
async def test_one_that_goes_by_the_ground_alone_never_knows_its_place_and_flies(
    one: Hangar,
) -> None:
    cf = one.navigation
    await one.let("unsure")
    await cf.connect()
    await cf.takeoff(0.5, FAST)
    await cf.go_to((0.4, 0.0, 0.5), FAST)
    await cf.land(FAST)
    assert one.events == []
