"""Virtual time: the clock jumps to the next event. Nothing sleeps, and a day takes a moment."""

from __future__ import annotations

import os
from collections.abc import Callable, Coroutine, Generator
from functools import partial
from types import coroutine
from typing import Any, TypeVar

from .forked import end_if_forked
from .kernel import WHATEVER, ForeignAwait, Kernel
from .raised import by_a_person, refuse_if_not_its_own
from .signals import Signal
from .straight import is_coroutine, never_waits

T = TypeVar("T")


class Stuck(RuntimeError):
    """Nothing will ever happen again, and somebody still waits."""


class VirtualTime(Kernel):
    """The kernel of simulations. Its day begins at midnight."""

    @property
    def time_of_day(self) -> float:
        """Seconds since midnight: the simulation starts then."""
        return self.now % 86_400

    def run(self, done: Signal[T], until: float | None = None) -> bool:
        """Go on until it is done, or until a time; say whether it is done."""
        done.watch(self._stop)
        while not done.is_set and self.crashed is None:
            self.over = False
            when = self.next_time()
            if when is None:
                waiting = ", ".join(sorted(task.name for task in self.tasks))
                raise Stuck(f"nothing will ever happen again; waiting: {waiting}")
            if until is not None and when > until:
                self.now = until
                return False
            self.now = when
            self.drain()
            if self.settled is not None:
                self.settled()
        if self.crashed is not None:
            raise self.crashed
        return True

    def _stop(self, _: object) -> None:
        self.over = True

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook here and now; an `async def` may await only what its context offers."""
        parent = os.getpid()
        waiting: Coroutine[Any, Any, object] | None = None
        try:
            result = hook(*args, **named)
            if is_coroutine(result):
                if never_waits(hook):
                    result = await result
                else:
                    waiting = result
        except BaseException as error:
            refuse_if_not_its_own(error, parent)
            raise
        if os.getpid() != parent:
            end_if_forked(parent)
        if waiting is None:
            return result
        try:
            return await _called_off_for_good(waiting)
        except RuntimeError as error:
            if isinstance(error, ForeignAwait) or "no running event loop" in str(error):
                raise RuntimeError(
                    "in a simulation a hook may await only what its context offers "
                    "(context.sleep, context.trip_ended), not asyncio"
                ) from error
            raise

    async def offer(self, signal: Signal[T]) -> T:
        """Return what a hook may await for this signal."""
        return await signal


@coroutine
def _called_off_for_good(hook: Coroutine[Any, Any, T]) -> Generator[Any, Any, T]:
    """Let a hook run inside this coroutine; one that is called off cannot hold on, or go on."""
    parent = os.getpid()
    step: Callable[[], object] = partial(hook.send, None)
    while True:
        try:
            waits_for = step()
        except StopIteration as end:
            end_if_forked(parent)
            returned: T = end.value
            return returned
        except BaseException as error:
            refuse_if_not_its_own(error, parent)
            raise
        end_if_forked(parent)
        try:
            yield waits_for
            step = partial(hook.send, None)
        except ForeignAwait as error:
            step = partial(hook.throw, error)
        except BaseException as error:
            for call in (partial(hook.throw, error), hook.close):
                try:
                    call()
                except WHATEVER as its_own:  # whatever it does about it, nobody wants it any longer
                    if by_a_person(its_own):
                        raise
            raise
