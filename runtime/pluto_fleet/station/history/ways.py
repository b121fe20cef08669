"""Where what moves beside the drones was in a flight, by its journal."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from ...journal.facts import TRACKED

if TYPE_CHECKING:
    from ..wire import Point, TrackWay
    from .reading import Event

MOST = 50_000
"""The most places in a replay, the last ones; the journal has all."""


class Ways:
    """The ways of all objects of one flight."""

    def __init__(self, most: int | None = MOST) -> None:
        """`most`: of so many places, the last ones; None: of all."""
        self._places: deque[tuple[str, Point]] = deque(maxlen=most)
        """In the order of time, each with the id of whose it is."""
        self._kinds: dict[str, str] = {}

    def take(self, event: Event) -> None:
        """Take an event of the journal."""
        if event["event"] != TRACKED:
            return
        for id, told in event["tracks"].items():
            seen = round(event["t"] - told.get("ago", 0.0), 3)
            self._places.append((id, [seen, *told["at"]]))
            if "kind" in told:
                self._kinds[id] = told["kind"]

    def all(self) -> list[TrackWay]:
        """Return them, those that came first first."""
        ways: dict[str, list[Point]] = {}
        for id, place in self._places:
            ways.setdefault(id, []).append(place)
        return [{"id": id, "kind": self._kinds.get(id, ""), "way": way} for id, way in ways.items()]
