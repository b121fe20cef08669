"""How links to simulated Crazyflies begin, are lost and end, through the unmodified cflib."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.protocol import LINK_LOST, LinkLost, NotReady
from tests.kit.unthreaded import passes, the_air
from tests.library.crazyflie.hangar import FAST, Hangar, drone, hangar, navigation


async def test_closing_what_another_program_has_sent_up_lets_it_hover(
    one: Hangar, folder: Path
) -> None:
    cf = await one.up()
    async with hangar(folder, uri=one.server.uris["cf1"]) as other:
        assert (await other.connected()).telemetry.flying
    assert one.flies and not one.did("land") and not one.did("setpoint")
    await cf.connect()
    await cf.land(FAST)
    assert not one.flies


async def test_silence_in_the_air_is_a_lost_link_and_connecting_again_lands_it(
    one: Hangar, up: Crazyflie
) -> None:
    flying = asyncio.create_task(up.go_to((9.0, 2.0, 0.5), 1.0))
    await passes(0.5)
    await one.let("silent")
    began = the_air().time()
    with pytest.raises(LinkLost, match="cf1 stopped answering"):
        await flying
    assert the_air().time() - began < 4.0  # and not the twenty that the course takes
    assert (await one.hears(LINK_LOST)).reason.startswith("it has told nothing for")
    assert the_air().time() - up.telemetry.time > 2.9
    with pytest.raises(LinkLost, match="does not answer"):
        await up.connect()
    await one.let("silent", False)
    await up.connect()
    assert one.flies and up.telemetry.flying
    await up.hold()
    await up.land(FAST)
    assert not one.flies and not one.did("setpoint")


@pytest.mark.parametrize(("silent", "stalled"), [(2.5, 0.0), (1.0, 2.9)])
async def test_a_leg_is_finished_in_a_short_silence(
    silent: float, stalled: float, one: Hangar, up: Crazyflie
) -> None:
    """The time in which this process could hear nothing is not counted."""
    flying = asyncio.create_task(up.go_to((4.0, 2.0, 0.5), 1.0))
    await passes(0.2)
    await one.let("silent")
    await passes(silent)
    the_air().advance(stalled)
    await passes(0.15)
    await one.let("silent", False)
    await flying
    assert one.position == pytest.approx((4.0, 2.0, 0.5), abs=0.15)
    assert len(one.did("go_to")) == 1 and not one.events


async def test_a_drone_whose_port_is_closed_is_a_lost_link(one: Hangar, cf: Crazyflie) -> None:
    await one.let("gone")
    await one.hears(LINK_LOST)
    with pytest.raises(LinkLost):
        await cf.hold()
    with pytest.raises(LinkLost, match="cf1 cannot be reached at udp://"):
        await cf.connect()
    await one.let("gone", False)
    await cf.connect()
    assert await cf.preflight() == []


async def test_who_is_slow_to_tell_its_tables_is_connected_to_by_and_by(one: Hangar) -> None:
    await one.let("latency", 0.1)
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(1.0):
            await one.navigation.connect()
    cf = await one.connected()
    assert await cf.preflight() == []
    asked = [command.what for command in one.record.commands].count("asked")
    assert asked == 1  # the same connection went on


@drone(build=Build(id="cf1", home=(1.0, 2.0, 0.0), protocol=10))
async def test_firmware_without_a_supervisor_is_refused_with_what_to_flash(cf: Crazyflie) -> None:
    (reason,) = await cf.preflight()
    assert "speaks protocol 10 (release 2025.09 or 2025.12), 12 or later is needed: flash" in reason


async def test_the_emergency_stop_is_sent_to_a_drone_that_is_not_heard(
    one: Hangar, up: Crazyflie
) -> None:
    await one.let("silent")
    await one.hears(LINK_LOST)
    stopping = asyncio.create_task(up.emergency_stop())
    await passes(0.1)
    await one.let("silent", False)
    await stopping
    assert one.drone.supervisor.locked


@drone(options={"starts_at_home": True}, build=Build(id="cf1", home=(0.1, 0.0, 0.0)))
async def test_one_that_was_just_switched_on_is_told_where_it_begins(
    one: Hangar, cf: Crazyflie
) -> None:
    assert [(command.what, command.values["value"]) for command in one.commands] == [
        ("set kalman.initialX", pytest.approx(0.1)),
        ("set kalman.initialY", 0.0),
        ("set kalman.initialZ", 0.0),
        ("set kalman.resetEstimation", 1.0),
        ("set kalman.resetEstimation", 0.0),
    ]
    assert await cf.preflight() == []


@drone(options={"starts_at_home": True}, build=Build(id="cf1", home=(0.1, 0.0, 0.0)))
async def test_one_that_is_found_again_in_the_air_keeps_its_place(
    one: Hangar, up: Crazyflie
) -> None:
    await one.let("silent")
    await one.hears(LINK_LOST)
    await one.let("silent", False)
    await up.connect()
    assert one.flies and len(one.did("set kalman.initialX")) == 1


async def test_without_a_uri_it_says_what_is_missing(folder: Path) -> None:
    with pytest.raises(NotReady, match="cf1 has no uri in the fleet file"):
        await navigation(Build(id="cf1", home=(0.0, 0.0, 0.0)), None, folder).connect()
