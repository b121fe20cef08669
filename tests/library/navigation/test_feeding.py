"""What a localization sees is fed to the drones, no matter what it does."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from typing import cast

import pytest

from pluto_fleet.drones import localization
from pluto_fleet.drones.localization import LocalizationFeed
from pluto_fleet.shared.domain.model import Point


class Drone:
    """It hears where it is, if nothing keeps it."""

    def __init__(self) -> None:
        self.heard: list[Point] = []
        self.free = asyncio.Event()
        self.free.set()
        self.broken = False

    async def locate(self, position: Point) -> None:
        """Hear it."""
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
        """Yield who is where."""
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
        self.eyes, self.cf1, self.cf2 = Eyes(), Drone(), Drone()
        self.said: list[str] = []
        self.now = 100.0
        self.feeding = LocalizationFeed(
            "eyes",
            self.eyes,
            {"cf1": self.cf1, "cf2": self.cf2},
            self.said.append,
            lambda: self.now,
        )

    async def sees(self, *what: object) -> None:
        """Let this be seen, and heard."""
        for one in what:
            self.eyes.seen.put_nowait(one)
        for _ in range(10):
            await asyncio.sleep(0)


def played(play: Callable[[Scene], Awaitable[None]]) -> None:
    """Play a scene; nothing is left of it."""

    async def whole() -> None:
        scene = Scene()
        scene.feeding.start()
        scene.feeding.start()  # it has begun
        await play(scene)
        await scene.feeding.close()
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(whole())


def test_each_drone_hears_where_it_is() -> None:
    async def play(scene: Scene) -> None:
        await scene.sees(("cf1", (1.0, 2.0, 0.5)), ("cf2", (3, 4, 1)))
        assert (scene.cf1.heard, scene.cf2.heard) == ([(1.0, 2.0, 0.5)], [(3.0, 4.0, 1.0)])
        assert scene.said == []

    played(play)


def test_who_is_not_seen_for_a_second_is_told_so() -> None:
    async def play(scene: Scene) -> None:
        assert scene.feeding.silent("cf1") is None  # it has just begun
        scene.now += 1.24
        await scene.sees(("cf2", (3, 4, 1)))
        assert scene.feeding.silent("cf1") == "no position from eyes for 1.2 s"
        assert scene.feeding.silent("cf2") is None
        assert scene.feeding.silent("cf3") is None  # no drone of its own
        await scene.sees(("cf1", (1, 2, 0.5)))
        assert scene.feeding.silent("cf1") is None

    played(play)


@pytest.mark.parametrize(
    ("what", "said"),
    [
        (("cf1", (float("nan"), 0.0, 0.0)), "gave cf1 a position that is no number"),
        (("cf1", (1.0, 2.0)), "gave what is no drone and position"),
        ("cf1", "gave what is no drone and position"),
        (("cf\x1b9", (1.0, 2.0, 0.0)), r'sees "cf\x1b9", which is not in the fleet'),
    ],
)
def test_nonsense_is_told_once_and_not_fed(what: object, said: str) -> None:
    async def play(scene: Scene) -> None:
        scene.now += 2
        await scene.sees(what, what)
        assert scene.said == [f"the localization eyes {said}"]
        assert scene.cf1.heard == scene.cf2.heard == []
        assert scene.feeding.silent("cf1") is not None

    played(play)


def test_a_drone_that_takes_long_to_hear_keeps_no_other_and_hears_the_latest() -> None:
    async def play(scene: Scene) -> None:
        scene.cf1.free.clear()
        await scene.sees(*[("cf1", (float(i), 0.0, 0.0)) for i in range(5)])
        await scene.sees(*[("cf1", (float(i), 0.0, 0.0)) for i in range(5, 9)])
        await scene.sees(("cf2", (0.0, 0.0, 0.0)))
        assert len(scene.cf2.heard) == 1
        scene.cf1.free.set()
        await scene.sees()
        assert [x for x, _, _ in scene.cf1.heard][-1] == 8.0
        assert len(scene.cf1.heard) == 2

    played(play)


def test_a_drone_that_never_hears_does_not_know_where_it_is() -> None:
    """However often it is seen."""

    async def play(scene: Scene) -> None:
        scene.cf1.free.clear()
        await scene.sees(("cf1", (1, 1, 1)))
        scene.now += 1.5
        await scene.sees(("cf1", (1, 1, 1)), ("cf2", (1, 1, 1)))
        assert scene.feeding.silent("cf1") == "no position from eyes for 1.5 s"
        assert scene.feeding.silent("cf2") is None

    played(play)


def test_a_drone_that_cannot_hear_is_told_of_once_and_tried_again() -> None:
    async def play(scene: Scene) -> None:
        scene.cf1.broken = True
        await scene.sees(("cf1", (1, 1, 1)))
        await scene.sees(("cf1", (1, 1, 1)))
        scene.cf1.broken = False
        await scene.sees(("cf1", (2, 2, 2)))
        assert scene.cf1.heard == [(2, 2, 2)]
        assert scene.said == ["cf1 could not be told where it is: OSError: no radio"]

    played(play)


@pytest.mark.parametrize(
    ("end", "why"), [(None, "it ended"), (OSError("unplugged"), "OSError: unplugged")]
)
def test_eyes_that_close_are_opened_again(
    end: object, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(localization, "PAUSE", 0.0)

    async def play(scene: Scene) -> None:
        await scene.sees(("cf1", (1, 1, 1)), end, ("cf1", (2, 2, 2)))
        assert scene.cf1.heard == [(1, 1, 1), (2, 2, 2)]
        assert scene.said == [f"the localization eyes gives no positions any more ({why})"]
        assert scene.eyes.closed == 1

    played(play)
