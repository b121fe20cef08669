"""When a drone's battery is high enough: one arithmetic for rows, alerts and forecasts."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from ..shared.domain.motion import charged, charging
from ..shared.fleet.reach import LOW
from ..shared.fleet.reach import docked as stands_in_its_dock

if TYPE_CHECKING:
    from ..shared.domain.model import Category, Point


def to_fly(kind: Category) -> float:
    """Return the level from which a drone has more in its battery than its way home takes."""
    return min(1.0, kind.reserve + LOW)


def ready_in(kind: Category, level: float, wanted: float, *, docked: bool) -> float | None:
    """Return the seconds until a battery has the level that is wanted; None: it never will.

    A drone charges only in its dock, if its fleet does at all. Levels are from 0 to 1; 0 seconds: it has it already.
    """
    if level >= wanted:
        return 0.0
    if not docked or wanted > 1.0 or kind.charge_time == inf:
        return None
    return charging(level, wanted, kind.charge_time, kind.motion.taper)


def level_after(kind: Category, level: float, seconds: float, at: Point, home: Point) -> float:
    """Return the level of a battery so many seconds later, of a drone that stands on the ground."""
    if seconds <= 0.0 or kind.charge_time == inf or not stands_in_its_dock(at, home):
        return level
    return charged(level, seconds, kind.charge_time, kind.motion.taper)
