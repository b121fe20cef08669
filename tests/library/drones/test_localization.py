"""Drones that others must tell where they are."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from pluto_fleet.drones.localization import LocalizationFeed
from pluto_fleet.drones.real_fleet import RealDrone, RealFleet
from pluto_fleet.drones.team import make_team
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput, Failure
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.simulation.body import SimulatedDrone
from tests.kit.drones import FakeDrone, run, the_loop
from tests.library.drones.teams import SCOUT, flying


class Located(FakeDrone):
    """A drone that can be told where it is."""

    async def locate(self, position: Point) -> None:
        """Hear where it is."""


class Camera:
    """Sees a drone, as long as it looks."""

    def __init__(self) -> None:
        self.looks = True

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
        """Return who is where."""
        while True:
            if self.looks:
                yield "cf1", (1.0, 1.0, 0.0)
            await asyncio.sleep(0.1)


async def test_a_drone_that_is_not_seen_lands_and_does_not_take_off(tmp_path: Path) -> None:
    """It does not know where it is."""
    drone, camera = Located(), Camera()
    feeding = LocalizationFeed("camera", camera, {"cf1": drone}, print, the_loop().time)
    async with flying(tmp_path, drone, feeding=feeding) as flown:
        await flown.up()
        the_loop().call_later(2, setattr, camera, "looks", False)
        failed = await flown.failure(flown.team.hold("cf1"))
        assert failed.failure is Failure.LINK
        why = "cf1 does not know where it is, and lands: no position from camera for 1.0 s"
        assert str(failed) == why
        await flown.until(lambda: not drone.motors)
        failed = await flown.failure(flown.team.takeoff("cf1", 1.0))
        camera.looks = True
        assert await flown.do(flown.team.reach("cf1"))
        await flown.do(flown.team.takeoff("cf1", 1.0))


def test_a_drone_that_cannot_be_told_is_refused_before_anything_flies(tmp_path: Path) -> None:
    """And so is one whose navigation cannot be found."""

    async def flight(navigation: str, localization: str) -> None:
        real = RealFleet(
            drones=(RealDrone(id="cf1", navigation=navigation, uri=None, options={}),),
            localization=localization,
            localization_options={},
        )
        drones = [SimulatedDrone(id="cf1", category=SCOUT, home=(1, 1, 0))]
        make_team(RealTime(), drones, real, Airspace(), tmp_path, print)

    ours = "tests.library.drones.test_localization:Simple"
    with pytest.raises(BadInput, match="cf1 cannot be told where they are"):
        run(flight(ours, "tests.library.drones.test_localization:Camera"))
    with pytest.raises(BadInput, match="nowhere"):
        run(flight("nowhere:Drone", "own"))
    run(flight(ours, "own"))
    assert (tmp_path / "files").is_dir()


class Simple(FakeDrone):
    """As a fleet file names it."""

    def __init__(self, setup: object) -> None:
        super().__init__()
