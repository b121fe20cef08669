"""The drone itself, while it does an action of the app's own.

Its sensors can be read and its parameters set, but it cannot be moved: it hovers until the action
has ended, and is free for others afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from inspect import iscoroutinefunction, unwrap
from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from ..domain.errors import ActionFailed, FlightFailed
from ..time.future import Future

if TYPE_CHECKING:
    from ..domain.model import Drone, Point
    from ..time.kernel import Kernel, Key, Task

T = TypeVar("T")


class Instruments(Protocol):
    """The part of a navigation that reads and sets values of a hovering drone."""

    async def read(self, drone: str, name: str) -> float: ...
    async def write(self, drone: str, name: str, value: float) -> None: ...


class LiveDrone:
    """The drone of an action: its sensors, and the parameters that can be set.

    Raises `ActionFailed` for a name that the drone does not have, or if it cannot be reached.
    """

    __slots__ = ("_drone", "_is_over", "_kernel", "_key", "_navigation")

    def __init__(self, kernel: Kernel, navigation: Instruments, drone: Drone, key: Key) -> None:
        self._kernel, self._navigation, self._drone, self._key = kernel, navigation, drone, key
        self._is_over = False

    @property
    def position(self) -> Point:
        """Where it is now: metres in the map's frame."""
        return self._now.location

    @property
    def battery(self) -> float:
        """The charge of its battery, from 0 to 1."""
        return self._now.battery_level

    async def read(self, name: str) -> float:
        """Return the current value of a sensor or variable, such as `range.front`."""
        _must_be_a_name(name)
        return await self._asked(lambda drone: self._navigation.read(drone, name), name)

    async def write(self, name: str, value: float) -> None:
        """Set a parameter; returns when the drone has it."""
        _must_be_a_name(name)
        number = float(value)
        if not isfinite(number):
            raise ValueError(f"{name} cannot be set to {number}")
        await self._asked(lambda drone: self._navigation.write(drone, name, number), name)

    def release(self) -> None:
        """End the access to the drone: the action has ended."""
        self._is_over = True

    def is_of(self, drone: Drone) -> bool:
        """Return whether it is this drone."""
        return drone is self._drone

    @property
    def _now(self) -> Drone:
        if self._is_over:
            raise RuntimeError(f"the action of {self._drone.id} is over: it does other things now")
        return self._drone

    async def _asked(self, ask: Callable[[str], Coroutine[Any, Any, T]], name: str) -> T:
        """Make the request within the kernel, and wait for the answer in a hook."""
        kernel, drone = self._kernel, self._now.id
        answer: Future[T] = Future()
        asking: list[Task[T]] = []

        def begin() -> None:
            task = kernel.spawn(ask(drone), self._key, f"{drone} is asked for {name}")
            task.over = lambda task: _hand_on(task, answer)
            asking.append(task)

        kernel.post(begin)
        try:
            return await kernel.offer(answer)
        except FlightFailed as error:
            raise ActionFailed(str(error)) from error
        finally:
            if not answer.is_set:
                kernel.post(asking[0].cancel)


def can_wait(hook: Callable[..., object]) -> bool:
    """Return whether this is an `async def`, decorated or not."""
    inner = unwrap(getattr(hook, "func", hook))  # a partial carries its function
    return iscoroutinefunction(inner)


def _hand_on(task: Task[T], answer: Future[T]) -> None:
    if task.error is None:
        answer.set(task.result())
    else:
        answer.fail(task.error)


_LONGEST = 100
"""Characters of a name."""


def _must_be_a_name(name: str) -> None:
    if not isinstance(name, str) or not 0 < len(name) <= _LONGEST:
        raise ValueError(f"what a drone is asked for is a text of 1 to {_LONGEST} characters")
