"""What came of an interrupted flight, as far as the gateway's ledger and the drones can tell.

A flight is interrupted when the app stops or dies, or when the user suspends its mission. What the ledger
cannot tell, the app's own probe may, or only the user can.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any

from ..jobs.reports import Entry, JobState

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..jobs.reports import DroneReport
    from ..journal.standing import Record

Data = dict[str, Any]


class Outcome(Enum):
    """The outcome of an interrupted flight."""

    FLIES_ON = "flies on"  # or has ended, and its report is still available
    NOT_DONE = "again"  # its action was not done: it counts as no attempt
    DONE = "done"  # its action was done, according to the app's own probe
    UNKNOWN = "unknown"


PROBED = {True: Outcome.DONE, False: Outcome.NOT_DONE, None: Outcome.UNKNOWN}
"""The outcome by the answer of the app's probe."""


def outcome_of(entry: Entry | None, repeat: str, begun: bool) -> Outcome:
    """Return the outcome of a flight; `repeat` is that of its action, `begun`: the app's own had begun."""
    repeatable = repeat == "safe"
    if entry is not None and entry.flies:
        return Outcome.FLIES_ON
    if begun:
        return Outcome.NOT_DONE if repeatable else Outcome.UNKNOWN
    if entry is None or entry.state is JobState.BROKEN_OFF:
        return Outcome.NOT_DONE
    if entry.state is JobState.BEGUN:
        return Outcome.NOT_DONE if repeatable else Outcome.UNKNOWN
    return Outcome.FLIES_ON


def in_flight(record: Record) -> Record | None:
    """Return the flight of a mission whose end is not known yet, or None."""
    flight: Record | None = record["flight"]
    ended = flight is None or flight["outcome"] is not None or flight["heard"]
    return None if ended or trip_of(record, flight) is None else flight


def trip_of(record: Record, flight: Record | None) -> Record | None:
    """Return the trip of a mission's flight, or None."""
    for which in ("todo", "done", "gone") if flight is not None else ():
        for trip in record[which]:
            if flight is not None and trip["name"] == flight["trip"]:
                found: Record = trip
                return found
    return None


def id_of(mission: str, flight: Mapping[str, Any]) -> str:
    """Return the id of a flight."""
    again = f"+{flight['relieved']}" if flight.get("relieved") else ""
    return f"{mission}/{flight['trip']}/{flight['round']}/{flight['attempt']}{again}"


def unheard(record: Record) -> str | None:
    """Return the status with which a flight has ended that its mission has not gone on from, or None."""
    flight = record["flight"]
    return None if flight is None or flight["heard"] else flight["outcome"]


def question(trip: Record, drone: str) -> str:
    """Return the question whether an action was done, for a person."""
    return f"was {trip['action']} of trip {trip['name']} done by {drone}? It could not be seen"


def drone_told(report: DroneReport) -> Data:
    """Return what a brain is told of a drone that no mission needs."""
    return {
        "reached": report.reached,
        "landed": report.landed,
        "carrying": report.carrying,
        "problems": list(report.problems),
    }


CANCELLED = "cancelled by hand"

ANSWERS = {"done": Outcome.DONE, "not-done": Outcome.NOT_DONE}
"""What a person's answer says of an action."""
