"""What moves, as a tracker says it: what is nonsense is told once, and what is old is forgotten."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from dataclasses import dataclass
from time import monotonic
from typing import Any, Self

import pytest

from pluto_fleet.drones import source
from pluto_fleet.drones.loading import make_tracker
from pluto_fleet.drones.tracking import KNOWN, MOST, Track, TrackFeed
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput


class Eyes:
    """A tracker that sees what is put into a queue; None: it stops looking."""

    def __init__(self) -> None:
        self.seen: asyncio.Queue[Any] = asyncio.Queue()

    async def tracks(self) -> AsyncIterator[Track]:
        while (one := await self.seen.get()) is not None:
            yield one


class Scene:
    """Eyes, a clock and what is said."""

    def __init__(self) -> None:
        self.eyes = Eyes()
        self.said: list[str] = []
        self.now = 100.0
        self.feed = TrackFeed(
            "eyes", self.eyes, Airspace(size=(10.0, 8.0)), self.said.append, lambda: self.now
        )

    async def __aenter__(self) -> Self:
        self.feed.start()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.feed.close()
        assert asyncio.all_tasks() == {asyncio.current_task()}

    async def sees(self, *what: object) -> None:
        for one in what:
            self.eyes.seen.put_nowait(one)
        for _ in range(4 * len(what) + 4):
            await asyncio.sleep(0)

    def person(self, id: str = "t1", x: float = 2.0, ago: float = 0.0) -> Track:
        return Track(id=id, kind="person", at=(x, 3.0, 0.0), time=self.now - ago)


async def test_each_is_told_once_with_how_long_ago_it_was_there() -> None:
    async with Scene() as scene:
        await scene.sees(scene.person(ago=0.5), scene.person(x=2.5, ago=0.25))
        told = {"kind": "person", "at": [2.5, 3.0, 0.0], "ago": 0.25}
        assert scene.feed.news() == {"t1": told}
        assert scene.feed.news() == {}
        await scene.sees(scene.person(x=2.0, ago=0.5))  # it comes late
        assert scene.feed.news() == {}
        assert scene.said == []


async def test_a_camera_sees_what_is_below_it_until_that_has_had_no_news_for_long() -> None:
    async with Scene() as scene:
        await scene.sees(scene.person("t1", 2.0), scene.person("t2", 4.0))
        seen = scene.feed.in_view((2.5, 3.2, 1.2), 1.9, 1.4)
        assert [(one.track, one.kind, one.at) for one in seen] == [("t1", "person", (2, 3, 0))]
        scene.now += KNOWN + 0.1
        assert scene.feed.in_view((2.5, 3.2, 1.2), 1.9, 1.4) == ()
        assert scene.feed.news() == {}


@dataclass
class Odd:
    """What may be no track."""

    id: Any = "t1"
    at: Any = (1.0, 2.0, 0.0)
    kind: Any = ""
    time: Any = 100.0


@pytest.mark.parametrize(
    ("what", "said"),
    [
        ("t1", "gave what is no track: it has no id that can be shown"),
        (Odd(id="t\x1b1"), "gave what is no track: it has no id that can be shown"),
        (Odd(kind="a\nb"), 'gave "t1" a kind that cannot be shown'),
        (Odd(at=(1.0, 2.0)), 'gave "t1" no place: at must be three numbers'),
        (Odd(at=(1.0, float("nan"), 0.0)), 'gave "t1" a place that is no number'),
        (Odd(at=(99.0, 2.0, 0.0)), 'sees "t1" far from the map, at (99, 2)'),
        (Odd(time=0.0), 'gave "t1" a time that is not now, by time.monotonic()'),
        (Odd(time=float("nan")), 'gave "t1" a time that is not now, by time.monotonic()'),
        (Odd(time=200.0), 'gave "t1" a time that is not now, by time.monotonic()'),
    ],
)
async def test_nonsense_is_told_once_and_followed_by_nobody(what: object, said: str) -> None:
    async with Scene() as scene:
        await scene.sees(what, what)
        assert scene.said == [f"the tracker eyes {said}"]
        assert scene.feed.news() == {}


async def test_one_that_invents_ever_new_things_fills_no_memory() -> None:
    async with Scene() as scene:
        await scene.sees(*(scene.person(f"t{count}") for count in range(MOST + 20)))
        assert len(scene.feed.news()) == MOST
        assert scene.said == [
            f"the tracker eyes sees more than {MOST} things that move: the others are left out"
        ]
        scene.now += KNOWN + 0.1
        await scene.sees(scene.person("late"))
        assert [*scene.feed.news()] == ["late"]


async def test_one_that_ends_is_asked_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(source, "PAUSE", 0.0)
    async with Scene() as scene:
        await scene.sees(None, scene.person())
        assert [*scene.feed.news()] == ["t1"]
        assert scene.said == ["the tracker eyes gives no tracks any more (it ended)"]


# The built-in tracker


def test_lines_of_another_program_are_tracks() -> None:
    said = {"id": "t7", "kind": "person", "at": [1, 2, 0], "ago": 0.5}

    async def say(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writer.write(json.dumps(said).encode() + b"\n")
        writer.close()

    async def hear() -> list[Track]:
        async with await asyncio.start_server(say, "127.0.0.1", 0) as server:
            port = server.sockets[0].getsockname()[1]
            tracker = make_tracker("lines", {"address": f"127.0.0.1:{port}"})
            return [track async for track in tracker.tracks()]

    before = monotonic()
    (track,) = asyncio.run(hear())
    assert (track.id, track.kind, track.at) == ("t7", "person", (1, 2, 0))
    assert before - 0.5 <= track.time <= monotonic() - 0.5


@pytest.mark.parametrize("options", [{}, {"address": "5006"}, {"address": "h:1", "port": 1}])
def test_lines_without_an_address_are_refused(options: dict[str, object]) -> None:
    with pytest.raises(BadInput, match=r"one option, such as address"):
        make_tracker("lines", options)
