"""What a drone has flown, as plain data: one command of it, and how that went (docs/journal.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.model import Point

Flown = Mapping[str, object]
"""A command that is over, such as a leg, with the seconds that it took."""

FLEW = "drone.flew"
"""The event of a journal that holds one."""

TAKE_OFF, LEG, LAND, ACTION = "take_off", "leg", "land", "action"
"""What the command was: the fact `what`."""

BESIDE = "beside"
"""Another `what`, which is no command: it has arrived beside its target, and acts there."""

ACTS_BESIDE = "trip.beside"
"""The event of a trace that says so."""

DONE, BROKEN_OFF, FAILED = "done", "broken off", "failed"
"""How it ended: the fact `ended`."""


def is_beside(drone: str, flight: str, target: Point, at: Point) -> Flown:
    """Return that the action of a flight is done beside its target."""
    place = [round(along, 3) for along in at]
    return {
        "drone": drone,
        "what": BESIDE,
        "flight": flight,
        "target": list(target),
        "at": place,
    }
