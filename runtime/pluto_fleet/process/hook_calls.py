"""Calling a hook in real time: an `async def` as a task of asyncio, a `def` in a thread."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Generator
from contextlib import suppress
from contextvars import copy_context
from functools import lru_cache, partial
from inspect import CO_COROUTINE, iscoroutinefunction
from opcode import opmap
from threading import Thread
from types import CodeType, CoroutineType, coroutine
from typing import Any, NoReturn, TypeVar, cast

from ..shared.domain.awaited import all_awaited
from ..shared.domain.errors import ANY_ERROR
from ..shared.domain.guard import as_a_fault, guarded
from .signal_guard import by_a_person

T = TypeVar("T")

End = Callable[[], object]
"""Returns what a hook returned, or raises what it raised."""


async def end_of(hook: Callable[..., object], call: Callable[[], object]) -> End:
    """Call a hook, wait for it, and return how it ended."""
    try:
        returned = call() if iscoroutinefunction(hook) else await _in_thread(call)
        if isinstance(returned, CoroutineType):
            returned = await _alone(returned)
    except ANY_ERROR as error:
        if by_a_person(error):
            raise
        return partial(_raise, as_a_fault(error))
    return lambda: returned


def end_at_once(call: Callable[[], object]) -> End:
    """Call an `async def` that never waits, run it to its end, and return how it ended.

    So it ends within the call, as in virtual time, and simultaneous events have the same order in both.
    """
    try:
        hook = cast("Coroutine[Any, Any, object]", guarded(call))
        all_awaited(partial(hook.send, None))
    except StopIteration as end:
        returned: object = end.value
        return lambda: returned
    except ANY_ERROR as error:
        if by_a_person(error):
            raise
        return partial(_raise, error)
    raise RuntimeError("a hook without any `await` waits")


async def _in_thread(call: Callable[[], object]) -> object:
    """Call this in a daemon thread: one that never returns does not keep the app from exiting."""
    loop = asyncio.get_running_loop()
    ended: asyncio.Future[End] = loop.create_future()

    def finish(end: End) -> None:
        if not ended.done():
            ended.set_result(end)

    def tell(end: End) -> None:
        with suppress(RuntimeError):  # the loop is closed: the answer is not needed any more
            loop.call_soon_threadsafe(finish, end)

    def work() -> None:
        try:
            returned = all_awaited(call)
        except ANY_ERROR as error:
            tell(partial(_raise, error))
        else:
            tell(lambda: returned)

    context = copy_context()  # a thread begins with an empty one
    Thread(target=context.run, args=(work,), name="hook", daemon=True).start()
    return (await ended)()


def _raise(error: BaseException) -> NoReturn:
    raise error


@coroutine
def _alone(hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Run a hook inside this coroutine, guarded: a forked copy of the process ends there."""
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = all_awaited(step)
        except StopIteration as end:
            returned: T = end.value
            return returned
        except BaseException:
            guarded(hook.close)  # it may wait: what it does not await is told at once
            raise
        try:
            step = partial(hook.send, (yield waits_for))
        except ANY_ERROR as error:  # raised in the hook
            step = partial(hook.throw, error)


def never_waits(hook: Callable[..., object]) -> bool:
    """Return whether this is an `async def` without any `await`, `async for` or `async with`."""
    code = getattr(getattr(hook, "func", hook), "__code__", None)  # a partial carries its function
    return isinstance(code, CodeType) and _runs_through(code)


@lru_cache(maxsize=1_000)
def _runs_through(code: CodeType) -> bool:
    waits = opmap.get("SEND")  # every `await` is compiled to it
    return bool(waits and code.co_flags & CO_COROUTINE and waits not in code.co_code[::2])
