"""How long this process was kept from listening to its drones: that is no silence of theirs."""

from __future__ import annotations

from collections import deque


class Lag:
    """The stalls of an event loop, by a call that is due again and again."""

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
