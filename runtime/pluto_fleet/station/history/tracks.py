"""Where each drone was, and its battery's level, by what a journal has measured: linear in between."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...jobs.flown import DONE, FLEW

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Known:
    """What is known of a drone at one instant; None: that is not."""

    t: float
    at: Point | None
    battery: float | None


class Track:
    """One drone's way through a flight."""

    def __init__(self) -> None:
        self._known: list[Known] = []
        self._times: list[float] = []

    def add(self, known: Known) -> None:
        """Add what was known at some instant, in any order."""
        place = bisect_right(self._times, known.t)
        self._times.insert(place, known.t)
        self._known.insert(place, known)

    def at(self, t: float) -> Known:
        """Return what is known of `t`: nothing of a level before the first and after the last one.

        A place is that of the one before until the next command begins.
        """
        place = bisect_right(self._times, t)
        if place == 0:
            return Known(t, None, None)
        before = self._known[place - 1]
        if place == len(self._known):
            return Known(t, before.at, before.battery if t == before.t else None)
        after = self._known[place]
        part = (t - before.t) / (after.t - before.t)
        at = None
        if before.at is not None and after.at is not None:
            x, y, z = (a + (b - a) * part for a, b in zip(before.at, after.at, strict=True))
            at = x, y, z
        level = None
        if before.battery is not None and after.battery is not None:
            level = before.battery + (after.battery - before.battery) * part
        return Known(t, at, level)


@dataclass(slots=True)
class Tracks:
    """The ways of all drones."""

    drones: dict[str, Track] = field(default_factory=dict)

    def take(self, event: Mapping[str, Any]) -> None:
        """Take an event of the journal."""
        if event["event"] == FLEW and "seconds" in event:
            track = self._of(event)
            before, after = event["battery"]
            track.add(Known(event["t"] - event["seconds"], _point(event["from"]), before))
            ended = event["to"] if event["ended"] == DONE else event.get("at")
            track.add(Known(event["t"], None if ended is None else _point(ended), after))
        elif event["event"].startswith("drone.") and event.get("at") is not None:
            self._of(event).add(Known(event["t"], _point(event["at"]), event.get("battery")))

    def at(self, drone: str, t: float) -> Known:
        """Return what is known of a drone at an instant."""
        track = self.drones.get(drone)
        return Known(t, None, None) if track is None else track.at(t)

    def _of(self, event: Mapping[str, Any]) -> Track:
        return self.drones.setdefault(event["drone"], Track())


def _point(at: Any) -> Point:
    x, y, z = at
    return float(x), float(y), float(z)
