"""What is watched in flight, for every navigation."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from pluto_fleet.drones.protocol import BATTERY_LOW, CRASHED, LOCKED, POSITION_LOST, Rejected
from pluto_fleet.drones.safety import outside_area
from pluto_fleet.drones.team import Team
from pluto_fleet.jobs.controls import GoTo, Hold, Land, TakeOff
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import FIELD, Flown, flying


async def fails(flown: Flown, drone: str = "cf1") -> tuple[Failure | None, str]:
    """Let a drone hover until something goes wrong, and return what."""
    failed = await flown.failure(flown.team.do(drone, Hold()))
    return failed.failure, str(failed)


async def falls(flown: Flown, drone: FakeDrone) -> tuple[Failure | None, str]:
    """Let a drone fall as it hovers, and return what goes wrong."""
    the_loop().call_later(1, drone.falls)
    return await fails(flown)


@pytest.mark.parametrize(
    ("wind", "where"),
    [
        ((-0.4, 5.0, 1.0), "(-0.4, 5), which is outside the map"),
        ((5.0, 10.4, 1.0), "(5, 10.4), which is outside the map"),
        ((5.0, 5.0, 3.4), "(5, 5), 3.4 m high"),
    ],
)
async def test_a_drone_that_leaves_the_permitted_area_holds_and_lands(
    tmp_path: Path, wind: tuple[float, float, float], where: str
) -> None:
    """Its flight fails, and a person must look after it."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        the_loop().call_later(1, drone.put, wind)
        failure, why = await fails(flown)
        assert failure is Failure.REFUSED
        assert why == f"cf1 left the permitted area at {where}: it lands"
        await flown.until(lambda: not drone.motors)
        assert drone.told[1:] == ["hold", "land"]
        assert await flown.do(flown.team.reach("cf1"))
        with pytest.raises(Exception, match="left the permitted area"):
            flown.team.begins("cf1", None, 0.0)


async def test_a_drone_over_a_no_fly_area_leaves_it_before_it_lands(tmp_path: Path) -> None:
    """By the shortest way."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        the_loop().call_later(1, drone.put, (6.4, 7.0, 1.0))
        _, why = await fails(flown)
        assert "inside no-fly area 1" in why
        await flown.until(lambda: not drone.motors)
        assert drone.told[-3] == "hold"
        assert FIELD.problem(drone.place) is None
        assert drone.place == pytest.approx((6.0, 7.0, 0.0), abs=0.3)


async def test_a_drone_that_does_not_know_where_it_is_stops_and_lands_there(tmp_path: Path) -> None:
    """Not even out of a no-fly area does it fly: it may lie elsewhere. Once it knows, it is well."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.put((6.2, 7.0, 1.0))  # a little inside of it
        the_loop().call_later(1, drone.happens, POSITION_LOST, "it sees no beacon")
        failure, why = await fails(flown)
        assert failure is Failure.LINK
        assert why == "cf1 does not know where it is, and lands: it sees no beacon"
        await flown.until(lambda: not drone.motors)
        assert drone.told[1:] == ["hold", "land"]
        assert await flown.do(team.reach("cf1"))
        await flown.do(team.do("cf1", TakeOff(1.0)))


def test_a_little_beside_the_permitted_area_is_no_reason_to_land() -> None:
    """Positions are not exact; but a narrow no-fly area is one, too."""
    narrow = Airspace(size=(10, 10), ceiling=3, no_fly=(((2, 2), (2.4, 2), (2.4, 9), (2, 9)),))
    assert outside_area(FIELD, (-0.25, 10.25, 3.25)) is None
    assert outside_area(FIELD, (6.25, 7, 1)) is None
    assert outside_area(FIELD, (6.35, 7, 1)) is not None
    assert outside_area(narrow, (2.1, 5, 1)) is None
    assert outside_area(narrow, (2.2, 5, 1)) is not None


async def test_an_empty_battery_lands_where_it_is(tmp_path: Path) -> None:
    """Not at once: under load a battery shows less for a moment. Then a person must fetch it."""
    async with flying(tmp_path) as flown:
        drone, loop = await flown.up(), the_loop()
        loop.call_later(1, setattr, drone, "level", 0.02)
        loop.call_later(3, setattr, drone, "level", 0.1)
        loop.call_later(5, setattr, drone, "level", 0.02)
        before = loop.now
        failure, why = await fails(flown)
        assert loop.now - before == pytest.approx(8.1, abs=0.2)
        assert failure is Failure.BATTERY
        assert why == "cf1 has 2 % in its battery: it lands at (1, 1)"
        await flown.until(lambda: not drone.motors)
        assert "hold" in drone.told


async def test_a_drone_with_a_low_battery_lands_and_is_waited_for(tmp_path: Path) -> None:
    """It says so itself; put home and charged, it is well."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        await flown.do(team.do("cf1", GoTo((4.0, 4.0, 1.0))))
        the_loop().call_later(1, drone.happens, BATTERY_LOW, "3.1 V")
        failure, why = await fails(flown)
        assert failure is Failure.BATTERY
        assert why == "the battery of cf1 is low at (4, 4), where it lands: 3.1 V"
        assert await flown.do(team.reach("cf1"))
        assert not drone.motors
        failed = await flown.failure(team.do("cf1", TakeOff(1.0)))
        assert failed.failure is Failure.BATTERY
        fetched = flown.begin(team.fetched("cf1"))
        the_loop().call_later(100, drone.put, (1.1, 1.1, 0.0))
        await flown.until(lambda: fetched.is_set)
        assert fetched.result()
        await flown.do(team.do("cf1", TakeOff(1.0)))


async def test_fetching_comes_to_an_end(tmp_path: Path) -> None:
    """After ten minutes it is lost."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        await flown.do(team.do("cf1", GoTo((4.0, 4.0, 1.0))))
        await flown.do(team.do("cf1", Land()))
        drone.reasons = ("locked",)
        fetched = flown.begin(team.fetched("cf1"))
        assert await flown.until(lambda: fetched.is_set) == pytest.approx(600, abs=3)
        assert not fetched.result()


@pytest.mark.parametrize("tells", [False, True])
async def test_a_drone_that_falls_has_crashed(tmp_path: Path, tells: bool) -> None:
    """Whether it says so, or is merely found on the ground."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        the_loop().call_later(1, lambda: drone.falls(tells=tells))
        failure, why = await fails(flown)
        assert failure is Failure.CRASH
        fell = "crashed at (1, 1): it lies on its back" if tells else "is on the ground at"
        assert fell in why
        assert "hold" not in drone.told
        drone.reasons = ("it lies on its back",)
        assert not await flown.do(team.reach("cf1"))
        drone.reasons = ()
        assert await flown.do(team.reach("cf1"))
        await flown.do(team.do("cf1", TakeOff(1.0)))


class Mended(FakeDrone):
    """One that remembers its crash until it is told that a person has looked after it."""

    async def looked_after(self) -> None:
        await self._does("looked_after")
        self.told.append("looked after")
        self.reasons = ()


@asynccontextmanager
async def fallen(folder: Path) -> AsyncIterator[tuple[Mended, Team, Flown]]:
    drone = Mended()
    async with flying(folder, drone) as flown:
        await flown.up()
        await falls(flown, drone)
        yield drone, flown.team, flown


async def test_only_a_person_lets_a_drone_forget_its_crash(tmp_path: Path) -> None:
    """However often it is asked how it is, and wherever it stands: it may have lost a propeller."""
    async with fallen(tmp_path) as (drone, team, flown):
        for _ in range(2):
            assert not await flown.do(team.reach("cf1"))
        assert "looked after" not in drone.told
        team.mended("cf1")
        assert await flown.do(team.reach("cf1"))
        assert drone.told.count("looked after") == 1
        await flown.do(team.do("cf1", TakeOff(1.0)))


async def test_a_drone_that_does_not_forget_its_crash_is_lost_and_can_be_brought_back_again(
    tmp_path: Path,
) -> None:
    """It was not set upright: once that is done, the person says so once more, and need not wait."""
    async with fallen(tmp_path) as (drone, team, flown):
        assert not await flown.do(team.reach("cf1"))
        drone.raises["looked_after"] = Rejected("it lies on its back")
        team.mended("cf1")
        began = the_loop().now
        assert not await flown.do(team.reach("cf1"))
        assert the_loop().now - began < 3.0
        del drone.raises["looked_after"]
        team.mended("cf1")
        assert await flown.do(team.reach("cf1"))
        await flown.do(team.do("cf1", TakeOff(1.0)))


async def test_a_drone_that_crashes_on_its_way_home_is_lost_at_once(tmp_path: Path) -> None:
    """No person is asked to put it home: it would wait there for a word that is said of lost ones."""
    async with fallen(tmp_path) as (_, team, flown):
        began = the_loop().now
        assert not await flown.do(team.fetched("cf1"))
        assert the_loop().now - began < 3.0


@pytest.mark.parametrize("hovers", [False, True])
async def test_what_befalls_a_drone_later_was_not_looked_after(
    tmp_path: Path, hovers: bool
) -> None:
    """It was brought back when it had not crashed: that says nothing of a crash in its next flight."""
    drone = Mended()
    async with flying(tmp_path, drone) as flown:
        team = flown.team
        if hovers:
            await flown.up()
            team.mended("cf1")
            assert await flown.do(team.reach("cf1"))
        else:
            team.mended("cf1")
            await flown.up()
        await falls(flown, drone)
        assert not await flown.do(team.reach("cf1"))
        assert "looked after" not in drone.told


async def test_what_happens_on_the_ground_fails_no_flight(tmp_path: Path) -> None:
    """Preflight will say whether it matters; a person who carries a drone tilts it."""
    async with flying(tmp_path) as flown:
        drone, team = flown.drones["cf1"], flown.team
        await flown.do(team.drone_report("cf1"))
        for kind in (CRASHED, LOCKED, BATTERY_LOW, POSITION_LOST, "sneezed"):
            drone.happens(kind)
        await flown.until(lambda: len(flown.log) >= 5)
        assert flown.log[-1] == "cf1: sneezed: so it is"
        team.begins("cf1", None, 0.0)
        await flown.do(team.do("cf1", TakeOff(1.0)))


async def test_who_must_land_is_not_kept_up(tmp_path: Path) -> None:
    """Neither by a command nor by breaking off; a command to land comes to the same."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.happens(BATTERY_LOW)
        await flown.until(lambda: "land" in drone.told)
        flown.kernel.post(team.break_off, "cf1")
        assert (await flown.failure(team.do("cf1", GoTo((2, 2, 1))))).failure is Failure.BATTERY
        await flown.do(team.do("cf1", Land()))
        assert (drone.motors, drone.told) == (False, ["takeoff 1", "land"])


async def test_a_landing_that_does_not_succeed_is_tried_again(tmp_path: Path) -> None:
    """As often as it takes."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        drone.raises = {"land": ValueError("not now")}
        drone.happens(BATTERY_LOW)
        await flown.until(lambda: any("was to land" in line for line in flown.log))
        drone.raises = {}
        await flown.until(lambda: not drone.motors, 10)
