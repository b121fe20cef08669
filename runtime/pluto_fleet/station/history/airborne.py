"""How long each drone was in the air, and what its battery gave, by the measurements of a journal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...jobs.flown import DONE, FLEW, LAND


@dataclass(slots=True)
class Work:
    """What one drone has done in one flight."""

    trips: int = 0
    """Trips that it has completed."""
    launched: int = 0
    seconds: float = 0.0
    """In the air, of the flight's time."""
    cycles: float = 0.0
    """Full charges that its battery gave."""
    lost: int = 0
    measured: bool = False
    """Whether its commands were measured: else seconds and cycles are not known."""
    first_level: float | None = None
    last_level: float | None = None
    lowest_level: float | None = None
    """Of its battery, from 0 to 1, as far as it was measured."""


@dataclass(slots=True)
class _Aloft:
    since: float
    level: float
    """At the take-off."""
    until: float
    last: float
    """At the end of the last command."""


@dataclass(slots=True)
class FleetWork:
    """What all drones of one flight have done."""

    drones: dict[str, Work] = field(default_factory=dict)
    _aloft: dict[str, _Aloft] = field(default_factory=dict)
    _away: set[str] = field(default_factory=set)
    """The lost ones."""

    def take(self, event: Mapping[str, Any]) -> None:
        """Take an event of the journal."""
        match event["event"]:
            case "trip.launched":
                self._of(event).launched += 1
            case "trip.completed":
                self._of(event).trips += 1
            case "journal.begun":
                self._away |= {*(event.get("lost") or {})}
            case "drone.brought_back":
                self._away.discard(event["drone"])
            case "drone.lost":
                self._down(event["drone"])
                if event["drone"] not in self._away:
                    self._away.add(event["drone"])
                    self._of(event).lost += 1
            case "drone.free" | "drone.charging":
                self._down(event["drone"])
            case kind if kind == FLEW:
                self._flew(event)

    def end(self) -> None:
        """Take the end of the journal: what is in the air then is counted up to its last command."""
        for drone in [*self._aloft]:
            self._down(drone)

    def _of(self, event: Mapping[str, Any]) -> Work:
        return self.drones.setdefault(event["drone"], Work())

    def _flew(self, event: Mapping[str, Any]) -> None:
        if "seconds" not in event:
            return  # it says where it was, and not what it flew
        drone, work = event["drone"], self._of(event)
        before, after = event["battery"]
        work.measured = True
        work.first_level = before if work.first_level is None else work.first_level
        work.last_level = after
        work.lowest_level = min(after, before, *_known(work.lowest_level))
        aloft = self._aloft.get(drone)
        if aloft is None:
            aloft = _Aloft(event["t"] - event["seconds"], before, event["t"], after)
            self._aloft[drone] = aloft
        aloft.until, aloft.last = event["t"], after
        if event["what"] == LAND and event["ended"] == DONE:
            self._down(drone)

    def _down(self, drone: str) -> None:
        aloft = self._aloft.pop(drone, None)
        if aloft is not None:
            work = self.drones[drone]
            work.seconds += aloft.until - aloft.since
            work.cycles += max(aloft.level - aloft.last, 0.0)


def _known(level: float | None) -> tuple[float, ...]:
    return () if level is None else (level,)
