"""Why missions wait for a drone, in total: for how long, and what keeps the drones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import ceil
from typing import TYPE_CHECKING

from ...shared.domain.text import counted, duration, percent
from ..rows import waits_for_a_drone
from ..words import words
from .causes import Cause

if TYPE_CHECKING:
    from ..wire import DroneRow, MissionRow, Scalar

    Facts = dict[str, Scalar | list[str]]

LONG = 120.0
"""Seconds of a flight after which it is said why missions wait."""
_NAMED = 3
"""The most drones that a sentence names."""
_SHORT = 90.0
"""Seconds: what is expected later is told to the minute."""


class Waits:
    """Since when each mission of a flight waits for a drone, in its time."""

    def __init__(self) -> None:
        self._since: dict[str, float] = {}

    def look(self, missions: Iterable[MissionRow], now: float) -> int:
        """Return how many wait, if one of them has for long; else 0."""
        waiting = [row["name"] for row in missions if waits_for_a_drone(row)]
        self._since = {name: self._since.get(name, now) for name in waiting}
        longest = max((now - since for since in self._since.values()), default=0.0)
        return len(waiting) if longest >= LONG else 0

    @property
    def any(self) -> bool:
        """Whether any mission waits for a drone."""
        return bool(self._since)


def of_waiting(waiting: int, drones: Sequence[DroneRow], takes: float | None) -> Cause | None:
    """Return why so many missions have waited for long; None: as all drones fly.

    `takes` is the level that the low drones need.
    """
    low, soonest = _low(drones), None
    count = {
        "charging": _count(drones, "CHARGING"),
        "recovering": _count(drones, "RECOVERING"),
        "lost": _count(drones, "LOST"),
        "offline": _count(drones, "OFFLINE"),
        "retired": sum(row["retired"] and row["status"] != "LOST" for row in drones),
    }
    if not low and not any(count.values()):
        return None
    count["flying"] = _count(drones, "BUSY", "RETURNING")
    facts: Facts = {"missions": waiting, "low": len(low), **count}
    parts = []
    if low:
        are = "drone is" if len(low) == 1 else "drones are"
        if takes is not None and takes <= 1:
            facts["takes"] = ceil(takes * 100) / 100
            parts.append(f"{len(low)} {are} below {percent(ceil(takes * 100) / 100)}")
        else:
            parts.append(f"{len(low)} {are} too low")
        soonest = _first_ready(low)
    if soonest is not None:
        facts["ready_in"] = soonest
        parts.append(f"the first is ready in about {duration(soonest)}")
    parts += [f"{number} {_SAID.get(what, what)}" for what, number in count.items() if number]
    wait = "waits" if waiting == 1 else "wait"
    text = f"{counted(waiting, 'mission')} {wait}: {', '.join(parts)}"
    return Cause(kind="waiting", about="", said=words("alert.waiting", text, **facts))


_SAID = {"recovering": "being recovered", "offline": "not asked yet"}


def of_batteries(drones: Sequence[DroneRow], wait: bool) -> Iterator[Cause]:
    """Yield that drones are too low for what waits, while anything does."""
    ids = [row["id"] for row in _low(drones)]
    if not ids or not wait:
        return
    soonest, one = _first_ready(_low(drones)), len(ids) == 1
    facts: Facts = {"drones": ids}
    named = ", ".join(ids[:_NAMED])
    named += f" and {len(ids) - _NAMED} more" if len(ids) > _NAMED else ""
    text = f"the battery of {named} is" if one else f"the batteries of {named} are"
    text += " too low for what waits; "
    if soonest is not None:
        facts["ready_in"] = soonest
        text += f"{'it' if one else 'the first'} is ready in about {duration(soonest)}"
    elif one:
        text += "it does not charge: look whether it stands in its dock"
    else:
        text += "they do not charge: look whether they stand in their docks"
    said = words("alert.battery-stays" if soonest is None else "alert.battery", text, **facts)
    yield Cause(kind="battery", about="", said=said, drone=ids[0] if one else None)


def _low(drones: Iterable[DroneRow]) -> list[DroneRow]:
    return [row for row in drones if row["status"] == "LOW"]


def _count(drones: Iterable[DroneRow], *statuses: str) -> int:
    return sum(row["status"] in statuses for row in drones)


def _first_ready(drones: Iterable[DroneRow]) -> int | None:
    """Return in about how many seconds the first of these drones is ready; None: none charges."""
    times = (row.get("ready_in") for row in drones)
    soonest = min((seconds for seconds in times if seconds is not None), default=None)
    if soonest is None:
        return None
    return max(1, round(soonest)) if soonest < _SHORT else 60 * round(soonest / 60)
