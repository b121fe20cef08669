"""Calls to a drone's navigation: each has a limit, and every exception becomes a failure."""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Awaitable, Callable, Generator
from contextlib import suppress
from functools import partial
from typing import Any, Generic, NoReturn, TypeVar

from plutoc_runtime.domain.errors import ANY_ERROR, Failure, FlightFailed
from plutoc_runtime.domain.text import duration, printable

T = TypeVar("T")


class _Timed(Generic[T]):
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
    """Make a coroutine of any awaitable: that can be driven by hand."""
    return await awaited


BLOCKED = 0.1
"""Seconds for which a navigation may keep all drones waiting before it is named in the log."""
PARTING = 1.0
"""Seconds that a cancelled call gets to end."""
LONGEST = 300
"""Characters of what a navigation says."""
_RARELY, _MANY = 10.0, 100
"""Seconds between two lines of the log about the same mistake; how many of these are told apart."""


class NavigationCalls:
    """All that is asked of one drone's navigation."""

    def __init__(
        self, drone: str, say: Callable[[str], object], clock: Callable[[], float]
    ) -> None:
        self.drone, self.say, self.clock = drone, say, clock
        self._strays: set[asyncio.Task[Any]] = set()
        """Calls that were given up and have not ended."""
        self._said: dict[str, float] = {}

    async def call(
        self, what: str, limit: float, method: Callable[..., Awaitable[T]], *args: object
    ) -> T:
        """Return what a method gives; raise `FlightFailed` for all it may end with.

        Cancelling this cancels the method, without waiting for it: see `parted`.
        """
        task = asyncio.ensure_future(self._outcome(what, partial(method, *args)))
        try:
            await asyncio.wait((task,), timeout=limit)
        except asyncio.CancelledError:
            self._leave(task)
            raise
        if not task.done():
            self._leave(task)
            late = f"{self.drone} did not {what} in {duration(limit)}"
            raise FlightFailed(Failure.ACTION, late)
        if task.cancelled():  # by the navigation itself
            raise self.mistake(what, asyncio.CancelledError())
        return task.result()()

    def ask(self, what: str, question: Callable[[], T], otherwise: T) -> T:
        """Return the answer to what takes no time; if asking is a mistake, what is to be believed."""
        began = self.clock()
        try:
            return question()
        except KeyboardInterrupt:
            raise
        except ANY_ERROR as error:
            self.mistake(what, error)
            return otherwise
        finally:
            self.took(self.clock() - began)

    def timed(self, awaited: Awaitable[T]) -> _Timed[T]:
        """Return what to await instead, so that the log says how long each of its steps blocked."""
        return _Timed(awaited, self.clock, self.took)

    def mistake(self, what: str, error: BaseException) -> FlightFailed:
        """Put a mistake of the navigation into the log, and return what becomes of a flight."""
        said = shortened(f"{type(error).__name__}: {_text(error)}".removesuffix(": "))
        failed = FlightFailed(
            Failure.ACTION, f"the navigation of {self.drone} made a mistake: {said}"
        )
        if self._is_news(f"{what} {said}"):
            trace = "".join(traceback.format_exception(error)).rstrip()
            self.say(f"{failed} ({what})\n{trace}")
        return failed

    def note(self, what: str) -> None:
        """Put a line into the log, unless it was put there a moment ago."""
        if self._is_news(what):
            self.say(what)

    def took(self, seconds: float) -> None:
        """Hear how long it has kept everybody waiting."""
        if seconds > BLOCKED and self._is_news("blocked"):
            self.say(f"the navigation of {self.drone} blocked for {duration(seconds)}")

    async def parted(self) -> None:
        """Wait, though not for long, until all that was cancelled has ended."""
        if self._strays:
            _, pending = await asyncio.wait(tuple(self._strays), timeout=PARTING)
            if pending and self._is_news("clings"):
                self.say(f"the navigation of {self.drone} goes on with what was cancelled")

    async def _outcome(self, what: str, method: Callable[[], Awaitable[T]]) -> Callable[[], T]:
        try:
            value = await self.timed(method())
        except (asyncio.CancelledError, KeyboardInterrupt):
            raise
        except ANY_ERROR as error:  # even SystemExit: it would end the flights of all others
            return partial(_raise, self._failure(what, error))
        return lambda: value

    def _failure(self, what: str, error: BaseException) -> FlightFailed:
        """Return what becomes of a flight; by what the error says of itself, not by its class."""
        failure = _named(error)
        if failure is None:
            return self.mistake(what, error)
        reason = shortened(_text(error)) or f"{self.drone} failed: {type(error).__name__}"
        return FlightFailed(failure, reason)

    def _leave(self, task: asyncio.Task[Any]) -> None:
        task.cancel()
        self._strays.add(task)
        task.add_done_callback(self._strays.discard)

    def _is_news(self, what: str) -> bool:
        """Whether this was not said a moment ago: a log of ten lines a second is no log."""
        now = self.clock()
        if now - self._said.get(what, -_RARELY) < _RARELY:
            return False
        if len(self._said) > _MANY:
            self._said.clear()
        self._said[what] = now
        return True


def shortened(text: str) -> str:
    """Return what a navigation says so that it commands no terminal, and fills no log."""
    text = printable(" ".join(text.split()))
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"


def _named(error: BaseException) -> Failure | None:
    """Return the failure that an error names; it may be of another copy of this very runtime."""
    with suppress(Exception):
        name = getattr(error, "failure", None)
        if isinstance(error, Exception) and name is not None:
            return Failure.__members__.get(getattr(name, "name", name))
    return None


def _text(error: BaseException) -> str:
    with suppress(Exception):
        return str(error)
    return ""


def _raise(error: BaseException) -> NoReturn:
    raise error
