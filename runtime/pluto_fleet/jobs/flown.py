"""What a drone has flown, as plain data: one command of it, and how that went (docs/journal.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..shared.domain.model import Point
    from .job import Job

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


def is_beside(job: Job, target: Point, at: Point) -> Flown:
    """Return that a job's action is done beside its target."""
    place = [round(along, 3) for along in at]
    return {
        "drone": job.drone,
        "what": BESIDE,
        "flight": job.id,
        "target": list(target),
        "at": place,
    }
