"""The checks of trackers: what one says in a few seconds, taken in as a flight would."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from weakref import WeakKeyDictionary

from ...shared.domain.airspace import Airspace
from ..loading import TRACKER, problems
from ..tracking import Track, Tracker, TrackFeed
from .probes import LoopWatch, left_since, resources

LONGEST = 0.75
"""Seconds between two reports of one thing, at most: they come at least twice a second, and a machine may be busy."""
_WATCHED: WeakKeyDictionary[type, Watched] = WeakKeyDictionary()
"""What was seen of each test class's tracker."""


@dataclass(slots=True)
class Watched:
    """What a tracker has said, and done."""

    made: type
    heard: list[tuple[float, Track]] = field(default_factory=list)
    """All that it yielded, with when that was."""
    rounds: list[int] = field(default_factory=list)
    """How much it had yielded at the end of each time that it was asked."""
    said: list[str] = field(default_factory=list)
    """What a flight's log would say of it."""
    blocked: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)


class TrackerContract:
    """What any tracker must do. Subclass it, and provide `make`; pytest finds the checks by their names.

    Something must move where it looks, while the checks run.
    """

    seconds = 3.0
    """For how long it is listened to, twice."""
    size = (20.0, 20.0)
    """The map's size in metres."""
    loop_factory: Callable[[], asyncio.AbstractEventLoop] | None = None
    """What makes the event loop, if a simulator's time is not the clock's."""

    def make(self) -> Tracker:
        """Return a fresh tracker."""
        raise NotImplementedError("give the kit a tracker: def make(self) -> Tracker")

    async def moves(self) -> None:
        """Have something move that it sees, until cancelled: by default that is there by itself."""

    def _watched(self) -> Watched:
        kind = type(self)
        if kind not in _WATCHED:
            with asyncio.Runner(loop_factory=self.loop_factory) as runner:
                _WATCHED[kind] = runner.run(self._watch())
        return _WATCHED[kind]

    async def _watch(self) -> Watched:
        """Listen to it twice, as after a fault of it."""
        tracker = self.make()
        watched = Watched(type(tracker))
        loop = asyncio.get_running_loop()
        before = resources()
        moving = asyncio.create_task(self.moves())

        class Overheard:
            async def tracks(self) -> AsyncIterator[Track]:
                yielded = tracker.tracks()
                try:
                    async for one in yielded:
                        watched.heard.append((loop.time(), one))
                        yield one
                finally:
                    close = getattr(yielded, "aclose", None)
                    if close is not None:
                        await close()

        with LoopWatch() as blocks:
            for _ in range(2):
                space = Airspace(size=self.size)
                feed = TrackFeed("of the test", Overheard(), space, watched.said.append, loop.time)
                feed.start()
                await asyncio.sleep(self.seconds)
                await feed.close()
                watched.rounds.append(len(watched.heard))
        moving.cancel()
        with suppress(asyncio.CancelledError):
            await moving
        watched.blocked = blocks.found
        watched.left = await left_since(before)
        return watched

    def test_its_class_has_what_it_must_have(self) -> None:
        wrong = problems(TRACKER, self._watched().made)
        assert not wrong, "; ".join(wrong)

    def test_it_sees_what_moves(self) -> None:
        watched = self._watched()
        assert watched.rounds[0] > 0, f"it has said nothing in {self.seconds:g} s: {watched.said}"

    def test_it_sees_on_when_it_is_asked_again(self) -> None:
        first, second = self._watched().rounds
        assert second > first, "it said nothing when it was asked a second time"

    def test_what_it_says_can_be_followed(self) -> None:
        """It is on the map, now, and has a name; a flight's log says nothing of it."""
        said = self._watched().said
        assert not said, "; ".join(said)

    def test_each_thing_is_told_at_least_twice_a_second(self) -> None:
        watched = self._watched()
        rounds = (0, *watched.rounds)
        for start, end in pairwise(rounds):
            times: dict[str, list[float]] = {}
            for _, one in watched.heard[start:end]:
                times.setdefault(str(one.id), []).append(one.time)
            for id, each in times.items():
                gap = max((later - earlier for earlier, later in pairwise(each)), default=0.0)
                assert gap <= LONGEST, f"it told nothing of {id} for {gap:.2f} s"
                backward = any(later < earlier for earlier, later in pairwise(each))
                assert not backward, f"the times of {id} go back"

    def test_the_event_loop_is_never_held_up(self) -> None:
        blocked = self._watched().blocked
        assert not blocked, f"the event loop was held up {'; '.join(blocked)}"

    def test_it_leaves_no_thread_task_or_socket(self) -> None:
        left = self._watched().left
        assert not left, f"what it has opened is left: {', '.join(left)}"
