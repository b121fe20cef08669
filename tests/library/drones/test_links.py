"""Links that are lost, and drones that come back."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.drones.protocol import Rejected
from pluto_fleet.jobs.controls import GoTo, Hold, Land, TakeOff
from pluto_fleet.shared.domain.errors import Failure
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import flying


@pytest.mark.parametrize("command", ["go_to", "hold"])
async def test_silence_in_the_air_is_a_lost_link(tmp_path: Path, command: str) -> None:
    """After three seconds, in a flight or while it hovers, though its navigation notices nothing."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.hangs = {"go_to"}
        flies = flown.begin(
            team.do("cf1", Hold()) if command == "hold" else team.do("cf1", GoTo((5.0, 1.0, 1.0)))
        )
        await flown.until(lambda: team.vehicles["cf1"].commands.doing)
        drone.goes_silent()
        assert await flown.until(lambda: flies.is_set) == pytest.approx(3.1, abs=0.15)
        failed = await flown.failure(team.do("cf1", GoTo((5.0, 1.0, 1.0))))
        assert failed.failure is Failure.LINK
        assert not team.telemetry["cf1"].landed
        assert "hold" not in drone.told
        drone.answers = True


async def test_while_the_gateway_is_held_up_a_drone_is_not_silent(tmp_path: Path) -> None:
    """What it told meanwhile is still to be read."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        vehicle = flown.team.vehicles["cf1"]
        drone.goes_silent()
        for at in (1.0, 4.0):
            the_loop().call_later(at, the_loop().advance, 2.9)
        took = await flown.until(lambda: not vehicle.linked)
        assert took == pytest.approx(3.1 + 2 * 2.9, abs=0.3)
        assert "was kept from watching its drones" in flown.log[-2]


async def test_a_drone_that_comes_back_can_be_flown_home(tmp_path: Path) -> None:
    """It is connected to again and again, and hovers meanwhile."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.goes_silent()
        await flown.until(lambda: not team.vehicles["cf1"].linked)
        reaches = flown.begin(team.reach("cf1"))
        the_loop().call_later(40, setattr, drone, "answers", True)
        assert await flown.until(lambda: reaches.is_set) < 48
        assert reaches.result()
        team.begins("cf1", None, 0.0)
        await flown.do(team.do("cf1", GoTo((1.0, 1.0, 1.0))))
        await flown.do(team.do("cf1", Land()))
        assert (await flown.do(team.drone_report("cf1"))).boot == 0


async def test_a_drone_that_stays_away_is_lost_and_lands_when_it_appears(tmp_path: Path) -> None:
    """After two minutes it is not waited for; should it hover after all, it must not for long."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.goes_silent()
        await flown.until(lambda: not team.vehicles["cf1"].linked)
        reaches = flown.begin(team.reach("cf1"))
        assert await flown.until(lambda: reaches.is_set) == pytest.approx(120, abs=1)
        assert not reaches.result()
        drone.answers = True
        await flown.until(lambda: not drone.motors, 30)
        assert "land" in drone.told
        team.mended("cf1")
        assert await flown.do(team.reach("cf1"))


async def test_a_drone_that_was_switched_off_and_on_has_landed(tmp_path: Path) -> None:
    """It is found with its motors off, somewhere else, and it has forgotten what it did."""
    async with flying(tmp_path) as flown:
        drone, team = await flown.up(), flown.team
        drone.goes_silent()
        drone.falls(tells=False)
        await flown.until(lambda: not team.vehicles["cf1"].linked)
        drone.put((2.0, 2.0, 0.0))
        drone.answers = True
        await flown.until(lambda: team.vehicles["cf1"].linked)
        report = await flown.do(team.drone_report("cf1"))
        assert (report.landed, report.boot, report.location) == (True, 1, (2, 2, 0))
        assert await flown.do(team.reach("cf1"))


async def test_a_drone_that_cannot_fly_any_more_counts_as_landed(tmp_path: Path) -> None:
    """Its battery must be empty by then: it is not waited for to come down."""
    async with flying(tmp_path) as flown:
        drone, seen = await flown.up(), flown.team.telemetry["cf1"]
        drone.goes_silent()
        assert await flown.until(lambda: seen.landed) == pytest.approx(504, abs=4)


SET = {"locSrv.extPosStdDev": 0.02, "posCtlPid.xVelMax": 2.0}


async def test_its_parameters_are_set_when_it_is_connected_to(tmp_path: Path) -> None:
    """Before it takes off, and again after a restart has lost them; not in the air."""
    async with flying(tmp_path, parameters=SET) as flown:
        drone = await flown.up()
        told = [f"{name} = {value:g}" for name, value in SET.items()]
        assert drone.told[:2] == told and len(drone.told) == 3
        for flies in (True, False):
            drone.goes_silent()
            drone.motors = flies
            await flown.until(lambda: not flown.team.vehicles["cf1"].linked)
            drone.answers = True
            await flown.until(lambda: flown.team.vehicles["cf1"].linked)
            assert drone.told[3:] == ([] if flies else told)


async def test_a_parameter_that_cannot_be_set_keeps_it_on_the_ground(tmp_path: Path) -> None:
    """With the reason that its navigation gave."""
    drone = FakeDrone()
    drone.raises["write"] = Rejected('cf1 has no parameter "posCtlPid.xVelMx"')
    async with flying(tmp_path, drone, parameters=SET) as flown:
        report = await flown.do(flown.team.drone_report("cf1"))
        assert report.problems == ('cf1 has no parameter "posCtlPid.xVelMx"',) * len(SET)
        failed = await flown.failure(flown.team.do("cf1", TakeOff(1.0)))
        assert "xVelMx" in str(failed) and "takeoff" not in drone.told
