"""The reports of drones, and the gateway's records of jobs; as plain data, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import Enum
from typing import TYPE_CHECKING, Any

from ..shared.domain.errors import Failure, FlightFailed
from ..shared.hooks.plain_data import point_of, value_data, value_of

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


@dataclass(slots=True, kw_only=True)
class Entry:
    """What is known of one job: an order to fly, by the id of its flight."""

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


def motors_cut(drone: str) -> FlightFailed:
    """Return the failure of a drone's command when its motors were cut."""
    return FlightFailed(Failure.CRASH, f"{drone}'s motors were cut")


# As plain data


def result_data(result: object) -> dict[str, object]:
    """Return what was reported of a job."""
    if isinstance(result, FlightFailed):
        return {"failure": result.failure.name, "reason": str(result)}
    return {"value": value_data(result)}


def entry_data(entry: Entry) -> dict[str, object]:
    """Return what is known of a job, but for whether its drone is at it now."""
    data = {one.name: getattr(entry, one.name) for one in fields(entry) if one.name != "flies"}
    return {**data, "state": entry.state.value, "value": value_data(entry.value)}


def entry_of(data: Mapping[str, Any]) -> Entry:
    """Return what is known of a job."""
    return Entry(**{**data, "state": JobState(data["state"]), "value": value_of(data["value"])})


def drone_report_data(report: DroneReport) -> dict[str, object]:
    """Return a drone's answer."""
    data = {one.name: getattr(report, one.name) for one in fields(report)}
    done = report.done
    return {
        **data,
        "done": None if done is None else {id: value_data(value) for id, value in done.items()},
    }


def drone_report_of(data: Mapping[str, Any]) -> DroneReport:
    """Return a drone's answer."""
    done = data["done"]
    values = None if done is None else {id: value_of(value) for id, value in done.items()}
    known = {"location": point_of(data["location"]), "problems": tuple(data["problems"])}
    return DroneReport(**{**data, **known, "done": values})


def fleet_report_data(report: FleetReport) -> dict[str, object]:
    """Return a report of the fleet."""
    return {
        "drones": [drone_report_data(one) for one in report.drones.values()],
        "jobs": [{**entry_data(entry), "flies": entry.flies} for entry in report.jobs.values()],
    }


def fleet_report_of(data: Mapping[str, Any]) -> FleetReport:
    """Return a report of the fleet."""
    reports = map(drone_report_of, data["drones"])
    entries = map(entry_of, data["jobs"])
    return FleetReport(
        drones={one.drone: one for one in reports},
        jobs={entry.id: entry for entry in entries},
    )
