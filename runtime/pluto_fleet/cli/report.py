"""What a flown plan is to a person: two tables and a last line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from plutoc_runtime.alone.simulate import trips_data
from plutoc_runtime.domain.fields import FieldType
from plutoc_runtime.domain.status import Status
from plutoc_runtime.domain.text import counted, duration, number, percent, printable

if TYPE_CHECKING:
    from plutoc_runtime.alone.simulate import Outcome
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission


class MissionRow(NamedTuple):
    """What the report says of a mission."""

    name: str
    status: Status
    done: int
    """Trips of this round."""
    todo: int
    round: int
    """From 0."""
    attempts: int
    reason: str


def report(app: App, outcome: Outcome, apart: float) -> Iterator[str]:
    """Yield the lines of the report; the last one says in which world it was flown."""
    yield from mission_table(app, map(row_of, outcome.missions))
    yield ""
    yield from drone_table(outcome.drones, outcome.flown)
    yield ""
    if outcome.given_up:
        yield f"given up: {printable(outcome.given_up)}"
    yield last_line(outcome)
    yield (
        f"flown with traffic: drones keep {number(apart)} m apart from each other"
        if apart
        else "flown without traffic: with apart = 0 drones pass through each other"
    )


def row_of(mission: Mission[Any]) -> MissionRow:
    """Return what the report says of a mission that is at hand."""
    done, todo = len(mission.completed_trips), len(mission.trips)
    return MissionRow(
        mission.name, mission.status, done, todo, mission.round, mission.attempts, mission.reason
    )


def mission_table(app: App, missions: Iterable[MissionRow]) -> Iterator[str]:
    """Yield the lines of the first table."""
    rounds = any(field.type is FieldType.ROUNDS for field in app.fields)
    yield from table(
        ("mission", "status", "trips", *(["rounds"] if rounds else []), "attempts", "reason"),
        [
            (
                mission.name,
                mission.status.value,
                f"{mission.done}/{mission.done + mission.todo}",
                *([str(mission.round + 1)] if rounds else []),
                str(mission.attempts),
                mission.reason,
            )
            for mission in missions
        ],
        right=(2, 3, 4) if rounds else (2, 3),
    )


def drone_table(drones: Sequence[Drone], flown: Mapping[str, float]) -> Iterator[str]:
    """Yield the lines of the second table; not everywhere is it known how far each has flown."""
    yield from table(
        ("drone", "category", "trips", *(["flown"] if flown else []), "battery", "status"),
        [
            (
                drone.id,
                drone.category.name,
                str(drone.trips),
                *([f"{number(round(flown[drone.id], 1))} m"] if flown else []),
                percent(drone.battery_level),
                drone.status.value,
            )
            for drone in drones
        ],
        right=(2, 3, 4) if flown else (2, 3),
    )


def last_line(outcome: Outcome) -> str:
    """Return the whole outcome in one line."""
    trips = trips_data(outcome)
    statuses = [mission.status for mission in outcome.missions]
    return in_one_line(
        statuses, outcome.duration, trips["attempts"], trips["failed"], outcome.crashed
    )


def in_one_line(
    statuses: Sequence[Status], seconds: float, flights: int, failed: int, crashed: int = 0
) -> str:
    """Return how missions have ended, after how long and how many flights."""
    parts = [f"{statuses.count(Status.COMPLETED)} of {counted(len(statuses), 'mission')} completed"]
    rest = len(statuses) - statuses.count(Status.COMPLETED)
    for what, of_these in _OTHER_ENDS.items():
        count = sum(status in of_these for status in statuses)
        rest -= count
        if count:
            parts.append(f"{count} {what if count > 1 else what.replace('wait ', 'waits ')}")
    if rest:
        parts.append(f"{rest} not finished")
    bad = f", {failed} failed" if failed else ""
    bad += f", {counted(crashed, 'drone')} crashed" if crashed else ""
    return f"{', '.join(parts)} in {duration(seconds)} ({counted(flights, 'flight')}{bad})"


_OTHER_ENDS = {
    "failed": (Status.FAILED,),
    "cancelled": (Status.CANCELLED,),
    "wait for a person": (Status.UNCERTAIN, Status.HELD),
}


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
