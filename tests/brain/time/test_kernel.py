"""The kernel: events of one instant come in declared order, and nothing is lost."""

from __future__ import annotations

import asyncio
from functools import partial

import pytest

from pluto_fleet.shared.domain.errors import Cancelled
from pluto_fleet.shared.domain.keeper import reading
from pluto_fleet.shared.hooks.calls import call_hook
from pluto_fleet.shared.time.kernel import EventKind, Future
from pluto_fleet.shared.time.told import Stuck, VirtualTime


def test_events_of_one_instant_come_by_kind_then_key_in_any_order_of_entry() -> None:
    kernel, seen = VirtualTime(), list[str]()
    done: Future[None] = Future()
    entries = [
        (EventKind.ALLOCATE, 0),
        (EventKind.TIMER, 0),
        (EventKind.FLIGHT, 1),
        (EventKind.FLIGHT, 0),
    ]
    for kind, key in entries:
        kernel.at(5.0, kind, key, partial(seen.append, f"{kind.name} {key}"))
    kernel.at(6.0, EventKind.CLOCK, 0, partial(done.set, None))
    assert kernel.run(done)
    assert seen == ["FLIGHT 0", "FLIGHT 1", "TIMER 0", "ALLOCATE 0"]
    assert kernel.now == 6.0


def test_a_signal_that_comes_at_the_very_limit_has_come() -> None:
    kernel, won = VirtualTime(), list[bool]()
    signal: Future[None] = Future()

    async def wait() -> None:
        won.append(await kernel.within(signal, 5.0, EventKind.TIMER, 0))

    task = kernel.spawn(wait(), 0, "waiter")
    kernel.at(5.0, EventKind.FLIGHT, 0, partial(signal.set, None))
    kernel.run(task)
    assert won == [True]


def test_time_that_runs_out_says_so() -> None:
    kernel = VirtualTime()
    never: Future[None] = Future()
    task = kernel.spawn(kernel.within(never, 5.0, EventKind.TIMER, 0), 0, "waiter")
    kernel.run(task)
    assert (task.result(), kernel.now) == (False, 5.0)


def test_a_run_that_can_never_end_names_who_waits() -> None:
    kernel = VirtualTime()
    never: Future[None] = Future()

    async def wait() -> None:
        await never

    task = kernel.spawn(wait(), 0, "the nurse's mission")
    with pytest.raises(Stuck, match="the nurse's mission"):
        kernel.run(task)
    kernel.close()


def test_a_cancelled_coroutine_stops_where_it_waits_and_cleans_up() -> None:
    kernel, seen = VirtualTime(), list[str]()

    async def wait() -> None:
        try:
            await kernel.sleep(10)
        finally:
            seen.append(f"cleaned up at {kernel.now}")

    task = kernel.spawn(wait(), 0, "waiter")
    kernel.at(3.0, EventKind.TIMER, 0, task.cancel)
    kernel.run(task)
    assert seen == ["cleaned up at 3.0"]
    with pytest.raises(Cancelled):
        task.result()


def test_a_coroutine_that_is_cancelled_in_its_turn_may_still_wait_to_clean_up() -> None:
    kernel, seen = VirtualTime(), list[float]()
    signal: Future[None] = Future()

    async def wait() -> None:
        try:
            await signal
        finally:
            await kernel.sleep(2.0)
            seen.append(kernel.now)

    task = kernel.spawn(wait(), 1, "waiter")

    def happen_and_cancel() -> None:
        signal.set(None)  # its turn comes at this instant
        task.cancel()

    kernel.at(3.0, EventKind.CLOCK, 0, happen_and_cancel)
    over = kernel.spawn(kernel.sleep(10.0), 2, "clock")
    kernel.run(over)
    assert seen == [5.0]


def test_an_error_that_is_not_awaited_stops_the_run() -> None:
    kernel = VirtualTime()

    async def broken() -> None:
        raise ZeroDivisionError

    kernel.spawn(broken(), 0, "broken")
    with pytest.raises(ZeroDivisionError):
        kernel.run(Future[None]())


def test_a_run_stops_at_its_time_and_can_go_on() -> None:
    kernel = VirtualTime()
    task = kernel.spawn(kernel.sleep(10), 0, "sleeper")
    assert not kernel.run(task, until=4.0)
    assert kernel.now == 4.0
    assert kernel.run(task)
    assert kernel.now == 10.0


def test_in_virtual_time_a_hook_that_awaits_asyncio_is_told_what_it_may_await() -> None:
    async def sleeps() -> None:
        await asyncio.sleep(0.05)

    async def yields() -> None:
        await asyncio.sleep(0)

    for hook in (sleeps, yields):
        kernel = VirtualTime()
        task = kernel.spawn(call_hook(kernel, reading(), hook), 0, "hook")
        task.watch(lambda _: None)
        kernel.run(task)
        with pytest.raises(RuntimeError, match=r"only what its context offers"):
            task.result()


def test_a_coroutine_that_is_cancelled_before_its_first_turn_never_runs() -> None:
    """Even the very first event of a kernel."""
    kernel = VirtualTime()

    async def runs() -> None:
        raise ZeroDivisionError

    kernel.spawn(runs(), 0, "first").cancel()
    kernel.run(kernel.spawn(kernel.sleep(1.0), 1, "clock"))
    assert kernel.now == 1.0
