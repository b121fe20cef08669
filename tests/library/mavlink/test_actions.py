"""What a vehicle does besides flying: through MAVSDK, in real time, all at once; and what it says it cannot."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pluto_fleet.autopilot.equipment import Around, fitted, sensors
from pluto_fleet.autopilot.server import MAKES, Server, let
from pluto_fleet.autopilot.vehicle import Asked, Build, Vehicle
from pluto_fleet.drones.protocol import ActionNotDone, DroneSetup, Rejected
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.mavlink.actions import shown_at
from pluto_fleet.mavlink.navigation import MavlinkVehicle
from pluto_fleet.mavlink.options import options_of
from pluto_fleet.process.surroundings import Surroundings
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import Feature, Source, WorldData
from pluto_fleet.shared.domain.model import Item, Photo
from tests.library.mavlink.together import Cases, came_of

PLANE = LocalPlane(47.397742, 8.545594, 488.0, bearing=0.5)
HOME = (5.0, 5.0, 0.0)
PILLS = Item(name="pills", mass=0.004)
AROUND = Surroundings(
    data=WorldData(
        sources=(Source(quantity="pm10", at=HOME[:2], peak=80.0, radius=3.0),),
        features=(Feature(kind="bloom", at=HOME[:2]), Feature(kind="bloom", at=(5.2, 5.0))),
    )
)
MEASURE: dict[str, object] = {"measure": {"pm10": "dust"}, "measure_seconds": 0.6}
GRIP: dict[str, object] = {"grip": {"number": 1, "seconds": 0.7}}


async def measures(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    assert flies.why_not("measure", {"quantity": "pm10"}) is None
    assert await flies.act("measure", {"quantity": "pm10"}, None) == pytest.approx(100.0, rel=0.01)
    assert await flies.read("pm10") == pytest.approx(100.0, rel=0.01)
    unnamed = flies.why_not("measure", {"quantity": "noise"})
    assert unnamed is not None
    assert unnamed.endswith(
        'it measures pm10; name its value in the fleet file: measure = { noise = "name" }'
    )


async def falls_silent(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    let(vehicle, "numb", True)
    with pytest.raises(ActionNotDone, match='tells its value "dust" no more'):
        await flies.act("measure", {"quantity": "pm10"}, None)
    why = flies.why_not("measure", {"quantity": "pm10"})
    assert why is not None and 'tells its value "dust" no more' in why


async def is_not_heard(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    why = flies.why_not("measure", {"quantity": "pm10"})
    assert why is not None
    assert (await flies.facts())["tells"] == "dust"
    assert 'tells no value "smog" (NAMED_VALUE_FLOAT): it tells dust; start what tells it' in why


async def grips(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """It opens before it closes: a PX4 comes with its gripper closed."""
    await flies.act("pick_item", {}, PILLS)
    assert vehicle.record.grips == [False, True]
    await flies.act("release_item", {}, PILLS)
    assert vehicle.record.grips == [False, True, False]


async def repeats(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """A command whose answer is lost is given again while it is carried out: that is refused for now."""
    let(vehicle, "unanswered", 1)
    await flies.act("release_item", {}, PILLS)
    assert vehicle.record.grips == [False]


async def grips_no_more(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    assert flies.why_not("pick_item", {}) is None
    let(vehicle, "slack", True)
    with pytest.raises(ActionNotDone, match="does not open its gripper: it could not do that"):
        await flies.act("pick_item", {}, PILLS)


async def cannot_grip(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """It is named in the fleet file, and its autopilot is not set up for it."""
    why = flies.why_not("pick_item", {})
    assert why is not None
    parameter = "GRIP_ENABLE to 1" if vehicle.build.make == "ardupilot" else "PD_GRIPPER_TYPE to 0"
    assert f"has no gripper: set {parameter}" in why
    with pytest.raises(ActionNotDone, match="has no gripper"):
        await flies.act("pick_item", {}, PILLS)


async def is_of_no_kind(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """An ArduPilot would accept what it does not do then."""
    kind = "GRIP_TYPE" if vehicle.build.make == "ardupilot" else "PD_GRIPPER_TYPE"
    let(vehicle, f"parameter {kind}", 0 if kind == "GRIP_TYPE" else -1)
    await flies.connect()
    assert f"has no gripper: set {kind} to" in str(flies.why_not("pick_item", {}))


async def has_none(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    why = flies.why_not("release_item", {})
    assert why is not None
    assert why.endswith("name its gripper in the fleet file: grip = { number = 1 }")
    with pytest.raises(Rejected, match="neither tells a value nor has a parameter dust_raw"):
        await flies.read("dust_raw")


async def sees(flies: MavlinkVehicle, vehicle: Vehicle) -> None:
    """What its camera says of its picture, a photo has."""
    vehicle.body.at[2] = 2.0
    photo = await flies.act("take_photo", {}, None)
    assert isinstance(photo, Photo)
    assert photo.sees == ("bloom", "bloom")
    assert photo.width == pytest.approx(1.6 * photo.position[2])


CASES: Cases = {
    measures: MEASURE,
    falls_silent: MEASURE,
    is_not_heard: {"measure": {"pm10": "smog"}},
    grips: GRIP,
    repeats: GRIP,
    grips_no_more: GRIP,
    cannot_grip: GRIP,
    is_of_no_kind: GRIP,
    has_none: {},
    sees: {},
}


@pytest.mark.process
@pytest.mark.long
@pytest.mark.parametrize("make", ["px4", "ardupilot"])
def test_it_does_what_it_is_fitted_for(make: str, tmp_path: Path) -> None:
    pytest.importorskip("mavsdk")
    failed = [one for one in asyncio.run(_all_at_once(make, tmp_path)) if one is not None]
    if failed:
        raise BaseExceptionGroup("some cases failed", failed)


async def _all_at_once(make: str, tmp_path: Path) -> list[BaseException | None]:
    """Return what came of each case."""
    home = PLANE.to_degrees(HOME)
    builds = [
        Build(
            id=case.__name__,
            system=number,
            home=home,
            make=make,
            grips=case is not cannot_grip,
            senses={"dust": "pm10"},
        )
        for number, case in enumerate(CASES, 1)
    ]
    server = Server(builds, Around(AROUND, PLANE))
    setup = DroneSetup(
        id="", uri=None, home=HOME, speed=5.0, options={}, folder=tmp_path, plane=PLANE
    )
    return await came_of(CASES, server, setup, connects=True)


GRAB = 1.0
RELEASE = 0.0


def test_a_px4_tells_when_its_gripper_is_there_and_another_order_breaks_it_off() -> None:
    vehicle = _vehicle("px4")
    assert _told(vehicle, GRAB) == "accepted"  # it is closed
    assert _told(vehicle, RELEASE) == "in progress"
    assert _told(vehicle, RELEASE) == "not now"
    assert _told(vehicle, GRAB) == "in progress"
    assert vehicle.done == [(211, 6)]
    vehicle.step(1.1)
    assert vehicle.done == [(211, 6), (211, 0)]
    assert _told(vehicle, 2.0) == "denied"
    assert vehicle.record.grips == [True]


def test_an_ardupilot_accepts_at_once_and_tells_nothing_more() -> None:
    vehicle = _vehicle("ardupilot")
    assert _told(vehicle, GRAB) == "accepted"
    assert vehicle.gripper.closed is None
    vehicle.step(0.6)
    assert _told(vehicle, GRAB) == "accepted"
    assert _told(vehicle, 2.0) == "failed"
    vehicle.parameters["GRIP_TYPE"].value = 0.0  # it is enabled, and of no kind
    assert _told(vehicle, RELEASE) == "accepted"
    vehicle.step(0.6)
    assert (vehicle.done, vehicle.record.grips) == ([], [True])


@pytest.mark.parametrize("make", MAKES)
def test_without_a_gripper_both_say_that_it_failed(make: str) -> None:
    vehicle = MAKES[make](Build(id="m1", system=1, home=PLANE.to_degrees(HOME)), None)
    assert _told(vehicle, GRAB) == "failed"


def _vehicle(make: str) -> Vehicle:
    return MAKES[make](Build(id="m1", system=1, home=PLANE.to_degrees(HOME), grips=True), None)


def _told(vehicle: Vehicle, action: float) -> str:
    """Return what it answers to an order to its gripper."""
    asked = Asked(
        command=211, values=(1.0, action, 0.0, 0.0), place=None, height=0.0, frame=0, exact=False
    )
    names = {0: "accepted", 1: "not now", 2: "denied", 4: "failed", 5: "in progress"}
    return names[vehicle.do(asked) or 0]


@pytest.mark.parametrize(
    ("address", "shown"),
    [
        ("mftp:///7.jpg", ((), 1.0)),
        ("mftp:///7.jpg?sharpness=0.4&sees=pest,bloom*2", (("bloom", "bloom", "pest"), 0.4)),
        ("http://10.0.0.2/7?sees=", ((), 1.0)),
        ("http://10.0.0.2/7?sees=a*b&sharpness=much", ((), 1.0)),
        ("http://[10/7?sharpness=nan", ((), 1.0)),
    ],
)
def test_a_camera_may_say_what_is_on_a_picture(
    address: str, shown: tuple[tuple[str, ...], float]
) -> None:
    assert shown_at(address) == shown


def test_a_simulated_vehicle_has_what_the_file_names_and_all_that_its_world_has() -> None:
    source = Source(quantity="carbon_monoxide", at=(0.0, 0.0), peak=1.0, radius=1.0)
    around = Surroundings(data=WorldData(sources=(source,)))
    given = {"measure": {"pm10": "dust"}, "grip": {"number": 2, "seconds": 3}}
    options = options_of(fitted(given, sensors(given, around.world)))
    assert options.grip is not None
    assert (options.grip.number, options.grip.seconds) == (2, 3.0)
    assert options.name_of("pm10") == "dust"
    assert options.name_of("noise") == "nothing"
    names = [options.name_of(one) for one in ("temperature", "carbon_monoxide")]
    assert len({"dust", "nothing", *names}) == 4
    assert all(len(one) <= 9 for one in options.measure.values())
    assert options_of(fitted({}, {})).grip is not None


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        (
            {"measure": {"pm10": "particulates"}},
            "its option measure must be a table of names of at",
        ),
        ({"grip": {}}, r"its option grip must be a table, such as \{ number = 1 \}"),
        ({"grip": {"parameter": "gripper.closed"}}, "its option grip must be a table, such as"),
        (
            {"camera": "192.168.4.1:5000"},
            'a MAVLink vehicle has no option "camera"; it has autopilot',
        ),
    ],
)
def test_what_is_no_option_is_said(given: dict[str, object], wanted: str) -> None:
    with pytest.raises(BadInput, match=wanted):
        options_of(given)
