"""The kit finds what is wrong with a tracker; the one that the page shows passes, over a real socket."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import AsyncIterator, Mapping
from typing import ClassVar

import pytest
from bodies import Bodies

from pluto_fleet.drones.conformance import TrackerContract
from pluto_fleet.drones.tracking import Track
from tests.kit.drones import JumpingLoop
from tests.library.drones.conformance.wrong import send


class TestBodies(TrackerContract):
    """As an author tests it: the packets come from elsewhere."""

    seconds = 0.4
    port = 0

    def make(self) -> Bodies:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            TestBodies.port = free.getsockname()[1]
        return Bodies({"port": self.port})

    async def moves(self) -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as camera:
            while True:
                told = {"body": "cart", "position": [1.0, 2.0, 0.0]}
                camera.sendto(json.dumps(told).encode(), ("127.0.0.1", self.port))
                await asyncio.sleep(0.05)


class Right:
    """A tracker that sees something ten times a second."""

    found_by: ClassVar[str]
    says: ClassVar[str]
    each = 0.1
    x = 1.0

    def __init__(self, options: Mapping[str, object]) -> None:
        assert not options

    async def tracks(self) -> AsyncIterator[Track]:
        while True:
            now = asyncio.get_running_loop().time()
            yield Track(id="t1", kind="person", at=(self.x, 2.0, 0.0), time=now)
            await asyncio.sleep(self.each)


class InVirtualTime(TrackerContract):
    loop_factory = JumpingLoop
    tracker: type[Right] = Right
    seconds = 2.5

    def make(self) -> Right:
        return self.tracker({})


class TestRight(InVirtualTime):
    """A right one passes."""


class Blind(Right):
    found_by = "test_it_sees_what_moves"
    says = "it has said nothing in 2.5 s"

    async def tracks(self) -> AsyncIterator[Track]:
        await asyncio.sleep(1000)
        yield Track(id="t1", at=(1.0, 2.0, 0.0))


class Blocking(Right):
    found_by = "test_the_event_loop_is_never_held_up"
    says = "wrong.py:"
    each = 1.0

    async def tracks(self) -> AsyncIterator[Track]:
        async for one in super().tracks():
            send()
            yield one


class Feet(Right):
    found_by = "test_what_it_says_can_be_followed"
    says = 'sees "t1" far from the map, at (40, 2)'
    x = 40.0


class Lingering(Right):
    found_by = "test_it_leaves_no_thread_task_or_socket"
    says = "what it has opened is left: the task"
    over: ClassVar[list[asyncio.Task[None]]] = []

    async def tracks(self) -> AsyncIterator[Track]:
        self.over.append(asyncio.create_task(asyncio.sleep(1000)))
        async for one in super().tracks():
            yield one


class Once(Right):
    found_by = "test_it_sees_on_when_it_is_asked_again"
    says = "it said nothing when it was asked a second time"
    was_asked = False

    async def tracks(self) -> AsyncIterator[Track]:
        if self.was_asked:
            await asyncio.sleep(1000)
        self.was_asked = True
        async for one in super().tracks():
            yield one


class Slow(Right):
    found_by = "test_each_thing_is_told_at_least_twice_a_second"
    says = "it told nothing of t1 for 1.00 s"
    each = 1.0


@pytest.mark.parametrize("wrong", Right.__subclasses__(), ids=lambda wrong: wrong.__name__)
def test_a_wrong_tracker_is_found_by_the_check_that_it_names(wrong: type[Right]) -> None:
    contract = type("Contract", (InVirtualTime,), {"tracker": wrong})()
    with pytest.raises(AssertionError) as found:
        getattr(contract, wrong.found_by)()
    assert wrong.says in str(found.value)


def test_an_author_who_gives_nothing_is_told_what_to_give() -> None:
    with pytest.raises(NotImplementedError, match="def make"):
        TrackerContract().test_it_sees_what_moves()
