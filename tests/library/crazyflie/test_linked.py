"""How links to simulated Crazyflies begin, are lost and end, through the unmodified cflib."""

from __future__ import annotations

import asyncio
import threading
import time
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.errors import LinkLost, NotReady
from pluto_fleet.drones.protocol import LINK_LOST, DroneSetup
from tests.kill.lives import eventually
from tests.library.crazyflie.hangar import FAST, PATIENCE, Outcomes, hangar, threads_left

pytest.importorskip("cflib")


async def test_closing_what_another_program_has_sent_up_lets_it_hover(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.navigation.connect()
        await one.navigation.takeoff(0.5, FAST)
        async with hangar(folder, uri=one.server.uris["cf1"]) as other:
            await other.navigation.connect()
            assert other.navigation.telemetry.flying
        assert one.flies and not one.did("land") and not one.did("setpoint")
        await one.navigation.connect()
        await one.navigation.land(FAST)


async def test_silence_in_the_air_is_a_lost_link_and_connecting_again_lands_it(
    folder: Path,
) -> None:
    async with hangar(folder) as one:
        cf = await one.up()
        flying = asyncio.create_task(cf.go_to((9.0, 2.0, 0.5), 1.0))
        await asyncio.sleep(0.5)
        await one.let("silent")
        began = time.monotonic()
        with pytest.raises(LinkLost, match="cf1 stopped answering"):
            await flying
        assert time.monotonic() - began < 10.0  # and not the twenty that the course takes
        assert (await one.hears(LINK_LOST)).reason.startswith("it has told nothing for")
        assert time.monotonic() - cf.telemetry.time > 0.9
        with pytest.raises(LinkLost, match="does not answer"):
            await cf.connect()
        await one.let("silent", False)
        await cf.connect()
        assert one.flies and cf.telemetry.flying
        await cf.hold()
        await cf.land(FAST)
        assert not one.flies and not one.did("setpoint")


async def test_a_drone_whose_port_is_closed_is_a_lost_link(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = await one.connected()
        await one.let("gone")
        await one.hears(LINK_LOST)
        with pytest.raises(LinkLost):
            await cf.hold()
        with pytest.raises(LinkLost, match="cf1 cannot be reached at udp://"):
            await cf.connect()
        await one.let("gone", False)
        await cf.connect()
        assert await cf.preflight() == []


async def test_an_empty_address_is_told_within_the_limit(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.let("silent")
        with pytest.raises(LinkLost, match=r"cf1 does not answer at udp://.*: nothing came in 5 s"):
            await one.navigation.connect()
        assert await one.navigation.preflight() == ["cf1 is not connected"]


async def test_who_is_slow_to_tell_its_tables_is_connected_to_by_and_by(folder: Path) -> None:
    async with hangar(folder, build=Build(id="cf8", home=(1.0, 2.0, 0.0))) as one:
        await one.let("latency", 0.1)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(1.0):
                await one.navigation.connect()
        threads = [thread.name for thread in threading.enumerate()]
        assert "cflib for cf8" in threads and "letting go of cf8" not in threads
        await one.navigation.connect()  # the same one goes on
        assert await one.navigation.preflight() == []


async def test_closing_while_connecting_ends_that(folder: Path) -> None:
    async with hangar(folder, build=Build(id="cf9", home=(1.0, 2.0, 0.0))) as one:
        await one.let("latency", 0.1)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.5):
                await one.navigation.connect()
        await one.navigation.close()
        assert not [task for task in asyncio.all_tasks() if "cf9" in task.get_name()]


async def test_firmware_without_a_supervisor_is_refused_with_what_to_flash(folder: Path) -> None:
    build = Build(id="cf1", home=(1.0, 2.0, 0.0), protocol=10)
    async with hangar(folder, build=build) as one:
        await one.navigation.connect()
        (reason,) = await one.navigation.preflight()
        assert "speaks protocol 10, 12 or later is needed: flash" in reason


async def test_the_emergency_stop_is_sent_to_a_drone_that_is_not_heard(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = await one.up()
        await one.let("silent")
        await one.hears(LINK_LOST)
        stopping = asyncio.create_task(cf.emergency_stop())
        await asyncio.sleep(0.1)
        await one.let("silent", False)
        await stopping
        assert one.drone.supervisor.locked


async def test_a_folder_that_takes_no_files_keeps_no_one_from_flying(folder: Path) -> None:
    async with hangar(folder / "not there") as one:
        await one.navigation.connect()
        assert await one.navigation.preflight() == []


async def test_one_that_was_just_switched_on_is_told_where_it_begins(folder: Path) -> None:
    build = Build(id="cf1", home=(0.1, 0.0, 0.0))
    async with hangar(folder, {"starts_at_home": True}, build) as one:
        await one.navigation.connect()
        assert [(command.what, command.values["value"]) for command in one.commands] == [
            ("set kalman.initialX", pytest.approx(0.1)),
            ("set kalman.initialY", 0.0),
            ("set kalman.initialZ", 0.0),
            ("set kalman.resetEstimation", 1.0),
            ("set kalman.resetEstimation", 0.0),
        ]
        assert await one.navigation.preflight() == []


async def test_one_that_has_flown_already_keeps_its_place(folder: Path) -> None:
    async with hangar(folder, {"starts_at_home": True}) as one:
        await one.navigation.connect()
        assert one.commands == []


async def test_without_a_uri_it_says_what_is_missing(folder: Path) -> None:
    setup = DroneSetup(
        id="cf1", uri=None, home=(0.0, 0.0, 0.0), speed=1.0, options={}, folder=folder
    )
    with pytest.raises(NotReady, match="cf1 has no uri in the fleet file"):
        await Crazyflie(setup).connect()


def test_no_thread_is_left(outcomes: Outcomes) -> None:
    """cflib has many threads, and so have we: when drones are closed, all of them end."""
    assert outcomes
    assert eventually(lambda: not threads_left(), PATIENCE), threads_left()
