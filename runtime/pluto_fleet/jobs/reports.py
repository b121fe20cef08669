"""What drones report when they are asked, and what the gateway remembers of jobs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneReport:
    """What one drone reports when it is asked."""

    drone: str
    reached: bool
    """Whether it answered at all; if not, the rest is what was known of it last."""
    location: Point
    landed: bool
    battery_level: float
    boot: int
    """Another number than before: it was switched off in between, and has forgotten."""
    carrying: str | None
    """The name of the item aboard."""
    done: Mapping[str, object] | None
    """The jobs whose action it did since it was switched on, with what that gave.

    None: this kind of drone cannot tell.
    """
    problems: tuple[str, ...] = ()
    """Why it may not fly now, a sentence each."""


class JobState(Enum):
    """How far a job has come, as the gateway knows it."""

    FLYING = "flying"  # on its way: its action has not begun
    BEGUN = "begun"  # its action may have been done, or not
    DONE = "done"
    FAILED = "failed"
    BROKEN_OFF = "broken off"  # before its action began


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """What the ledger has of one job."""

    id: str
    drone: str
    state: JobState
    boot: int
    """The drone's, when the job was given."""
    flies: bool = False
    """Whether its drone is at it now: it will be reported."""
    value: object = None
    """What its action gave, once it is DONE."""
    failure: str = ""
    """The name of the `Failure`, once it has FAILED."""
    reason: str = ""


def reported_result(job: Entry) -> object:
    """Return what was reported of a job that is over."""
    if job.state is JobState.FAILED:
        return FlightFailed(Failure[job.failure], job.reason)
    return job.value


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetReport:
    """The whole fleet and the whole ledger, at one moment."""

    drones: Mapping[str, DroneReport]
    jobs: Mapping[str, Entry]
    """By the jobs' ids; what is not here never arrived."""


class Down(Enum):
    """How all drones are brought down."""

    HOME = "rtl"
    LAND = "land"
