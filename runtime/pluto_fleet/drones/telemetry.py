"""What one drone tells of itself: where and how it is, and what happens to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

LINK_LOST = "link lost"
"""It does not answer any more."""
CRASHED = "crashed"
"""It fell, hit something or lies on its back."""
LOCKED = "locked"
"""It will not fly until somebody switches it off and on."""
BATTERY_LOW = "battery low"
"""It must come down now, where it is."""
POSITION_LOST = "position lost"
"""It does not know any more where it is: it must come down now, wherever that is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneTelemetry:
    """One drone at one moment; a new value each time that it tells something."""

    time: float
    """When it told this, by `time.monotonic()`; minus infinity: it has not told anything yet.

    This is how silence is seen: it must not be the time at which somebody asks.
    """
    position: Point
    """Metres, in the map's frame: x and y along the map, z up from its ground."""
    yaw: float
    """Where its nose points: radians, 0 along x, counter-clockwise."""
    voltage: float
    """Volts, as they are now, or 0 where it cannot tell."""
    battery_level: float
    """What is left of the battery, from 0 to 1, corrected for its load; 1 where it cannot tell."""
    flying: bool
    """Whether its motors carry it: from when it leaves the ground until they are off."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEvent:
    """Something that happened to a drone, which nobody has asked for."""

    kind: str
    """`LINK_LOST`, `CRASHED`, `LOCKED`, `BATTERY_LOW` or `POSITION_LOST`; others are only put into the log."""
    reason: str
    """A sentence for a person, without the drone's name: "it lies on its back"."""
