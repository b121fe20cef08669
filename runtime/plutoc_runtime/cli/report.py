"""What a flown plan is to a person: two tables and a last line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ..fields import FieldType
from ..status import Status
from ..words import counted, duration, number, percent, printable
from .as_json import trips_data

if TYPE_CHECKING:
    from ..app import App
    from ..model import Mission
    from ..session import Outcome


def report(app: App, outcome: Outcome) -> Iterator[str]:
    """Yield the lines of the report."""
    rounds = any(field.type is FieldType.ROUNDS for field in app.fields)
    yield from table(
        ("mission", "status", "trips", *(["rounds"] if rounds else []), "attempts", "reason"),
        [
            (
                mission.name,
                mission.status.value,
                done_of_all(mission),
                *([str(mission.round + 1)] if rounds else []),
                str(mission.attempts),
                mission.reason,
            )
            for mission in outcome.missions
        ],
        right=(2, 3, 4) if rounds else (2, 3),
    )
    yield ""
    yield from table(
        ("drone", "category", "trips", "flown", "battery", "status"),
        [
            (
                drone.id,
                drone.category.name,
                str(drone.trips),
                f"{number(round(outcome.flown[drone.id], 1))} m",
                percent(drone.battery_level),
                drone.status.value,
            )
            for drone in outcome.drones
        ],
        right=(2, 3, 4),
    )
    yield ""
    yield last_line(outcome)


def done_of_all(mission: Mission[Any]) -> str:
    """Return how many of this round's trips are done: 2/3."""
    done = len(mission.completed_trips)
    return f"{done}/{done + len(mission.trips)}"


def last_line(outcome: Outcome) -> str:
    """Return the whole outcome in one line."""
    missions = outcome.missions
    completed = sum(mission.status is Status.COMPLETED for mission in missions)
    failed = sum(mission.status is Status.FAILED for mission in missions)
    rest = len(missions) - completed - failed
    parts = [f"{completed} of {counted(len(missions), 'mission')} completed"]
    if failed:
        parts.append(f"{failed} failed")
    if rest:
        parts.append(f"{rest} not finished")
    trips = trips_data(outcome)
    flights = counted(trips["attempts"], "flight")
    bad = f", {trips['failed']} failed" if trips["failed"] else ""
    return f"{', '.join(parts)} in {duration(outcome.duration)} ({flights}{bad})"


def table(
    header: Sequence[str], rows: Sequence[Sequence[str]], *, right: Sequence[int]
) -> Iterator[str]:
    """Yield the lines of a table; the columns named by `right` hold numbers."""
    cells = [[printable(cell) for cell in row] for row in (header, *rows)]
    widths = [max(len(row[column]) for row in cells) for column in range(len(header))]
    for row in cells:
        aligned = [
            cell.rjust(width) if column in right else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        yield "  ".join(aligned).rstrip()
