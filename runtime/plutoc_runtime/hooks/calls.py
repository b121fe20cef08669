"""Calling the app's hooks, and turning their faults into errors."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Generator
from contextvars import Context
from functools import partial
from types import CoroutineType, coroutine
from typing import TYPE_CHECKING, Any, TypeVar

from ..domain.awaited import all_awaited
from ..domain.errors import ActionFailed, Cancelled, HookFault
from ..domain.guard import guarded, unless_by_a_person
from ..domain.keeper import reading
from ..domain.text import LONGEST_LOG, LONGEST_REASON, bounded, said, text_of
from ..time.kernel import ForeignAwait, Future

if TYPE_CHECKING:
    from ..time.told import ToldTime

T = TypeVar("T")

Hook = Callable[..., object]


async def call_hook(
    kernel: ToldTime, context: Context, hook: Hook, /, *args: object, **named: object
) -> object:
    """Call one of the app's hooks in a context, `def` or `async def`, and return its result."""
    runner = kernel.runner
    call = partial(hook, *args, **named)
    if runner is None:
        return await _finished(context, context.run(all_awaited, call))
    kernel.calls = number = kernel.calls + 1
    if not context.run(runner.start, number, hook, call):
        ended = kernel.hooks[number] = Future[None]()
        try:
            await ended
        finally:
            del kernel.hooks[number]
            if not ended.is_set:
                runner.cancel(number)
    return await _finished(context, context.run(guarded, partial(runner.result, number)))


async def offer(kernel: ToldTime, future: Future[T]) -> T:
    """Wait for a future in a hook, which may run outside of the kernel."""
    waits = None if kernel.runner is None else kernel.runner.offer(future.watch)
    if waits is None:
        return await future
    await waits
    return future.result()


async def _finished(context: Context, result: object) -> object:
    """Return what a hook has returned; a coroutine is run to its end."""
    if not isinstance(result, CoroutineType):
        return result
    try:
        return await _run_cancellable(context, result)
    except RuntimeError as error:
        if isinstance(error, ForeignAwait) or "no running event loop" in str(error):
            raise RuntimeError(
                "in a simulation a hook may await only what its context offers "
                "(context.sleep, context.trip_ended), not asyncio"
            ) from error
        raise


@coroutine
def _run_cancellable(context: Context, hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Run a hook inside this coroutine; a cancelled one cannot catch that and run on."""
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = context.run(all_awaited, step)
        except StopIteration as end:
            returned: T = end.value
            return returned
        except BaseException:
            context.run(guarded, hook.close)  # it may wait: what it does not await is told at once
            raise
        try:
            yield waits_for
            step = partial(hook.send, None)
        except ForeignAwait as error:
            step = partial(hook.throw, error)
        except BaseException as error:
            for call in (partial(hook.throw, error), hook.close):
                try:
                    context.run(call)
                except BaseException as its_own:  # noqa: BLE001 - its result is not wanted any more
                    unless_by_a_person(its_own)
                    if isinstance(its_own, StopIteration) and isinstance(error, Cancelled):
                        error.returned = its_own.value
            raise


def fault_of(hook: Hook, error: BaseException) -> HookFault:
    """Return the error for what a hook raised.

    Even `SystemExit` is a fault: it would end all flights. A `KeyboardInterrupt` is the user's.
    """
    if isinstance(error, ActionFailed):
        text = bounded(text_of(error), LONGEST_REASON)
        reason = f"hook {hook_name(hook)} raised ActionFailed, which only an action may: {text}"
    else:
        reason = f"hook {hook_name(hook)} raised {said(error)}"
    return HookFault(reason, trace_of(error))


def ask_policy(name: str, question: Callable[[], T]) -> T:
    """Ask a policy, which may write nothing and cannot wait; what it raises is its fault."""
    try:
        return reading().run(all_awaited, question)
    except HookFault:
        raise
    except BaseException as error:
        unless_by_a_person(error)
        raise HookFault(f"policy {name} raised {said(error)}", trace_of(error)) from error


def hook_name(hook: Hook) -> str:
    """Return a hook's name, as declared."""
    inner = getattr(hook, "func", hook)  # functools.partial carries its function so
    return str(getattr(inner, "__name__", inner))


def trace_of(error: BaseException) -> str:
    """Return the traceback of a hook's error, for the log."""
    from traceback import format_exception  # only where something has gone wrong

    return bounded("".join(format_exception(error)).rstrip(), LONGEST_LOG)
