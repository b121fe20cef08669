"""The end of a team: what flies is landed before its link is closed."""

from __future__ import annotations

from pathlib import Path

import pytest

from pluto_fleet.jobs.controls import GoTo
from tests.kit.drones import FakeDrone, run, the_loop
from tests.library.drones.teams import flying


async def test_all_land_at_once_before_their_links_are_closed(tmp_path: Path) -> None:
    """Closing a link may cut the motors."""
    drones = [FakeDrone(f"cf{i}", (float(i), 1.0, 0.0)) for i in range(1, 5)]
    async with flying(tmp_path, *drones) as flown:
        for drone in drones[1:]:
            await flown.up(drone.id)
        flown.begin(flown.team.do("cf3", GoTo((3.0, 9.0, 1.0))))
        await flown.until(lambda: drones[2].place[1] > 2)
        before = the_loop().now
    assert the_loop().now - before < 6
    assert [drone.closed_at and drone.closed_at[0] for drone in drones] == [False] * 4
    assert drones[0].told == []
    assert drones[2].told[-2:] == ["hold", "land"]


def test_a_drone_whose_link_is_lost_gets_one_more_chance(tmp_path: Path) -> None:
    """Then the gateway ends all the same, and says where it was."""

    async def flight(back: bool) -> None:
        async with flying(tmp_path) as flown:
            drone = await flown.up()
            drone.goes_silent()
            await flown.until(lambda: not flown.team.vehicles["cf1"].linked)
            drone.answers = back
            before = the_loop().now
        assert the_loop().now - before < 60
        assert drone.motors is not back
        said = "cf1 could not be landed: it may still hover at (1, 1)"
        assert (said in flown.log) is not back

    run(flight(True))
    run(flight(False))


async def test_a_team_can_end_while_it_connects(tmp_path: Path) -> None:
    """And while it waits for drones that are away."""
    drones = FakeDrone(), FakeDrone("cf2", (3.0, 1.0, 0.0))
    drones[0].hangs = {"connect"}
    drones[1].answers = False
    async with flying(tmp_path, *drones) as flown:
        reaches = flown.begin(flown.team.reach("cf2"))
        await flown.until(lambda: flown.log or the_loop().now > 1010)
        flown.kernel.post(reaches.cancel)
        before = the_loop().now
    assert the_loop().now - before < 5


@pytest.mark.parametrize("twice", [False, True])
async def test_a_drone_that_does_not_land_at_once_is_told_again(
    tmp_path: Path, twice: bool
) -> None:
    """A busy one, say."""
    async with flying(tmp_path) as flown:
        drone = await flown.up()
        drone.raises = {"land": ValueError("busy")}
        if twice:
            the_loop().call_later(0.5, drone.raises.clear)
    assert drone.motors is not twice
