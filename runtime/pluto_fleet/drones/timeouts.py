"""Calls of a drone's navigation: each has a time-out, and every exception becomes a failure."""

from __future__ import annotations

import asyncio
import traceback
from collections import deque
from collections.abc import Awaitable, Callable, Generator
from contextlib import suppress
from functools import partial
from typing import Any, Generic, NoReturn, TypeVar

from ..shared.domain.errors import ANY_ERROR, Failure, FlightFailed
from ..shared.domain.text import duration, printable

T = TypeVar("T")


class _Timed(Generic[T]):
    """Wraps an awaitable; `told` is called with the seconds of every step of it."""

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
    """Wrap any awaitable in a coroutine, which can be driven by hand."""
    return await awaited


BLOCKED = 0.1
"""Seconds for which a navigation may block the event loop before it is logged."""
PARTING = 1.0
"""Seconds that a cancelled call has to end."""
LONGEST = 300
"""Characters of a navigation's message."""
_RARELY, _MANY = 10.0, 100
"""Seconds between two log lines about the same error; how many errors are distinguished."""


class NavigationCalls:
    """All calls of one drone's navigation."""

    def __init__(
        self, drone: str, say: Callable[[str], object], clock: Callable[[], float]
    ) -> None:
        self.drone, self.say, self.clock = drone, say, clock
        self._strays: set[asyncio.Task[Any]] = set()
        """Abandoned calls that have not ended."""
        self._said: dict[str, float] = {}

    async def call(
        self, what: str, limit: float, method: Callable[..., Awaitable[T]], *args: object
    ) -> T:
        """Call a method, and return its result; raise `FlightFailed` for any error.

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
        """Call a method that returns at once; return a default if it raises."""
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
        """Wrap an awaitable, so that steps that block the event loop are logged."""
        return _Timed(awaited, self.clock, self.took)

    def mistake(self, what: str, error: BaseException) -> FlightFailed:
        """Log a bug of the navigation, and return the failure of the flight."""
        said = shortened(f"{type(error).__name__}: {_text(error)}".removesuffix(": "))
        failed = FlightFailed(
            Failure.ACTION, f"the navigation of {self.drone} made a mistake: {said}"
        )
        if self._is_news(f"{what} {said}"):
            trace = "".join(traceback.format_exception(error)).rstrip()
            self.say(f"{failed} ({what})\n{trace}")
        return failed

    def note(self, what: str) -> None:
        """Log a line, unless it was logged a moment ago."""
        if self._is_news(what):
            self.say(what)

    def took(self, seconds: float) -> None:
        if seconds > BLOCKED and self._is_news("blocked"):
            self.say(f"the navigation of {self.drone} blocked for {duration(seconds)}")

    async def parted(self) -> None:
        """Wait briefly until all cancelled calls have ended."""
        if self._strays:
            _, pending = await asyncio.wait(tuple(self._strays), timeout=PARTING)
            if pending and self._is_news("clings"):
                self.say(f"the navigation of {self.drone} goes on with what was cancelled")

    async def _outcome(self, what: str, method: Callable[[], Awaitable[T]]) -> Callable[[], T]:
        try:
            value = await self.timed(method())
        except (asyncio.CancelledError, KeyboardInterrupt):
            raise
        except ANY_ERROR as error:  # even SystemExit, which would end all flights
            return partial(_raise, self._failure(what, error))
        return lambda: value

    def _failure(self, what: str, error: BaseException) -> FlightFailed:
        """Return the failure of a flight, by the error's attribute `failure` and not by its class."""
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
        """Whether this was not logged a moment ago: the log is limited in its rate."""
        now = self.clock()
        if now - self._said.get(what, -_RARELY) < _RARELY:
            return False
        if len(self._said) > _MANY:
            self._said.clear()
        self._said[what] = now
        return True


class Lag:
    """How long this process was kept from listening to its drones, by a call that is due again and again.

    That is no silence of theirs.
    """

    def __init__(self) -> None:
        self._stalls: deque[tuple[float, float]] = deque(maxlen=200)
        """When each ended, and its seconds."""
        self.due = float("inf")
        """When it is called next."""

    def called(self, now: float, due: float) -> None:
        """Note that the call has come, and when it is due next."""
        if now > self.due:
            self._stalls.append((now, now - self.due))
        self.due = due

    def since(self, then: float, now: float) -> float:
        """Return for how many seconds from then to now nothing could be heard."""
        past = sum(min(late, end - then) for end, late in self._stalls if end > then)
        return past + max(0.0, min(now - self.due, now - then))


def shortened(text: str) -> str:
    """Shorten a navigation's message, and escape its control characters."""
    text = printable(" ".join(text.split()))
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"


def _named(error: BaseException) -> Failure | None:
    """Return the failure that an error names; it may be of another copy of this runtime."""
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
