"""Flights of simulated Crazyflies through the unmodified cflib, over UDP and in real time.

All of them fly at once, when the first is asked how its own went: each has a drone of its own.
"""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Awaitable, Callable
from math import dist, inf, nan
from pathlib import Path

import pytest

from plutoc_runtime.crazyflie.navigation import Crazyflie
from plutoc_runtime.crtp.drone import Build
from plutoc_runtime.drones import (
    BATTERY_LOW,
    CRASHED,
    LINK_LOST,
    LOCKED,
    Crashed,
    DroneSetup,
    LinkLost,
    Locked,
    NotReady,
    OutsideArea,
    Rejected,
)
from tests.crazyflie.hangar import FAST, hangar

pytest.importorskip("cflib")
pytestmark = pytest.mark.filterwarnings(
    # a thread of cflib's falls over a link that vanishes while it sends; what waits for it is freed
    "ignore::pytest.PytestUnhandledThreadExceptionWarning"
)

Flight = Callable[[Path], Awaitable[None]]
FLIGHTS: list[Flight] = []


def flight(flown: Flight) -> Flight:
    """Let this fly with the others."""
    FLIGHTS.append(flown)
    return flown


@flight
async def it_takes_off_flies_and_lands_where_it_says(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        assert await cf.preflight() == []
        await cf.takeoff(0.8, FAST)
        assert dist(one.position, (1.0, 2.0, 0.8)) < 0.12
        await cf.go_to((1.5, 2.0, 0.8), FAST)
        assert dist(one.position, (1.5, 2.0, 0.8)) < 0.12
        assert cf.telemetry.flying and cf.telemetry.battery_level > 0.9
        await cf.land(FAST)
        assert not one.flies and not cf.telemetry.flying
        assert not one.did("setpoint")


@flight
async def closing_in_the_air_lands_first_and_cuts_nothing(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        await cf.close()
        assert not one.flies and not one.drone.supervisor.locked
        assert one.did("land") and not one.did("setpoint") and not one.did("emergency stop")


@flight
async def closing_what_somebody_else_has_sent_up_lets_it_hover(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.navigation.connect()
        await one.navigation.takeoff(0.5, FAST)
        async with hangar(folder, uri=one.server.uris["cf1"]) as other:
            await other.navigation.connect()
            assert other.navigation.telemetry.flying
        assert one.flies and not one.did("land") and not one.did("setpoint")
        await one.navigation.connect()
        await one.navigation.land(FAST)


@flight
async def a_course_that_is_broken_off_ends_in_a_hover_nearby(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        flying = asyncio.create_task(cf.go_to((4.0, 2.0, 0.5), 1.0))
        while one.position[0] < 2.0:
            await asyncio.sleep(0.02)
        flying.cancel()
        await asyncio.wait({flying})
        await cf.hold()
        assert 2.0 < one.position[0] < 2.8
        assert one.drone.body.velocity == pytest.approx((0.0, 0.0, 0.0), abs=0.01)


@flight
async def hold_and_land_do_nothing_on_the_ground(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.navigation.connect()
        await one.navigation.hold()
        await one.navigation.land(FAST)
        assert one.deeds == []


@flight
async def what_cannot_be_flown_is_refused_before_anything_moves(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        with pytest.raises(Rejected, match="must take off first"):
            await cf.go_to((1.0, 2.0, 1.0), 1.0)
        for target in ((nan, 2.0, 1.0), (inf, 2.0, 1.0), (1.0, 2.0, -0.1)):
            with pytest.raises(OutsideArea):
                await cf.go_to(target, 1.0)
        for speed in (0.0, -1.0, nan):
            with pytest.raises(Rejected, match="above 0"):
                await cf.takeoff(1.0, speed)
        with pytest.raises(OutsideArea):
            await cf.takeoff(-1.0, 1.0)
        assert one.deeds == []


@flight
async def lost_packets_are_sent_again(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.let("loss", 0.05)
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        for x in (1.5, 1.0):
            await cf.go_to((x, 2.0, 0.5), FAST)
            assert dist(one.position, (x, 2.0, 0.5)) < 0.12
        await cf.land(FAST)
        assert not one.flies


@flight
async def a_drone_that_is_busy_is_a_refusal_and_is_disarmed(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await one.let("busy")
        with pytest.raises(Rejected, match="refuses the command takeoff"):
            await cf.takeoff(0.5, FAST)
        assert not one.flies and not one.drone.supervisor.armed


@flight
async def silence_in_the_air_is_a_lost_link_and_connecting_again_lands_it(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        flying = asyncio.create_task(cf.go_to((9.0, 2.0, 0.5), 1.0))
        await asyncio.sleep(0.5)
        await one.let("silent")
        began = time.monotonic()
        with pytest.raises(LinkLost, match="cf1 stopped answering"):
            await flying
        assert time.monotonic() - began < 5.0  # and not the twenty that the course takes
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


@flight
async def a_drone_whose_port_is_closed_is_a_lost_link(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await one.let("gone")
        await one.hears(LINK_LOST)
        with pytest.raises(LinkLost):
            await cf.hold()
        with pytest.raises(LinkLost, match="cf1 cannot be reached at udp://"):
            await cf.connect()
        await one.let("gone", False)
        await cf.connect()
        assert await cf.preflight() == []


@flight
async def nobody_there_is_said_within_the_limit(folder: Path) -> None:
    async with hangar(folder) as one:
        await one.let("silent")
        with pytest.raises(LinkLost, match=r"cf1 does not answer at udp://.*: nothing came in 5 s"):
            await one.navigation.connect()
        assert await one.navigation.preflight() == ["cf1 is not connected"]


@flight
async def who_is_slow_to_tell_its_tables_is_connected_to_by_and_by(folder: Path) -> None:
    async with hangar(folder, build=Build(id="cf8", home=(1.0, 2.0, 0.0))) as one:
        await one.let("latency", 0.1)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(1.0):
                await one.navigation.connect()
        threads = [thread.name for thread in threading.enumerate()]
        assert "cflib for cf8" in threads and "letting go of cf8" not in threads
        await one.navigation.connect()  # the same one goes on
        assert await one.navigation.preflight() == []


@flight
async def closing_while_connecting_ends_that(folder: Path) -> None:
    async with hangar(folder, build=Build(id="cf9", home=(1.0, 2.0, 0.0))) as one:
        await one.let("latency", 0.1)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.5):
                await one.navigation.connect()
        await one.navigation.close()
        assert not [task for task in asyncio.all_tasks() if "cf9" in task.get_name()]


@flight
async def a_drone_that_tumbles_has_crashed(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        flying = asyncio.create_task(cf.go_to((9.0, 2.0, 0.5), 1.0))
        await asyncio.sleep(0.5)
        await one.let("tumble")
        with pytest.raises(Crashed, match="cf1 has tumbled or crashed"):
            await flying
        assert (await one.hears(CRASHED)).reason == "it lies on its back or has crashed"
        assert await cf.preflight() == ["it lies on its back or has crashed"]
        with pytest.raises(Crashed):
            await cf.takeoff(0.5, FAST)


@flight
async def a_drone_that_is_locked_says_so_and_what_to_do(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await one.let("lock")
        assert (await one.hears(LOCKED)).reason.endswith("switch it off and on")
        assert await cf.preflight() == ["it has locked its motors: switch it off and on"]
        with pytest.raises(Locked):
            await cf.takeoff(0.5, FAST)


@flight
async def a_battery_that_is_low_for_three_seconds_is_told_once(folder: Path) -> None:
    async with hangar(folder, {"least_voltage": 3.0}) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        await one.let("volts", 3.15)
        event = await one.hears(BATTERY_LOW)
        assert event.reason.startswith("its battery is down to 3.1")
        assert 0.0 < cf.telemetry.battery_level < 0.1
        await cf.land(FAST)
        assert [event.kind for event in one.events] == [BATTERY_LOW]


@flight
async def preflight_says_all_that_is_wrong(folder: Path) -> None:
    options = {"decks": ["bcLighthouse4", "bcLoco"]}
    build = Build(id="cf1", home=(1.0, 2.0, 0.0), level=0.05)
    async with hangar(folder, options, build) as one:
        cf = one.navigation
        await one.let("unsure")
        await cf.connect()
        empty, unsure, deck = await cf.preflight()
        assert empty.startswith("its battery has 3.") and empty.endswith("charge it")
        assert unsure.startswith("it is not sure where it is: a variance of 0.5000 m²")
        assert deck.startswith('it has no deck "bcLoco": it has bc')
        with pytest.raises(NotReady, match="cf1 is not ready: its battery"):
            await cf.takeoff(0.5, FAST)
        assert not one.did("arm")


@flight
async def firmware_without_a_supervisor_is_refused_with_what_to_flash(folder: Path) -> None:
    build = Build(id="cf1", home=(1.0, 2.0, 0.0), protocol=10)
    async with hangar(folder, build=build) as one:
        await one.navigation.connect()
        (reason,) = await one.navigation.preflight()
        assert "speaks protocol 10, 12 or later is needed: flash" in reason


@flight
async def the_emergency_stop_stops_in_the_air(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        flying = asyncio.create_task(cf.go_to((9.0, 2.0, 0.5), 1.0))
        await asyncio.sleep(0.5)
        await cf.emergency_stop()
        assert one.drone.supervisor.locked
        with pytest.raises((Locked, Crashed)):
            await flying


@flight
async def the_emergency_stop_is_sent_to_a_drone_that_is_not_heard(folder: Path) -> None:
    async with hangar(folder) as one:
        cf = one.navigation
        await cf.connect()
        await cf.takeoff(0.5, FAST)
        await one.let("silent")
        await one.hears(LINK_LOST)
        stopping = asyncio.create_task(cf.emergency_stop())
        await asyncio.sleep(0.1)
        await one.let("silent", False)
        await stopping
        assert one.drone.supervisor.locked


@flight
async def a_folder_that_takes_no_files_keeps_nobody_from_flying(folder: Path) -> None:
    async with hangar(folder / "not there") as one:
        await one.navigation.connect()
        assert await one.navigation.preflight() == []


@flight
async def a_drone_that_cannot_find_itself_flies_by_what_others_see(folder: Path) -> None:
    build = Build(id="cf1", home=(1.0, 2.0, 0.0), knows_where=False)
    async with hangar(folder, build=build) as one:
        cf = one.navigation
        await cf.connect()

        async def see() -> None:
            while True:
                await cf.locate(one.position)
                await asyncio.sleep(0.05)

        seeing = asyncio.create_task(see())
        await asyncio.sleep(1.5)
        assert await cf.preflight() == []
        seeing.cancel()
        await asyncio.wait({seeing})


@flight
async def one_that_was_just_switched_on_is_told_where_it_begins(folder: Path) -> None:
    build = Build(id="cf1", home=(0.1, 0.0, 0.0))
    async with hangar(folder, {"starts_at_home": True}, build) as one:
        await one.navigation.connect()
        assert [(deed.what, deed.values["value"]) for deed in one.deeds] == [
            ("set kalman.initialX", pytest.approx(0.1)),
            ("set kalman.initialY", 0.0),
            ("set kalman.initialZ", 0.0),
            ("set kalman.resetEstimation", 1.0),
            ("set kalman.resetEstimation", 0.0),
        ]
        assert await one.navigation.preflight() == []


@flight
async def one_that_has_flown_already_keeps_its_place(folder: Path) -> None:
    async with hangar(folder, {"starts_at_home": True}) as one:
        await one.navigation.connect()
        assert one.deeds == []


@flight
async def without_a_uri_it_says_what_is_missing(folder: Path) -> None:
    setup = DroneSetup(
        id="cf1", uri=None, home=(0.0, 0.0, 0.0), speed=1.0, options={}, folder=folder
    )
    with pytest.raises(NotReady, match="cf1 has no uri in the fleet file"):
        await Crazyflie(setup).connect()


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory: pytest.TempPathFactory) -> dict[Flight, BaseException | None]:
    """Fly all of them, and return what each has come to."""

    async def fly() -> list[BaseException | None]:
        folders = (tmp_path_factory.mktemp("flight") for _ in FLIGHTS)
        flown = (one(folder) for one, folder in zip(FLIGHTS, folders, strict=True))
        return await asyncio.gather(*flown, return_exceptions=True)

    return dict(zip(FLIGHTS, asyncio.run(fly()), strict=True))


@pytest.mark.parametrize("flown", FLIGHTS, ids=lambda flown: flown.__name__)
def test_in_flight(flown: Flight, outcomes: dict[Flight, BaseException | None]) -> None:
    """Each flight goes as its name says."""
    outcome = outcomes[flown]
    if outcome is not None:
        raise outcome


def test_no_thread_is_left(outcomes: dict[Flight, BaseException | None]) -> None:
    """cflib has many threads, and so have we: when drones are closed, all of them end."""
    assert len(outcomes) == len(FLIGHTS)
    left = [thread.name for thread in threading.enumerate() if thread.name != "MainThread"]
    assert [name for name in left if not name.startswith(("pytest", "execnet"))] == []
