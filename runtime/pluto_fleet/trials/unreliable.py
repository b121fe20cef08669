"""What a brain in a trial depends on, and what may go wrong with it: time, hooks, its link."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Coroutine
from functools import partial
from inspect import iscoroutine
from random import Random
from typing import Any, NoReturn, TypeVar

from ..gateway.gateway import Line
from ..jobs.link import Link, Message, Order
from ..jobs.telemetry import Telemetry
from ..shared.domain.guard import guarded
from ..shared.fleet.orders import failure_of
from ..shared.time.kernel import FLEET, EventKind, Kernel, Key, Task, Timer
from ..shared.time.told import VirtualTime
from .case import (
    BrokenHook,
    Weather,
)

T = TypeVar("T")

_HOOK_BLOCKS_FOR = 30.0
"""Seconds for which a hook blocks."""


class UnreliableTime(VirtualTime):
    """Virtual time for one brain, with late wake-ups."""

    def __init__(self, now: float, weather: Weather, chance: Random, fired: Counter[str]) -> None:
        super().__init__()
        self.now = now
        self.dead = False
        self._weather = weather
        self._chance = chance
        self._fired = fired

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Start a coroutine; not in a dead brain."""
        task = super().spawn(coroutine, key, name)
        if self.dead:
            task.drop()
        return task

    def at(self, when: float, kind: EventKind, key: Key, call: Callable[[], object]) -> Timer:
        """Schedule a call, possibly a little late."""
        late = self._weather.late
        if late and when > self.now and self._chance.random() < late:
            self._fired["late wake-up"] += 1
            when += self._chance.random() * 0.5
        return super().at(when, kind, key, call)


class UnreliableHooks:
    """Runs a trial's hooks: at once, or they block, or raise an error."""

    def __init__(
        self,
        kernel: UnreliableTime,
        weather: Weather,
        chance: Random,
        fired: Counter[str],
        done: Callable[[Callable[..., object], tuple[object, ...]], object],
    ) -> None:
        self._kernel = kernel
        self._weather = weather
        self._chance = chance
        self._fired = fired
        self._done = done
        self.ended: Callable[[int], object] = _nothing
        """Called with the number of a hook that has blocked for long enough."""
        self._calls: dict[int, Callable[[], object]] = {}

    def now(self) -> float:
        """Return the brain's time."""
        return self._kernel.now

    def start(self, number: int, hook: Callable[..., object], call: Callable[[], object]) -> bool:
        """Call a hook, or make it fail; return whether it has ended."""
        if self._weather.hook and self._chance.random() < self._weather.hook:
            self._fired["hook raising"] += 1
            self._calls[number] = _broken
            return True
        assert isinstance(call, partial)
        self._calls[number] = partial(self._call, hook, call)
        if self._weather.block and self._chance.random() < self._weather.block:
            self._fired["hook blocking"] += 1
            late = self._kernel.now + _HOOK_BLOCKS_FOR
            self._kernel.at(late, EventKind.CLOCK, FLEET, partial(self._has_blocked, number))
            return False
        return True

    def result(self, number: int) -> object:
        """Call a hook that was to begin now."""
        return self._calls.pop(number)()

    def cancel(self, number: int) -> None:
        """Forget a hook that blocks."""
        self._calls.pop(number, None)

    def offer(self, _: object) -> None:
        """Hooks are coroutines of the brain."""

    def stirred(self) -> None:
        """They do nothing between two calls of the brain."""

    def deliver(self, call: Callable[[], T]) -> T:
        """They run in the brain's own time."""
        return call()

    def _has_blocked(self, number: int) -> None:
        if number in self._calls:
            self.ended(number)

    def _call(self, hook: Callable[..., object], call: partial[object]) -> object:
        result = guarded(call)
        if not iscoroutine(result):
            self._done(hook, call.args)
            return result
        return self._awaited(hook, call.args, result)

    async def _awaited(
        self, hook: Callable[..., object], args: tuple[object, ...], result: Any
    ) -> object:
        value: object = await result
        self._done(hook, args)
        return value


def _broken() -> NoReturn:
    raise BrokenHook("by chance")


def _nothing(_: object) -> None:
    """The default listener: ignores the report."""


class UnreliableLink(Link):
    """A link with delayed messages in both directions, in order."""

    def __init__(
        self,
        line: Line,
        brain: Kernel,
        slow: float,
        fired: Counter[str],
        sent: Callable[[str], object],
        report_is_lost: Callable[[], bool],
    ) -> None:
        """`sent` is called with each flight that is ordered, `report_is_lost` at each report of one."""
        super().__init__()
        self._line = line
        self._world = line.gateway.kernel
        self._brain = brain
        self._slow = slow
        self._fired = fired
        self._sent = sent
        self._report_is_lost = report_is_lost
        self.alive = True
        self._flights: set[int] = set()
        line.hear = self._told

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry."""
        return self._line.telemetry(drone)

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command."""
        return self._line.moves(drone)

    def send(self, order: Order) -> None:
        """Give an order."""
        if order["do"] in ("fly", "attach"):
            self._flights.add(order["id"])
        if order["do"] == "fly":
            self._sent(order["flight"])
        self._pass(partial(self._line.send, order))

    def _pass(self, message: Callable[[], object]) -> None:
        if self._slow:
            self._fired["slow line"] += 1
            world = self._world
            arrives = partial(self._go, message)
            world.at(world.now + self._slow, EventKind.FLIGHT, FLEET, arrives)
        else:
            self._go(message)

    def _go(self, message: Callable[[], object]) -> None:
        if self.alive:
            message()

    def _told(self, message: Message) -> None:
        is_report = message.get("done", message.get("failed")) in self._flights
        if is_report and self._report_is_lost():
            self._line.gateway.cut()
            return
        if is_report and "failed" in message:
            self._fired[f"flight: {failure_of(message).failure.value}"] += 1
        if not self.alive:
            self._fired["report to nobody"] += 1
        self._pass(partial(self._brain.post, self.take, message))
