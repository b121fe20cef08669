"""What becomes of a command when something goes wrong with a vehicle: flown through MAVSDK, in real time, all at once."""

from __future__ import annotations

import asyncio
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from pluto_fleet.autopilot.server import Server, let
from pluto_fleet.autopilot.vehicle import Build, Vehicle
from pluto_fleet.drones.protocol import (
    POSITION_LOST,
    ActionNotDone,
    Crashed,
    DroneSetup,
    LinkLost,
    NotReady,
    Rejected,
)
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.mavlink.navigation import MavlinkVehicle
from pluto_fleet.mavlink.state import ON_GROUND
from pluto_fleet.process import respawn
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Photo
from tests.library.mavlink.together import Cases, came_of

pytestmark = pytest.mark.process

PLANE = LocalPlane(47.397742, 8.545594, 488.0)
HOME = (5.0, 5.0, 0.0)
FAR = (40.0, 5.0, 3.0)
MAP = Airspace(size=(50.0, 20.0), ceiling=10.0)
_SOON = 0.5
"""Seconds in which an order would have come: it takes some milliseconds."""


async def pilot(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """A command ends when a pilot takes the vehicle over; nothing is said against that."""
    let(vehicle, "parameter RTL_RETURN_ALT", 4)
    going = await setting_out(flies, vehicle)
    let(vehicle, "pilot", "return")
    with pytest.raises(Rejected, match="acts by itself: it is in the mode Return"):
        await going
    await flies.hold()
    assert vehicle.doing.value == "return"  # it was not told to hold instead


async def blind(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    going = await setting_out(flies, vehicle)
    let(vehicle, "blind", True)
    with pytest.raises(Rejected, match=r"in the mode Land \(Failsafe activated: no position"):
        await going


async def unready(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    let(vehicle, "unready", "Compass 0 uncalibrated")
    await flies.connect()
    with pytest.raises(NotReady, match="would not arm"):
        await flies.takeoff(3.0, 1.0)
    assert not vehicle.armed


async def refused(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    await flies.connect()
    let(vehicle, "denied", 1)
    with pytest.raises(Rejected, match="it denies that"):
        await flies.takeoff(3.0, 1.0)
    assert not vehicle.armed


async def unanswered(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """A command whose answer is lost is sent again; it has the same effect."""
    await flies.connect()
    await flies.takeoff(3.0, 1.0)
    let(vehicle, "unanswered", 1)
    await flies.go_to((8.0, 5.0, 3.0), 3.0)
    assert vehicle.record.orders.count("192: 0") == 2


async def blank(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """That a camera accepts a command is no picture."""
    await flies.connect()
    let(vehicle, "blank", True)
    with pytest.raises(ActionNotDone, match="tells of no picture"):
        await flies.act("take_photo", {}, None)
    let(vehicle, "blank", False)
    taken = await flies.act("take_photo", {}, None)
    assert isinstance(taken, Photo)
    assert taken.position == pytest.approx(HOME, abs=0.05)


async def other_make(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    with pytest.raises(NotReady, match="its autopilot is PX4, and not ardupilot"):
        await flies.connect()


async def silent(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    going = await setting_out(flies, vehicle)
    let(vehicle, "silent", True)
    with pytest.raises(LinkLost):
        await going
    assert vehicle.armed


async def beyond(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """Its autopilot keeps the map by itself: it refuses places outside, and stops where the wind takes it there."""
    going = await setting_out(flies, vehicle)
    corners = [PLANE.to_metres((*corner, PLANE.altitude))[:2] for corner in vehicle.fence]
    around = [(-5.0, -5.0), (55.0, -5.0), (55.0, 25.0), (-5.0, 25.0)]
    assert corners == [pytest.approx(one, abs=0.05) for one in around]
    with pytest.raises(Rejected, match="outside geofence"):
        await flies.go_to((70.0, 5.0, 3.0), 2.0)
    with pytest.raises(Rejected, match="outside geofence"):
        await flies.go_to((40.0, 5.0, 66.0), 2.0)  # it would return at a height of 60 m
    let(vehicle, "parameter GF_ACTION", 5)
    let(vehicle, "blown", 20.0)
    with pytest.raises(Rejected, match=r"in the mode Land \(.*Failsafe activated: geofence"):
        await going
    let(vehicle, "blown", 0.0)


async def beyond_ardupilot(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """Of its kinds of fences the circle is left out: a map may be larger than that."""
    let(vehicle, "parameter FENCE_RADIUS", 3)
    let(vehicle, "parameter RTL_ALT", 400)
    going = await setting_out(flies, vehicle)
    with pytest.raises(Rejected, match="it could not do that"):
        await flies.go_to((70.0, 5.0, 3.0), 2.0)
    let(vehicle, "blown", 20.0)
    with pytest.raises(Rejected, match=r"in the mode RTL \(Fence Breached"):
        await going
    let(vehicle, "blown", 0.0)


async def on_the_way(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """Photos are asked for before the last has come, one is not taken, and it flies on."""
    going = await setting_out(flies, vehicle)
    first, second = await asyncio.gather(*(flies.trigger("take_photo", {}) for _ in range(2)))
    let(vehicle, "blank", True)
    with pytest.raises(ActionNotDone, match="tells of no picture"):
        await flies.trigger("take_photo", {})
    let(vehicle, "blank", False)
    last = await flies.trigger("take_photo", {})
    taken = [first, second, last]
    assert all(isinstance(one, Photo) for one in taken)
    places = [one.position[0] for one in taken if isinstance(one, Photo)]
    assert places == sorted(places)
    assert len(vehicle.record.photos) == 3
    await going


async def restarted(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """One that fell does not take off before a person has looked after it, even if it says that it is well."""
    going = await setting_out(flies, vehicle)
    let(vehicle, "reboot", True)
    with pytest.raises(Crashed, match="its motors stopped"):
        await going
    while vehicle.high:
        await asyncio.sleep(0.1)
    with pytest.raises(NotReady, match="nobody has looked after it"):
        await flies.takeoff(3.0, 1.0)
    assert not vehicle.armed
    await flies.looked_after()
    assert await flies.preflight() == []


async def stopped_as_it_lands(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """One that has touched down is told nothing until its motors are off: it would stay there, and seem to have fallen."""
    await flies.connect()
    await flies.takeoff(3.0, 1.0)
    landing = asyncio.create_task(flies.land(1.0))
    while vehicle.high:
        await asyncio.sleep(0.02)
    while flies._state.landed != ON_GROUND:
        await asyncio.sleep(0.02)
    assert vehicle.armed
    landing.cancel()
    await flies.hold()
    assert not vehicle.armed
    with pytest.raises(Rejected, match="stands on the ground"):
        await flies.go_to((8.0, 5.0, 3.0), 2.0)
    assert await flies.preflight() == []


async def slow(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """One that is heard late, as by a telemetry radio, flies, and keeps no other from being heard."""
    let(vehicle, "late", 0.3)
    await flies.connect()
    await flies.takeoff(3.0, 1.0)
    await flies.go_to((8.0, 5.0, 3.0), 3.0)
    assert vehicle.body.at[0] == pytest.approx(3.0, abs=0.6)


async def twin(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """Where two tell that they are one, neither takes off: which flies where is not known."""
    await flies.connect()
    async with asyncio.timeout(10.0):
        while not await flies.preflight():
            await asyncio.sleep(0.05)  # until their places have jumped often enough
    with pytest.raises(NotReady, match="several vehicles tell that they are this one: give each"):
        await flies.takeoff(3.0, 1.0)
    assert not vehicle.armed


async def handed_back(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """One that its pilot gives back takes orders again; before, it is not even told to land."""
    let(vehicle, "parameter RTL_RETURN_ALT", 4)
    going = await setting_out(flies, vehicle)
    let(vehicle, "pilot", "return")
    with pytest.raises(Rejected, match="acts by itself"):
        await going
    landing = asyncio.create_task(flies.land(1.0))
    await asyncio.sleep(_SOON)
    let(vehicle, "pilot", "go")
    assert "21: 0" not in vehicle.record.orders
    await landing
    assert vehicle.record.landings == 1


async def by_hand(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """A pilot may land it in any mode: that its motors stop then is no crash."""
    going = await setting_out(flies, vehicle)
    let(vehicle, "pilot", "sink")
    with pytest.raises(Rejected, match="in the mode Position"):
        await going
    await flies.land(1.0)
    assert await flies.preflight() == []


async def answered_late(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """An ArduPilot denies a take-off that it is told a second time, as the first answer was lost; it rises all the same."""
    await flies.connect()
    let(vehicle, "lost_answer", 22)
    await flies.takeoff(3.0, 1.0)
    assert vehicle.record.orders.count("22: 4") == 1
    let(vehicle, "lost_answer", 21)
    await flies.land(1.0)
    assert vehicle.record.landings == 1


async def homed(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """It rises above its home of when it is armed; one that is set anew in the air makes its height unknown."""
    let(vehicle, "raised", 2.5)
    let(vehicle, "pilot", "return")  # nor does its mode on the ground matter
    await flies.connect()
    await flies.takeoff(3.0, 1.0)
    assert vehicle.body.at[2] == pytest.approx(3.0, abs=0.5)
    let(vehicle, "raised", -2.0)
    assert "its home was set 2 m lower in flight" in await told(flies, POSITION_LOST)


async def joined(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """Another one that is switched on with its id has not crashed it: it is landed, as both obey."""
    going = await setting_out(flies, vehicle)
    let(BESIDE[0], "system", vehicle.build.system)
    assert "several vehicles" in await told(flies, POSITION_LOST)
    going.cancel()
    await flies.land(1.0)
    async with asyncio.timeout(20.0):
        while vehicle.armed:
            await asyncio.sleep(0.1)
    assert vehicle.record.landings == 1


async def wanting(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """It does not take off without what a flight needs of it."""
    for fault, why in (
        ("homeless", "does not know its home position"),
        ("gaugeless", "does not tell how full its battery is"),
        ("unfenced", "no fence around the map"),
        ("stubborn", "GF_MAX_VER_DIST was not set"),
    ):
        let(vehicle, fault, True)
        await flies.connect()
        assert why in "; ".join(await flies.preflight())
        let(vehicle, fault, False)
    await flies.connect()
    assert await flies.preflight() == []


async def told(flies: MavlinkVehicle, kind: str) -> str:
    """Return the reason of its next event of a kind."""
    async with asyncio.timeout(10.0):
        async for event in flies.events():
            if event.kind == kind:
                return event.reason
    raise AssertionError


BESIDE: list[Vehicle] = []
"""One that no fleet file has."""

CASES: Cases = {
    pilot: {},
    blind: {},
    unready: {},
    refused: {},
    unanswered: {},
    blank: {},
    other_make: {"autopilot": "ardupilot"},
    silent: {},
    beyond: {},
    slow: {},
    stopped_as_it_lands: {},
    restarted: {},
    twin: {},
    on_the_way: {},
    beyond_ardupilot: {"autopilot": "ardupilot"},
    handed_back: {},
    by_hand: {},
    answered_late: {},
    homed: {},
    joined: {},
    wanting: {},
}


ARDUPILOTS = (beyond_ardupilot, answered_late)


async def setting_out(flies: MavlinkVehicle, vehicle: Vehicle) -> asyncio.Task[None]:
    """Return a flight that is on its way."""
    await flies.connect()
    await flies.takeoff(3.0, 1.0)
    going = asyncio.create_task(flies.go_to(FAR, 2.0))
    while vehicle.body.at[0] < 2.0:
        await asyncio.sleep(0.02)
    return going


@pytest.mark.long
def test_each_fault_ends_the_command_that_it_keeps_from_being_done(tmp_path: Path) -> None:
    pytest.importorskip("mavsdk")
    failed = [one for one in asyncio.run(_all_at_once(tmp_path)) if one is not None]
    if failed:
        raise BaseExceptionGroup("some cases failed", failed)


async def _all_at_once(tmp_path: Path) -> list[BaseException | None]:
    """Return what came of each case."""
    home = PLANE.to_degrees(HOME)
    builds = [
        Build(case.__name__, number, home, make="ardupilot" if case in ARDUPILOTS else "px4")
        for number, case in enumerate(CASES, 1)
    ]
    (one,) = (build for build in builds if build.id == twin.__name__)
    server = Server([*builds, replace(one, id="other", home=PLANE.to_degrees((8.0, 5.0, 0.0)))])
    BESIDE[:] = [server.join(replace(one, id="beside", system=200))]
    setup = DroneSetup(
        id="",
        uri=None,
        home=HOME,
        speed=5.0,
        options={},
        folder=tmp_path,
        plane=PLANE,
        airspace=MAP,
    )
    return await came_of(CASES, server, setup)


@pytest.mark.long
def test_who_is_there_is_heard_by_anybody() -> None:
    """Cameras speak as well, and are no vehicles."""
    pytest.importorskip("mavsdk")
    assert asyncio.run(_scanned()) == (["m3", "m7"], ["m3", "m7"])


async def _scanned() -> tuple[list[str], list[str]]:
    """Return which vehicles were found, and which are there."""
    home = PLANE.to_degrees(HOME)
    server = Server([Build(f"m{number}", number, home) for number in (7, 3)])
    await server.start()
    try:
        found = await MavlinkVehicle.scan(
            {"addresses": [f"mavlink+udp://127.0.0.1:{server.port}?system=1"]}
        )
    finally:
        await server.close()
    there = {uri: id for id, uri in server.uris.items()}
    return [there[uri] for uri in found], sorted(there.values())


def test_heartbeats_end_with_those_of_the_gateway() -> None:
    """A gateway that hangs must not look to vehicles like a ground station that watches them."""
    pytest.importorskip("mavsdk")
    process = subprocess.Popen(
        respawn.library("mavsdk"),
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdin is not None and process.stderr is not None
    with process:
        assert process.wait(20) == 1
        assert "the gateway says nothing" in process.stderr.read()
