"""The reports of drones, and the gateway's records of jobs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from ..shared.domain.errors import Failure, FlightFailed

if TYPE_CHECKING:
    from ..shared.domain.model import Point


SILENCE = 3.0
"""Seconds for which a drone in the air may tell nothing before its link counts as lost, if no fleet file says so."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneReport:
    """The report of one drone."""

    drone: str
    reached: bool
    """Whether it answered; if not, the rest is its last known state."""
    location: Point
    landed: bool
    battery_level: float
    boot: int
    """Identifies its power-on: if it differs from before, the drone was restarted and has forgotten."""
    carrying: str | None
    """The name of the item aboard."""
    done: Mapping[str, object] | None
    """The jobs whose action it did since it was switched on, with their results.

    None: this kind of drone cannot tell.
    """
    problems: tuple[str, ...] = ()
    """Why it may not fly now, a sentence for each reason."""


class JobState(Enum):
    """The state of a job in the gateway."""

    FLYING = "flying"  # on its way: its action has not begun
    BEGUN = "begun"  # its action may have been done, or not
    DONE = "done"
    FAILED = "failed"
    BROKEN_OFF = "broken off"  # before its action began


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """The ledger's entry of one job."""

    id: str
    drone: str
    state: JobState
    boot: int
    """The drone's, when the job was given."""
    flies: bool = False
    """Whether its drone works on it now, so that a report will come."""
    value: object = None
    """The result of its action, once it is DONE."""
    failure: str = ""
    """The name of the `Failure`, once it has FAILED."""
    reason: str = ""


def reported_result(job: Entry) -> object:
    """Return what was reported for a finished job."""
    if job.state is JobState.FAILED:
        return FlightFailed(Failure[job.failure], job.reason)
    return job.value


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetReport:
    """A consistent snapshot of the fleet and the ledger."""

    drones: Mapping[str, DroneReport]
    jobs: Mapping[str, Entry]
    """By the jobs' ids; a job that is missing has never arrived."""


class Down(Enum):
    """How all drones are brought down."""

    HOME = "rtl"
    LAND = "land"
