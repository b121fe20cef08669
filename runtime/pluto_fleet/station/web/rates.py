"""How often somebody may ask: so much at once, and so much a second after that."""

from __future__ import annotations

from collections.abc import Callable

_KNOWN = 1024
"""Clients that are remembered; who is forgotten begins anew."""


class Rate:
    """What each client has left."""

    def __init__(
        self, a_second: float, clock: Callable[[], float], at_once: float | None = None
    ) -> None:
        self._a_second, self._clock = a_second, clock
        self._at_once = a_second if at_once is None else at_once
        self._left: dict[str, tuple[float, float]] = {}

    def allows(self, client: str) -> bool:
        """Whether this client may ask once more; if so, it has."""
        now = self._clock()
        left, since = self._left.pop(client, (self._at_once, now))
        left = min(self._at_once, left + (now - since) * self._a_second)
        allowed = left >= 1
        self._left[client] = (left - 1 if allowed else left, now)
        if len(self._left) > _KNOWN:
            del self._left[next(iter(self._left))]
        return allowed
