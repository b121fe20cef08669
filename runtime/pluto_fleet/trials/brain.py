"""One life of an app in a trial: its own clock, and a journal that can fail it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Coroutine
from random import Random
from typing import TYPE_CHECKING, Any, TypeVar

from plutoc_runtime.time.kernel import Key, Task, Timer
from plutoc_runtime.time.kernel import Kind as When
from plutoc_runtime.time.virtual import VirtualTime

if TYPE_CHECKING:
    from .case import Weather

T = TypeVar("T")

_LONG = 30.0
"""Seconds that a hook takes that blocks."""


class BrokenHook(RuntimeError):
    """What a hook raises that nobody expected."""


class BrainTime(VirtualTime):
    """Virtual time for one brain: it wakes up late, and its hooks fail, as the weather has it."""

    def __init__(
        self,
        now: float,
        weather: Weather,
        chance: Random,
        fired: Counter[str],
        done: Callable[[Callable[..., object], tuple[object, ...]], object],
    ) -> None:
        super().__init__()
        self.now = now
        self.dead = False
        self._weather, self._chance, self._fired, self._done = weather, chance, fired, done

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Set a coroutine on its way; in a dead brain none sets out."""
        task = super().spawn(coroutine, key, name)
        if self.dead:
            task.drop()
        return task

    def at(self, when: float, kind: When, key: Key, call: Callable[[], object]) -> Timer:
        """Call this at a time, or a little later."""
        late = self._weather.late
        if late and when > self.now and self._chance.random() < late:
            self._fired["late wake-up"] += 1
            when += self._chance.random() * 0.5
        return super().at(when, kind, key, call)

    async def call_hook(
        self, hook: Callable[..., object], /, *args: object, **named: object
    ) -> object:
        """Run a hook, or let it fail."""
        if self._weather.hook and self._chance.random() < self._weather.hook:
            self._fired["hook raising"] += 1
            raise BrokenHook("by chance")
        if self._weather.block and self._chance.random() < self._weather.block:
            self._fired["hook blocking"] += 1
            await self.sleep(_LONG)
        result = await super().call_hook(hook, *args, **named)
        self._done(hook, args)
        return result
