"""Awaits somebody else's coroutine, and notices how long each of its steps keeps all others waiting."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Generator
from typing import Any, Generic, TypeVar

from plutoc_runtime.domain.errors import ANY_ERROR

T = TypeVar("T")


class Timed(Generic[T]):
    """Stands for what is awaited; `told` hears of every step of it, in seconds."""

    def __init__(
        self, awaited: Awaitable[T], clock: Callable[[], float], told: Callable[[float], object]
    ) -> None:
        self._awaited, self._clock, self._told = awaited, clock, told

    def __await__(self) -> Generator[Any, Any, T]:
        steps = _awaiting(self._awaited)
        thrown: BaseException | None = None
        while True:
            began = self._clock()
            try:
                waits_for = steps.send(None) if thrown is None else steps.throw(thrown)
            except StopIteration as end:
                returned: T = end.value
                return returned
            finally:
                self._told(self._clock() - began)
            thrown = None
            try:
                yield waits_for
            except ANY_ERROR as error:
                thrown = error


async def _awaiting(awaited: Awaitable[T]) -> T:
    """Whatever it is, a coroutine can be driven by hand."""
    return await awaited
