"""What a team of real drones is told, and what comes of it."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from dataclasses import dataclass, replace
from math import inf, nan
from pathlib import Path

import pytest

from pluto_fleet.drones.commands import result_of
from pluto_fleet.drones.protocol import Rejected
from pluto_fleet.drones.real_fleet import RequiredAction
from pluto_fleet.drones.vehicle import CommandQueue
from pluto_fleet.jobs.controls import Act, Cut, GoTo, Land, TakeOff
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category, Item, Photo, Point, Sighting
from tests.kit.drones import FakeDrone, passes, the_loop
from tests.library.drones.teams import flying

PILLS = Item(name="pills", mass=0.004)


async def test_a_flight_is_told_step_by_step(tmp_path: Path) -> None:
    """Each command returns when the drone is there; the telemetry says so."""
    async with flying(tmp_path) as flown:
        team, seen = flown.team, flown.team.telemetry["cf1"]
        assert (seen.location, seen.battery_level, seen.landed) == ((1, 1, 0), 0.0, True)
        report = await flown.do(team.drone_report("cf1"))
        assert report.reached
        assert (report.landed, report.problems, report.done) == (True, (), None)
        team.begins("cf1", None, 0.0)
        await flown.do(team.do("cf1", TakeOff(1.0)))
        assert not seen.landed
        await flown.do(team.do("cf1", TakeOff(1.0)))  # it flies already
        await flown.do(team.do("cf1", GoTo((3.0, 1.0, 1.0))))
        assert seen.location == pytest.approx((3, 1, 1), abs=0.1)
        assert await flown.do(team.do("cf1", Act("measure", {}, None, "j"))) == 21.5
        await flown.do(team.do("cf1", Land()))
        assert seen.landed
        await flown.do(team.do("cf1", Land()))
        told = ["takeoff 1", "go to 3 1 1", "measure", "land"]
        assert flown.drones["cf1"].told == told


async def test_what_is_cancelled_ends_also_where_the_drone_is_sent_on_at_that_instant() -> None:
    """Else both commands wait for their ends, by the one state of the drone."""
    ended: list[str] = []

    async def fly() -> None:
        try:
            await asyncio.Event().wait()
        finally:
            ended.append("fly")

    async def hold() -> None:
        ended.append("hold")

    queue = CommandQueue(hold)

    async def sent_on() -> None:
        with suppress(asyncio.CancelledError):
            await queue.run("fly", fly)
        queue.release()

    task = asyncio.ensure_future(sent_on())
    while not queue.doing:
        await asyncio.sleep(0)
    await asyncio.sleep(0)
    task.cancel()
    await task
    await asyncio.sleep(0.1)
    assert ended == ["fly"]


async def test_all_drones_are_connected_at_once_and_a_silent_one_delays_no_other(
    tmp_path: Path,
) -> None:
    """It is given up after 15 s; the others have answered long before."""
    drones = [FakeDrone(f"cf{i}", (float(i), 1.0, 0.0)) for i in range(1, 6)]
    drones[2].hangs = {"connect"}
    async with flying(tmp_path, *drones) as flown:
        began = the_loop().now
        for id in ("cf1", "cf2", "cf4", "cf5"):
            assert (await flown.do(flown.team.drone_report(id))).reached
        assert the_loop().now - began < 0.5
        silent = await flown.do(flown.team.drone_report("cf3"))
        assert the_loop().now - began == pytest.approx(15, abs=0.5)
        assert (silent.reached, silent.problems) == (False, ("cf3 did not answer in 15 s",))


async def test_a_drone_that_is_slower_than_its_category_is_waited_for(tmp_path: Path) -> None:
    """One that is met in the air flies home as slowly as it can follow."""
    category = Category(name="quick", speed=3.0)
    async with flying(tmp_path, category=category) as flown:
        drone = await flown.up()
        drone.slow = {"go_to": 17.0}  # 20 s for 9 m: at 1 m/s at most, 0.46 on average
        await flown.do(flown.team.do("cf1", GoTo((9.5, 1.0, 1.0))))
        assert drone.place == pytest.approx((9.5, 1, 1), abs=0.1)


async def test_a_roll_call_says_what_keeps_a_drone_from_flying(tmp_path: Path) -> None:
    """Its preflight, and the actions of the plan that its category has and its hardware has not."""
    category = Category(name="scout", actions=frozenset({"take_photo", "measure"}))
    drone = FakeDrone()
    drone.reasons = ("its position is uncertain", "\x1b[2Jlocked")
    drone.lacks = {"take_photo", "pick_item"}
    wanted = [RequiredAction(action=name, parameters={}) for name in ("take_photo", "pick_item")]
    async with flying(tmp_path, drone, category=category, wanted=wanted) as flown:
        problems = (await flown.do(flown.team.drone_report("cf1"))).problems
        assert problems == ("its position is uncertain", "\\x1b[2Jlocked", "cf1 cannot take_photo")
        assert flown.team.why_not("cf1", "take_photo", {}) == "cf1 cannot take_photo"
        assert flown.team.why_not("cf1", "dance", {}) == "cf1 has no action dance"
        failed = await flown.failure(flown.team.do("cf1", TakeOff(1.0)))
        assert failed.failure is Failure.REFUSED
        assert "cf1 is not ready: its position is uncertain; " in str(failed)
        assert drone.told == []


async def test_no_drone_takes_off_below_its_reserve(tmp_path: Path) -> None:
    """What is left in the battery is said."""
    drone = FakeDrone()
    drone.level = 0.15
    async with flying(tmp_path, drone) as flown:
        await flown.do(flown.team.drone_report("cf1"))
        failed = await flown.failure(flown.team.do("cf1", TakeOff(1.0)))
        assert "15 % in its battery, and 20 % are its reserve" in str(failed)
        assert drone.told == []


async def test_what_is_broken_off_ends_in_a_hover(tmp_path: Path) -> None:
    """The command under way raises, and the next one waits until the drone hovers."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        flies = flown.begin(team.do("cf1", GoTo((5.0, 1.0, 1.0))))
        await flown.until(lambda: drone.place[0] > 2)
        flown.kernel.post(team.break_off, "cf1")
        landing = flown.begin(team.do("cf1", Land()))
        await flown.kernel.offer(landing)
        assert "told to break it off" in str(flies.error)
        assert drone.told[-2:] == ["hold", "land"]
        assert drone.place == pytest.approx((2, 1, 0), abs=0.2)


async def test_a_takeoff_that_is_broken_off_before_the_drone_says_that_it_flies_is_no_landing(
    tmp_path: Path,
) -> None:
    """The command may have reached it: until that is known it counts as in the air."""
    drone = FakeDrone()
    drone.hangs = {"takeoff"}
    async with flying(tmp_path, drone) as flown:
        await flown.do(flown.team.drone_report("cf1"))
        seen = flown.team.telemetry["cf1"]
        rises = flown.begin(flown.team.do("cf1", TakeOff(1.0)))
        await flown.until(lambda: not seen.landed, 1)
        flown.kernel.post(rises.cancel)
        assert not seen.landed
        drone.hangs.clear()
        await flown.do(flown.team.do("cf1", Land()))
        assert drone.told == ["hold", "land"]
        assert seen.landed


async def test_what_is_aboard_outlives_the_gateway(tmp_path: Path) -> None:
    """A real drone cannot tell, so it is written down."""
    async with flying(tmp_path) as flown:
        await flown.up()
        await flown.do(flown.team.do("cf1", Act("pick_item", {}, PILLS, "j")))
        assert (await flown.do(flown.team.drone_report("cf1"))).carrying == "pills"
    async with flying(tmp_path) as flown:
        assert (await flown.do(flown.team.drone_report("cf1"))).carrying == "pills"
        await flown.up()
        await flown.do(flown.team.do("cf1", Act("release_item", {}, PILLS, "k")))
        assert (await flown.do(flown.team.drone_report("cf1"))).carrying is None


@pytest.mark.parametrize("hangs", [False, True])
async def test_cut_motors_waits_for_nothing(tmp_path: Path, hangs: bool) -> None:
    """No matter what the drone does, and however its navigation hangs in that."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.fell = Rejected  # it says no more than that it will not
        if hangs:
            drone.hangs = drone.clings = {"go_to", "hold"}
        flies = flown.begin(team.do("cf1", GoTo((5.0, 1.0, 1.0))))
        await flown.until(lambda: "fly" in team.vehicles["cf1"].commands.doing)
        before = the_loop().now
        await flown.do(team.do("cf1", Cut()))
        assert the_loop().now - before < 0.2
        assert not drone.motors
        await flown.until(lambda: flies.is_set, 1)
        assert str(flies.error) == "cf1's motors were cut"
        assert drone.told[-1] == "emergency stop"
        assert "motors were cut" in str(await flown.failure(team.do("cf1", TakeOff(1.0))))
        flown.begin(team.do("cf1", Land()))
        flown.kernel.post(team.break_off, "cf1")
        await flown.until(lambda: team.telemetry["cf1"].landed)
        assert drone.told[-1] == "emergency stop"
        team.mended("cf1")
        team.begins("cf1", None, 0.0)


# Elsewhere, on its way


async def test_one_on_its_way_is_sent_on_without_a_hover_at_the_pace_that_is_asked(
    tmp_path: Path,
) -> None:
    async with flying(tmp_path) as flown:
        team = flown.team
        drone = flown.drones["cf1"]
        await flown.up()
        assert not team.turn("cf1", GoTo((9.0, 9.0, 1.0)))  # it is on no way
        flies = flown.begin(team.do("cf1", GoTo((5.0, 1.0, 1.0))))
        await passes(2)
        drone.told.clear()
        began = the_loop().now
        here = drone.place
        assert team.turn("cf1", GoTo((here[0], here[1] + 1.0, 1.0), 4.0))
        assert not team.turn("cf1", GoTo((9.0, 9.0, 1.0)))  # until that has reached it
        await flown.until(lambda: flies.is_set)
        assert flies.error is None
        assert the_loop().now - began == pytest.approx(4.0, abs=0.3)
        assert [told.split()[0] for told in drone.told] == ["go"]
        assert not team.turn("cf1", GoTo((9.0, 9.0, 1.0)))  # it has arrived


async def test_one_that_was_to_hover_flies_on_if_that_is_wanted_before_it_does(
    tmp_path: Path,
) -> None:
    drone = FakeDrone()
    drone.slow["hold"] = 2.0
    async with flying(tmp_path, drone) as flown:
        await flown.up()
        flies = flown.begin(flown.team.do("cf1", GoTo((5.0, 1.0, 1.0))))
        await passes(2)
        flown.kernel.post(flown.team.break_off, "cf1")
        await flown.until(lambda: flies.is_set)
        began = the_loop().now
        await flown.do(flown.team.do("cf1", GoTo((2.0, 1.5, 1.0))))
        assert the_loop().now - began < 2.0
        assert "hold" not in drone.told


# What an action gave is what the app knows, with either copy of the runtime in its navigation


@dataclass
class Picture:
    """A photo of another copy of the runtime."""

    position: Point
    width: float
    height: float


def test_a_photo_is_one_of_this_copy() -> None:
    gave = Picture((1, 2, 3), 2, 1.5)
    assert result_of("cf1", "take_photo", gave) == Photo(
        position=(1.0, 2.0, 3.0), width=2.0, height=1.5
    )
    whole = Photo(position=(1, 2, 3), width=2, height=1, sees=("bloom",), sharpness=0.5, file="a")
    whole = replace(whole, tracks=(Sighting("t1", "person", (1.0, 2.0, 0.0)),))
    assert result_of("cf1", "take_photo", whole) == whole


@pytest.mark.parametrize(
    ("action", "gave"),
    [
        ("measure", None),
        ("measure", "21"),
        ("measure", nan),
        ("take_photo", 3.0),
        ("take_photo", Picture((1, 2, inf), 1, 1)),
    ],
)
def test_anything_else_is_a_mistake_of_the_navigation(action: str, gave: object) -> None:
    with pytest.raises(FlightFailed, match=f"navigation of cf1 made a mistake: {action} gave"):
        result_of("cf1", action, gave)
