"""Drones that others must tell where they are, and what a localization feeds them, no matter what it does."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Self, cast

import pytest

from pluto_fleet.drones import source
from pluto_fleet.drones.localization import LocalizationFeed
from pluto_fleet.drones.real_fleet import RealDrone, RealFleet
from pluto_fleet.drones.team import make_team
from pluto_fleet.jobs.controls import FleetDrone, Hold, TakeOff
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput, Failure
from pluto_fleet.shared.domain.model import Point
from tests.kit.drones import FakeDrone, run, the_loop
from tests.library.drones.teams import SCOUT, flying


class Hearing:
    """It hears where it is, if nothing keeps it."""

    def __init__(self) -> None:
        self.heard: list[Point] = []
        self.free = asyncio.Event()
        self.free.set()
        self.broken = False

    async def locate(self, position: Point) -> None:
        await self.free.wait()
        if self.broken:
            raise OSError("no radio")
        self.heard.append(position)


class Eyes:
    """A localization that sees what is put into a queue; None: it stops looking."""

    def __init__(self) -> None:
        self.seen: asyncio.Queue[object] = asyncio.Queue()
        self.closed = 0

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
        try:
            while (one := await self.seen.get()) is not None:
                if isinstance(one, Exception):
                    raise one
                yield cast("tuple[str, Point]", one)
        finally:
            self.closed += 1


class Scene:
    """Eyes, two drones and what is said."""

    def __init__(self) -> None:
        self.eyes, self.cf1, self.cf2 = Eyes(), Hearing(), Hearing()
        self.said: list[str] = []
        self.now = 100.0
        self.feeding = LocalizationFeed(
            "eyes",
            self.eyes,
            {"cf1": self.cf1, "cf2": self.cf2},
            self.said.append,
            lambda: self.now,
        )

    async def __aenter__(self) -> Self:
        self.feeding.start()
        self.feeding.start()  # it has begun
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.feeding.close()
        assert asyncio.all_tasks() == {asyncio.current_task()}

    async def sees(self, *what: object) -> None:
        for one in what:
            self.eyes.seen.put_nowait(one)
        for _ in range(10):
            await asyncio.sleep(0)


async def test_who_is_not_seen_for_a_second_is_told_so() -> None:
    async with Scene() as scene:
        assert scene.feeding.silent("cf1") is None  # it has just begun
        scene.now += 1.24
        await scene.sees(("cf2", (3, 4, 1)))
        assert scene.feeding.silent("cf1") == "no position from eyes for 1.2 s"
        assert scene.feeding.silent("cf2") is None
        assert scene.feeding.silent("cf3") is None  # no drone of its own
        await scene.sees(("cf1", (1, 2, 0.5)))
        assert scene.feeding.silent("cf1") is None


@pytest.mark.parametrize(
    ("what", "said"),
    [
        (("cf1", (float("nan"), 0.0, 0.0)), "gave cf1 a position that is no number"),
        (("cf1", (1.0, 2.0)), "gave what is no drone and position"),
        ("cf1", "gave what is no drone and position"),
        (("cf\x1b9", (1.0, 2.0, 0.0)), r'sees "cf\x1b9", which is not in the fleet'),
    ],
)
async def test_nonsense_is_told_once_and_not_fed(what: object, said: str) -> None:
    async with Scene() as scene:
        scene.now += 2
        await scene.sees(what, what)
        assert scene.said == [f"the localization eyes {said}"]
        assert scene.cf1.heard == scene.cf2.heard == []
        assert scene.feeding.silent("cf1") is not None


async def test_a_drone_that_takes_long_to_hear_keeps_no_other_and_hears_the_latest() -> None:
    async with Scene() as scene:
        scene.cf1.free.clear()
        await scene.sees(*[("cf1", (float(i), 0.0, 0.0)) for i in range(5)])
        await scene.sees(*[("cf1", (float(i), 0.0, 0.0)) for i in range(5, 9)])
        await scene.sees(("cf2", (0.0, 0.0, 0.0)))
        assert len(scene.cf2.heard) == 1
        scene.cf1.free.set()
        await scene.sees()
        assert [x for x, _, _ in scene.cf1.heard][-1] == 8.0
        assert len(scene.cf1.heard) == 2


@pytest.mark.parametrize(
    ("end", "why"), [(None, "it ended"), (OSError("unplugged"), "OSError: unplugged")]
)
async def test_eyes_that_close_are_opened_again(
    end: object, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(source, "PAUSE", 0.0)
    async with Scene() as scene:
        await scene.sees(("cf1", (1, 1, 1)), end, ("cf1", (2, 2, 2)))
        assert scene.cf1.heard == [(1, 1, 1), (2, 2, 2)]
        assert scene.said == [f"the localization eyes gives no positions any more ({why})"]
        assert scene.eyes.closed == 1


# As a part of a team


class Located(FakeDrone):
    async def locate(self, position: Point) -> None:
        """Hear where it is."""


class Camera:
    """Sees a drone, as long as it looks."""

    def __init__(self) -> None:
        self.looks = True

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
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
        failed = await flown.failure(flown.team.do("cf1", Hold()))
        assert failed.failure is Failure.LINK
        why = r"cf1 does not know where it is, and lands: no position from camera for 1\.[01] s"
        assert re.fullmatch(why, str(failed))
        await flown.until(lambda: not drone.motors)
        failed = await flown.failure(flown.team.do("cf1", TakeOff(1.0)))
        camera.looks = True
        assert await flown.do(flown.team.reach("cf1"))
        await flown.do(flown.team.do("cf1", TakeOff(1.0)))


def test_a_drone_that_cannot_be_told_is_refused_before_anything_flies(tmp_path: Path) -> None:
    """And so is one whose navigation cannot be found."""

    async def flight(navigation: str, localization: str) -> None:
        real = RealFleet(
            drones=(RealDrone(id="cf1", navigation=navigation, uri=None, options={}),),
            localization=localization,
            localization_options={},
        )
        drones = [FleetDrone(id="cf1", category=SCOUT, home=(1, 1, 0))]
        make_team(RealTime(), drones, real, Airspace(), tmp_path, print)

    ours = "tests.library.drones.test_localization:Simple"
    with pytest.raises(BadInput, match="cf1 cannot be told where they are"):
        run(flight(ours, "tests.library.drones.test_localization:Camera"))
    with pytest.raises(BadInput, match="nowhere"):
        run(flight("nowhere:Drone", "own"))
    run(flight(ours, "own"))
    assert (tmp_path / "files").is_dir()


class Simple(FakeDrone):
    def __init__(self, setup: object) -> None:
        super().__init__()
