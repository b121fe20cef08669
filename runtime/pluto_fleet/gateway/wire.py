"""The protocol between brain and gateway: one JSON object per line."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isinf
from typing import TYPE_CHECKING

from ..jobs.reports import DroneReport, Entry, FleetReport, JobState
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.hooks.plain_data import (
    item_data,
    item_of,
    point_of,
    value_data,
    value_of,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..jobs.job import Job
    from ..jobs.telemetry import Telemetry
    from ..process.ipc import Message
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item, Point

STALE_AFTER = 2.0
"""Seconds without a message after which a drone's position is stale."""
MAX_COMMAND = 256 * 1024
"""Bytes of a line that the gateway reads."""
MAX_REPORT = 256 * 1024 * 1024
"""Bytes of a line that the brain reads: a fleet's report has all jobs of a large plan."""


@dataclass(slots=True, kw_only=True)
class ToldJob:
    """A job received over the wire."""

    id: str
    drone: str
    stops: tuple[Point, ...]
    action: str | None
    parameters: Mapping[str, Plain]
    item: Item | None
    seconds: float
    beside: bool
    on_begin: Callable[[str], object] = field(repr=False)

    def begins(self) -> None:
        """Called right before the action is done."""
        self.on_begin(self.id)


def job_data(job: Job) -> dict[str, object]:
    """Return a job as plain data."""
    return {
        "id": job.id,
        "drone": job.drone,
        "stops": job.stops,
        "action": job.action,
        "parameters": dict(job.parameters),
        "item": item_data(job.item),
        "seconds": job.seconds,
        "beside": job.beside,
    }


def job_of(data: Message, on_begin: Callable[[str], object]) -> ToldJob:
    """Return a job from plain data; raise `KeyError`, `TypeError` or `ValueError` if it is invalid."""
    return ToldJob(
        id=str(data["id"]),
        drone=str(data["drone"]),
        stops=tuple(point_of([float(value) for value in stop]) for stop in data["stops"]),
        action=None if data["action"] is None else str(data["action"]),
        parameters=dict(data["parameters"]),
        item=item_of(data["item"]),
        seconds=float(data["seconds"]),
        beside=bool(data["beside"]),
        on_begin=on_begin,
    )


def result_data(result: object) -> dict[str, object]:
    """Return what was reported as plain data."""
    if isinstance(result, FlightFailed):
        return {"failure": result.failure.name, "reason": str(result)}
    return {"value": value_data(result)}


def result_of(data: Message) -> object:
    """Return what was reported."""
    if "failure" in data:
        return FlightFailed(Failure[data["failure"]], data["reason"])
    return value_of(data["value"])


def seen(telemetry: Telemetry, moves: bool) -> tuple[object, ...]:
    """Return a drone's telemetry in a compact form, and whether it carries out a command.

    The last element is since when it is silent, in seconds since 1970; None if it is not, 0 if it has
    never sent anything.
    """
    silence, since = telemetry.silence, None
    if silence > STALE_AFTER:
        since = 0.0 if isinf(silence) else round(time.time() - silence)
    return *telemetry.location, telemetry.battery_level, telemetry.landed, moves, since


def entry_data(entry: Entry) -> dict[str, object]:
    """Return what is known of a job as plain data, but for whether its drone is at it now."""
    return {
        "id": entry.id,
        "drone": entry.drone,
        "state": entry.state.value,
        "boot": entry.boot,
        "value": value_data(entry.value),
        "failure": entry.failure,
        "reason": entry.reason,
    }


def drone_report_data(report: DroneReport) -> dict[str, object]:
    """Return a drone's answer as plain data."""
    done = report.done
    return {
        "drone": report.drone,
        "reached": report.reached,
        "location": report.location,
        "landed": report.landed,
        "battery_level": report.battery_level,
        "boot": report.boot,
        "carrying": report.carrying,
        "done": None if done is None else {id: value_data(value) for id, value in done.items()},
        "problems": report.problems,
    }


def drone_report_of(data: Message) -> DroneReport:
    """Return a drone's answer."""
    done = data["done"]
    values = None if done is None else {id: value_of(value) for id, value in done.items()}
    known = {"location": point_of(data["location"]), "problems": tuple(data["problems"])}
    return DroneReport(**{**data, **known, "done": values})


def fleet_report_data(report: FleetReport) -> dict[str, object]:
    """Return a report of the fleet as plain data."""
    return {
        "drones": [drone_report_data(one) for one in report.drones.values()],
        "jobs": [{**entry_data(entry), "flies": entry.flies} for entry in report.jobs.values()],
    }


def fleet_report_of(data: Message) -> FleetReport:
    """Return a report of the fleet."""
    reports = map(drone_report_of, data["drones"])
    entries = [
        Entry(**{**job, "state": JobState(job["state"]), "value": value_of(job["value"])})
        for job in data["jobs"]
    ]
    return FleetReport(
        drones={one.drone: one for one in reports},
        jobs={entry.id: entry for entry in entries},
    )
