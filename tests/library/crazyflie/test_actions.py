"""What a Crazyflie does at the end of a trip, on simulated drones; and what it says it cannot."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from itertools import groupby
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.equipment import camera, picture, port_of
from pluto_fleet.drones.protocol import ActionNotDone, NotReady, Rejected
from pluto_fleet.shared.domain.model import Item, Photo, Point, Sighting
from tests.library.crazyflie.hangar import FAST, Hangar, drone, hangar

PILLS = Item(name="pills", mass=0.004)
GRIP = {"parameter": "gripper.closed", "pick": 1, "release": 0, "seconds": 0.1}


@drone(
    options={"measure": {"temperature": "bme.temp", "dust": "dust.pm25"}, "measure_seconds": 0.3}
)
async def test_it_measures_what_the_fleet_file_names(cf: Crazyflie) -> None:
    for _ in range(3):  # its block of the log comes and goes
        assert await cf.act("measure", {}, None) == pytest.approx(21.0, abs=0.1)
    assert cf.why_not("measure", {"quantity": "temperature"}) is None
    reason = 'cf1 has no log variable "dust.pm25"'
    assert cf.why_not("measure", {"quantity": "dust"}) == reason
    with pytest.raises(ActionNotDone, match="no log variable"):
        await cf.act("measure", {"quantity": "dust"}, None)
    unknown = cf.why_not("measure", {"quantity": "light"})
    assert unknown is not None and 'measure = { light = "group.name" }' in unknown


@drone(options={"grip": GRIP})
async def test_it_picks_and_releases_by_a_parameter(one: Hangar, cf: Crazyflie) -> None:
    await cf.act("pick_item", {}, PILLS)
    assert one.drone.parameters["gripper.closed"] == 1
    await cf.act("release_item", {}, PILLS)
    assert one.drone.parameters["gripper.closed"] == 0


@drone(options={"grip": {**GRIP, "parameter": "hook.open"}})
async def test_what_it_has_not_it_says_before_it_flies(one: Hangar) -> None:
    cf = one.navigation
    assert cf.why_not("release_item", {}) is None  # it is not connected: that is not known
    await cf.connect()
    assert cf.why_not("release_item", {}) == 'cf1 has no parameter "hook.open"'
    camera = cf.why_not("take_photo", {})
    assert camera == (
        "cf1 has no camera: name its AI-deck's streamer in the fleet file:"
        ' camera = "192.168.4.1:5000"'
    )
    with pytest.raises(ActionNotDone, match="has no camera"):
        await cf.act("take_photo", {}, None)


async def test_its_camera_s_picture_is_kept_and_covers_ground(folder: Path) -> None:
    streaming = await camera()
    options = {"camera": f"127.0.0.1:{port_of(streaming)}", "camera_view": [90, 60]}
    async with hangar(folder, options) as one:
        cf = await one.connected()
        await cf.takeoff(1.0, FAST)
        photos = [await cf.act("take_photo", {}, None) for _ in range(2)]
    streaming.close()
    await streaming.wait_closed()
    for number, photo in enumerate(photos, 1):
        assert isinstance(photo, Photo) and photo.file == str(folder / f"cf1-{number:04}.pgm")
        assert photo.position == pytest.approx((1.0, 2.0, 1.0), abs=0.1)
        assert photo.width == pytest.approx(2.0 * photo.position[2], abs=0.01)
        assert photo.height == pytest.approx(1.155 * photo.position[2], abs=0.01)
        data = Path(photo.file).read_bytes()
        assert data.startswith(b"P5 324 244 255\n") and len(data) == 15 + 324 * 244
        assert data[15:] in (picture(number) for number in range(10))


@drone(options={"camera": "127.0.0.1:9"})
async def test_a_camera_that_is_not_there_fails_the_action(cf: Crazyflie) -> None:
    with pytest.raises(ActionNotDone, match=r"cf1 gives no photo at 127\.0\.0\.1:9"):
        await cf.act("take_photo", {}, None)


@drone(options={"camera": "127.0.0.1:9"})
async def test_a_camera_that_is_not_there_keeps_it_on_the_ground(
    one: Hangar, cf: Crazyflie
) -> None:
    """So that nobody waits at a bed for what its AI-deck will not give."""
    (why,) = await cf.preflight()
    assert why.startswith("its camera does not answer at 127.0.0.1:9 (Connect call failed")
    with pytest.raises(NotReady, match="in its WiFi"):
        await cf.takeoff(0.5, FAST)
    assert not one.did("arm")


async def test_variables_are_read_and_parameters_set(cf: Crazyflie) -> None:
    assert await cf.read("bme.humidity") == pytest.approx(40.0)
    assert await cf.read("hlCommander.vtoff") == pytest.approx(0.5)
    await cf.write("hlCommander.vtoff", 0.7)
    assert await cf.read("hlCommander.vtoff") == pytest.approx(0.7)
    with pytest.raises(Rejected, match=r'neither a log variable nor a parameter "no\.such"$'):
        await cf.read("no.such")
    with pytest.raises(Rejected, match=r'no parameter "bme\.humidity"$'):
        await cf.write("bme.humidity", 1.0)
    with pytest.raises(Rejected, match=r'; did you mean "locSrv\.extPosStdDev"\?$'):
        await cf.write("locSrv.extPosStdDv", 0.02)
    for name, value in (("sound.effect", 300.0), ("sound.effect", 0.5), ("cpu.flash", 1.0)):
        with pytest.raises(Rejected, match="is no value for"):
            await cf.write(name, value)
    together = await asyncio.gather(*(cf.read("bme.temp") for _ in range(3)))
    assert together == [pytest.approx(21.0, abs=0.1)] * 3


async def test_it_blinks_and_has_its_lights_back(one: Hangar, cf: Crazyflie) -> None:
    await cf.identify()
    told = [command.values["value"] for command in one.did("set led.bitmask")]
    values = [value for value, _ in groupby(told)]  # cflib may say something twice
    assert values == [191.0, 128.0] * 8 + [0.0]
    assert {command.what for command in one.commands} == {"set led.bitmask"}


async def test_its_camera_sees_what_the_tracker_sees_below_it_also_on_the_way(
    folder: Path,
) -> None:
    """It covers 2 m by 1.15 m of ground from a metre."""
    streaming = await camera()
    options = {"camera": f"127.0.0.1:{port_of(streaming)}", "camera_view": [90, 60]}
    person = Sighting("t1", "person", (1.5, 2.0, 0.0))
    asked: list[tuple[float, float]] = []

    def in_view(place: Point, width: float, height: float) -> tuple[Sighting, ...]:
        asked.append((width, height))
        return (person,)

    async with hangar(folder, options) as one:
        one.navigation._setup = replace(one.navigation._setup, in_view=in_view)
        cf = await one.connected()
        await cf.takeoff(1.0, FAST)
        assert await cf.sees() == (person,)
        going = asyncio.create_task(cf.go_to((2.0, 2.0, 1.0), FAST))
        photo = await cf.trigger("take_photo", {})
        assert not going.done()
        await going
        with pytest.raises(ActionNotDone, match="cf1 must stop to pick_item"):
            await cf.trigger("pick_item", {})
    streaming.close()
    await streaming.wait_closed()
    assert isinstance(photo, Photo)
    assert (photo.tracks, photo.sees) == ((person,), ("person",))
    for seen in asked:
        assert seen == pytest.approx((2.0, 1.15), abs=0.2)


async def test_without_a_camera_it_sees_nothing_and_says_so(cf: Crazyflie) -> None:
    with pytest.raises(ActionNotDone, match="cf1 has no camera"):
        await cf.sees()
