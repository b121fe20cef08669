"""What happened, in order: every transition is one event, and nothing else tells what happened."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .kernel import Kernel

Event = Mapping[str, object]
"""`t`, seconds; `event`, such as `trip.launched`; and its facts."""


class Trace:
    """The events of one run."""

    def __init__(self, kernel: Kernel, listener: Callable[[Event], None] | None) -> None:
        self.events: list[Event] = []
        self._kernel, self._listener = kernel, listener

    def note(self, event: str, **facts: object) -> None:
        """Something happened now."""
        noted = {"t": round(self._kernel.now, 6), "event": event, **facts}
        self.events.append(noted)
        if self._listener is not None:
            self._listener(noted)
