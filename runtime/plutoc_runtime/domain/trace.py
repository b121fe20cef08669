"""The trace: every transition is one event, in order, and the only record of a run."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from math import isfinite
from typing import Any, Protocol

Event = Mapping[str, Any]  # `t`, seconds; `event`, such as `trip.launched`; and its facts
Row = tuple[str, tuple[str | int, ...], Mapping[str, Any]]
"""Its table (such as `mission`, `trip`, `drone` or `result`), its key there, and what it holds."""


class Clock(Protocol):
    """The clock of the events: the kernel."""

    now: float  # seconds since the start


class Trace:
    """Sends the events of one run to its listeners; without any, events cost nothing."""

    def __init__(self, clock: Clock, listeners: Sequence[Callable[[Event], object]]) -> None:
        self.live = bool(listeners)
        """Whether there is a listener: check it before composing an event."""
        self._clock, self._listeners = clock, tuple(listeners)

    def listen(self, listener: Callable[[Event], object]) -> None:
        """Send the events to one more listener."""
        self._listeners += (listener,)
        self.live = True

    def note(self, event: str, **facts: object) -> None:
        """Send an event, with the current time."""
        noted = {"t": round(self._clock.now, 6), "event": event, **facts}
        for listener in self._listeners:
            listener(noted)


def dumped(value: object) -> str:
    """Return plain data as JSON on one line."""
    return json.dumps(rounded(value), allow_nan=False)


def rounded(value: object) -> object:
    """Return plain data with every number rounded to three decimals; NaN and infinity become null."""
    match value:
        case float():
            return round(value, 3) + 0.0 if isfinite(value) else None  # + 0.0: never -0.0
        case Mapping():
            return {str(key): rounded(element) for key, element in value.items()}
        case list() | tuple():
            return [rounded(element) for element in value]
        case None | bool() | int() | str():
            return value
        case _:
            return str(value)
