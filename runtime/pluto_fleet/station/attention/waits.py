"""How long missions have waited for a drone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ..rows import WAITS_FOR_A_DRONE

if TYPE_CHECKING:
    from ..wire import MissionRow

LONG = 120.0
"""Seconds of a flight after which it is said why missions wait."""


class Waits:
    """Since when each mission of a flight waits for a drone, in its time."""

    def __init__(self) -> None:
        self._since: dict[str, float] = {}

    def look(self, missions: Iterable[MissionRow], now: float) -> int:
        """Return how many wait, if one of them has for long; else 0."""
        waiting = [row["name"] for row in missions if row["wait"].startswith(WAITS_FOR_A_DRONE)]
        self._since = {name: self._since.get(name, now) for name in waiting}
        longest = max((now - since for since in self._since.values()), default=0.0)
        return len(waiting) if longest >= LONG else 0

    @property
    def any(self) -> bool:
        """Whether any mission waits for a drone."""
        return bool(self._since)
