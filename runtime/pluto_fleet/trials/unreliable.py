"""A trial's unreliable clock, which wakes up late, and link, whose messages are delayed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Coroutine
from functools import partial
from inspect import iscoroutine
from random import Random
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from ..gateway.gateway import Link
from ..shared.domain.errors import Cancelled, FlightFailed
from ..shared.domain.guard import guarded
from ..shared.time.future import Future
from ..shared.time.kernel import FLEET, EventKind, Key, Task, Timer
from ..shared.time.virtual import VirtualTime

if TYPE_CHECKING:
    from ..gateway.gateway import Gateway
    from ..jobs.job import Job, Report
    from ..jobs.reports import Down, DroneReport, FleetReport
    from ..shared.time.kernel import Kernel
    from .case import Weather

T = TypeVar("T")

_HOOK_BLOCKS_FOR = 30.0
"""Seconds for which a hook blocks."""


class BrokenHook(RuntimeError):
    """An unexpected error of a hook."""


class UnreliableTime(VirtualTime):
    """Virtual time for one brain, with late wake-ups."""

    def __init__(
        self,
        now: float,
        weather: Weather,
        chance: Random,
        fired: Counter[str],
    ) -> None:
        super().__init__()
        self.now = now
        self.dead = False
        self._weather, self._chance, self._fired = weather, chance, fired

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
        self._kernel, self._weather, self._chance = kernel, weather, chance
        self._fired, self._done = fired, done
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
        link: Link,
        gateway: Gateway,
        brain: Kernel,
        slow: float,
        fired: Counter[str],
        sent: Callable[[str], object],
    ) -> None:
        super().__init__(gateway, None)
        self._real, self._world, self._brain = link, gateway.kernel, brain
        self._slow, self._fired, self._sent = slow, fired, sent
        self.alive = True

    def fly(self, job: Job, report: Report) -> None:
        """Give a drone its job."""
        self._sent(job.id)
        self._send(partial(self._real.fly, job, partial(self._told, report)))

    def break_off(self, drone: str) -> None:
        """Stop what a drone does."""
        self._send(partial(self._real.break_off, drone))

    def attach(self, id: str, report: Report) -> None:
        """Register for the report of an earlier job."""
        self._send(partial(self._real.attach, id, partial(self._told, report)))

    def forget(self, id: str) -> None:
        """Forget a job."""
        self._send(partial(self._real.forget, id))

    def hold(self, drone: str) -> Coroutine[Any, Any, None]:
        """Hover."""
        return self._far(partial(self._real.hold, drone))

    def read(self, drone: str, name: str) -> Coroutine[Any, Any, float]:
        """Return a sensor or variable of a drone."""
        return self._far(partial(self._real.read, drone, name))

    def write(self, drone: str, name: str, value: float) -> Coroutine[Any, Any, None]:
        """Set a parameter of a drone."""
        return self._far(partial(self._real.write, drone, name, value))

    def mended(self, drone: str) -> None:
        """Called when a lost drone has been repaired."""
        self._send(partial(self._real.mended, drone))

    def home(self, drone: str) -> Coroutine[Any, Any, None]:
        """Fly to its dock, and land there."""
        return self._far(partial(self._real.home, drone))

    def land(self, drone: str) -> Coroutine[Any, Any, None]:
        """Land here."""
        return self._far(partial(self._real.land, drone))

    def recover(self, drone: str) -> Coroutine[Any, Any, bool]:
        """Bring a drone home after a failed flight."""
        return self._far(partial(self._real.recover, drone))

    def drone_report(self, drone: str) -> Coroutine[Any, Any, DroneReport]:
        """Ask a drone where it is and what it has done."""
        return self._far(partial(self._real.drone_report, drone))

    def fleet_report(self) -> Coroutine[Any, Any, FleetReport]:
        """Query all drones and the ledger."""
        return self._far(partial(self._real.fleet_report))

    def bring_down(self, how: Down) -> Coroutine[Any, Any, None]:
        """Bring all drones down."""
        return self._far(partial(self._real.bring_down, how))

    async def _far(self, command: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """Run a command in the world, independently of the brain, and await its result.

        Messages are delayed; a task that is cancelled here is cancelled there.
        """
        over: Future[T] = Future()
        under_way: list[Task[T]] = []

        def begin() -> None:
            task = self._world.spawn(command(), FLEET, "a command from afar")
            under_way.append(task)
            task.over = end

        def end(task: Task[T]) -> None:
            self._send(partial(self._brain.post, _settle, over, task))

        def call_off() -> None:
            for task in under_way:
                task.cancel()

        self._send(begin)
        try:
            return await over
        except Cancelled:
            self._send(call_off)
            raise

    def _send(self, message: Callable[[], object]) -> None:
        if self._slow:
            self._fired["slow line"] += 1
            now = self._world.now
            self._world.schedule(
                now + self._slow, EventKind.FLIGHT, FLEET, partial(self._go, message)
            )
        else:
            self._go(message)

    def _go(self, message: Callable[[], object]) -> None:
        if self.alive:
            message()

    def _told(self, report: Report, result: Any) -> None:
        if isinstance(result, FlightFailed):
            self._fired[f"flight: {result.failure.value}"] += 1
        if not self.alive:
            self._fired["report to nobody"] += 1
        self._send(partial(self._brain.post, report, result))


def _settle(over: Future[T], task: Task[T]) -> None:
    """Deliver a command's result; a cancelled one is not awaited."""
    if task.error is None:
        over.set(task.result())
    elif not isinstance(task.error, Cancelled):
        over.fail(task.error)
