"""Why a mission waits for a drone, and which free drone is ready, in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import ceil, floor
from typing import TYPE_CHECKING, Any

from ..shared.domain.status import DroneStatus
from ..shared.domain.text import percent

if TYPE_CHECKING:
    from ..shared.brain import Brain

LOOK_EVERY = 3.0
"""Seconds after which a reason is updated."""
MISSIONS_A_LOOK = 10
"""The most missions whose reasons are updated in one sample: there may be hundreds."""

_DOES = {
    "LOST": "lost",
    "BUSY": "flying",
    "RETURNING": "coming home",
    "CHARGING": "charging",
    "RECOVERING": "recovering",
    "OFFLINE": "not asked yet",
}


class WaitReasons:
    """The reasons of waiting missions, cached between updates."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._looked = -LOOK_EVERY
        self._low: list[str] = []
        self._known: dict[tuple[str, str], tuple[float, str]] = {}
        """By mission and trip: when it was asked, and the reason."""
        self._left = MISSIONS_A_LOOK

    def look(self, brain: Brain) -> None:
        """Begin a sample of all missions and drones."""
        now, self._left = self._clock(), MISSIONS_A_LOOK
        if now - self._looked >= LOOK_EVERY:
            self._looked, self._low = now, brain.waiting(())["low"]
            self._known = {
                which: (asked, said)
                for which, (asked, said) in self._known.items()
                if now - asked < 2 * LOOK_EVERY
            }

    def why(self, brain: Brain, mission: str, trip: str) -> str:
        """Return why no drone flies a mission's next trip yet; empty: not known yet."""
        now = self._clock()
        asked, said = self._known.get((mission, trip), (-LOOK_EVERY, ""))
        if self._left and now - asked >= LOOK_EVERY:
            found = brain.waiting([mission])["missions"].get(mission)
            if found is not None:
                self._left -= 1
                said = why_no_drone(found)
                self._known[mission, trip] = now, said
        return said

    def why_low(self, id: str, drone: Mapping[str, Any]) -> str:
        """Return why a free drone is not ready; empty: it is."""
        if drone["status"] != DroneStatus.FREE.value:
            return ""
        if id in self._low:
            return "its battery is too low for every trip that waits"
        return "its battery has little more than its reserve" if drone["low"] else ""


def why_no_drone(found: Mapping[str, Any]) -> str:
    """Return in words what keeps each drone of the fleet from flying a waiting trip."""
    parts = [f"{number} {_DOES[status]}" for status, number in found["status"].items()]
    if found["retired"]:
        parts.append(f"{found['retired']} retired")
    if low := found["low"]:
        nearest = min(low, key=lambda one: (one["needs"] - one["has"], one["has"], one["needs"]))
        enough = f"it takes {percent(ceil(nearest['needs'] * 100) / 100)}"
        has = f"the nearest has {percent(floor(nearest['has'] * 100) / 100)}"
        needs = f": {enough}, {has}" if nearest["needs"] <= 1 else ""
        parts.insert(0, f"{len(low)} free, but too low{needs}")
    if able := found["free"]:
        parts.insert(0, f"{able} free" + ("" if found["room"] else ", but no more may fly at once"))
    parts += [f"{number} cannot: {reason}" for reason, number in found["cannot"].items()]
    return "; ".join(parts)
