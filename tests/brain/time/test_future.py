"""A value that is set once, timers that can be cancelled, and the keys of simultaneous events."""

from __future__ import annotations

from functools import partial

import pytest

from pluto_fleet.shared.domain.errors import Cancelled
from pluto_fleet.shared.time.kernel import FLEET, EventKind, Future, branch_key, mission_key
from pluto_fleet.shared.time.told import ToldTime, VirtualTime


def test_only_the_first_value_or_error_counts() -> None:
    one, other = Future[int](), Future[int]()
    one.set(1)
    one.set(2)
    one.fail(ValueError("late"))
    assert (one.is_set, one.error, one.result()) == (True, None, 1)
    other.fail(ValueError("early"))
    other.set(1)
    with pytest.raises(ValueError, match="early"):
        other.result()


def test_watchers_are_told_once_in_their_order_and_not_after_they_have_left() -> None:
    future, seen = Future[int](), list[str]()
    watchers = [lambda _, name=name: seen.append(name) for name in "abc"]
    for watcher in watchers:
        future.watch(watcher)
    future.unwatch(watchers[1])
    future.unwatch(print)
    future.set(1)
    future.watch(watchers[1])  # at once: it is set
    future.set(2)
    assert seen == ["a", "c", "b"]


def test_all_that_wait_for_one_value_get_it() -> None:
    kernel, value, seen = VirtualTime(), Future[int](), list[tuple[str, int]]()

    async def wait(name: str) -> None:
        seen.append((name, await value))

    tasks = [kernel.spawn(wait(name), 2 - place, name) for place, name in enumerate("abc")]
    kernel.at(1.0, EventKind.CLOCK, 0, partial(value.set, 7))
    kernel.run(tasks[0])
    assert sorted(seen) == [("a", 7), ("b", 7), ("c", 7)]
    assert seen[0][0] == "c", "in the order of their keys"


def test_a_cancelled_timer_is_not_called_and_is_no_event() -> None:
    kernel, called = ToldTime(), list[float]()
    timers = [
        kernel.at(t, EventKind.CLOCK, 0, lambda: called.append(kernel.now)) for t in (1, 2, 3)
    ]
    assert kernel.next_time() == 1
    timers[0].cancel()
    timers[2].cancel()
    assert (timers[0].cancelled, timers[1].cancelled) == (True, False)
    assert kernel.next_time() == 2
    kernel.call(2.0, (), lambda _: None)
    assert (called, kernel.next_time()) == ([2.0], None)


@pytest.mark.parametrize("when", [-5.0, float("nan"), 3.0])
def test_what_is_due_in_the_past_is_due_now(when: float) -> None:
    kernel, seen = VirtualTime(), list[float]()
    over = Future[None]()

    def happen() -> None:
        kernel.at(when, EventKind.CLOCK, 0, lambda: seen.append(kernel.now))
        kernel.at(4.0, EventKind.CLOCK, 0, lambda: over.set(None))

    kernel.at(3.0, EventKind.CLOCK, 0, happen)
    kernel.run(over)
    assert seen == [3.0]


def test_the_queue_is_served_when_all_else_of_an_instant_is_done() -> None:
    """What is of the kind ALLOCATE comes after it."""
    kernel, seen = VirtualTime(), list[str]()
    over = Future[None]()

    def serve() -> None:
        seen.append("served")
        kernel.at(kernel.now, EventKind.FLIGHT, 0, partial(seen.append, "flight"))

    def begin() -> None:
        kernel.at(kernel.now, EventKind.SERVE, 0, serve)
        kernel.at(kernel.now, EventKind.ALLOCATE, 0, partial(seen.append, "last"))
        kernel.at(kernel.now, EventKind.CLOCK, 0, partial(seen.append, "clock"))

    kernel.at(1.0, EventKind.CLOCK, 0, begin)
    kernel.at(2.0, EventKind.CLOCK, 0, partial(over.set, None))
    kernel.run(over)
    assert seen == ["clock", "served", "flight", "last"]


def test_branches_come_in_their_order_within_their_mission() -> None:
    """At any depth that has a key, and with any number that has one; all before the fleet."""
    keys = [mission_key(3)]
    for depth in range(1, 5):
        keys += [branch_key(keys[-1], number, depth) for number in (0, 1, 7)]
    assert keys == sorted(set(keys))
    assert keys[-1] < mission_key(4) < FLEET
    assert branch_key(keys[-1], 5, 5) == keys[-1], "deeper forks share a key"
    assert branch_key(0, 5_000, 1) == branch_key(0, 1_022, 1) < mission_key(1)


def test_what_ends_the_wait_for_an_end_is_no_cancellation() -> None:
    kernel = VirtualTime()

    async def forever() -> None:
        await Future[None]()

    async def waits() -> str:
        await other.ended()
        return "ended"

    other = kernel.spawn(forever(), 0, "other")
    waiting = kernel.spawn(waits(), 1, "waiting")
    kernel.at(1.0, EventKind.CLOCK, 0, other.cancel)
    kernel.run(waiting)
    assert waiting.result() == "ended"
    with pytest.raises(Cancelled):
        other.result()
