"""The outcome of a flight: two tables, a last line, and the exit code."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ..flight.mission_status import ANSWERS, aside, count_flights, in_order, waiting
from ..jobs.flown import ACTS_BESIDE
from ..journal.facts import DRAINED
from ..process.text import in_shell
from ..shared.alone.simulate import outcome_data, trips_data
from ..shared.domain.fields import FieldType
from ..shared.domain.status import Status
from ..shared.domain.text import (
    counted,
    duration,
    number,
    percent,
    printable,
)
from .reactions import TOLD_BY, reactions_of
from .sentences import sentence_of
from .terminal import table

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..flight.outcome import SimulationResult
    from ..journal.standing import Record, Standing
    from ..shared.domain.model import Drone, Mission
    from ..shared.domain.trace import Event


class MissionRow(NamedTuple):
    """A mission's row of the report."""

    name: str
    status: Status
    done: int
    """Trips of this round."""
    todo: int
    round: int
    """From 0."""
    attempts: int
    reason: str
    late: bool = False
    """Whether its deadline has passed before its end."""


def report(app: App, outcome: SimulationResult, fleet: FleetFile) -> Iterator[str]:
    """Yield the lines of the report; the last one says in which world it was flown."""
    yield from mission_table(app, map(row_of, outcome.missions))
    yield ""
    yield from drone_table(outcome.drones, outcome.flown)
    yield ""
    yield from _came_of(outcome.events)
    if outcome.given_up:
        yield f"given up: {printable(outcome.given_up)}"
    yield from broken_reserves(outcome.events)
    yield last_line(outcome)
    traffic = (
        f"flown with traffic: drones keep {number(fleet.apart)} m apart from each other"
        if fleet.apart
        else "flown without traffic: with apart = 0 drones pass through each other"
    )
    charged = "at home they are charged" if fleet.charges_at_home else "nothing charges them"
    yield f"{traffic}; {charged}"


def row_of(mission: Mission[Any]) -> MissionRow:
    """Return the row of a mission."""
    done, todo = len(mission.completed_trips), len(mission.trips)
    return MissionRow(
        mission.name,
        mission.status,
        done,
        todo,
        mission.round,
        mission.attempts,
        mission.reason,
        mission.late,
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
                "; ".join(filter(None, ("late" * mission.late, mission.reason))),
            )
            for mission in missions
        ],
        right=(2, 3, 4) if rounds else (2, 3),
    )


def drone_table(drones: Sequence[Drone], flown: Mapping[str, float]) -> Iterator[str]:
    """Yield the lines of the second table; the distances flown may be unknown."""
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


def simulation_data(name: str, seed: int, outcome: SimulationResult) -> dict[str, object]:
    """Return the object that `simulate --json` prints."""
    beside = [
        {key: value for key, value in event.items() if key != "event"}
        for event in outcome.events
        if event["event"] == ACTS_BESIDE
    ]
    reactions = reactions_of(outcome.events).data()
    return {
        **outcome_data(name, seed, outcome),
        **({"beside": beside} if beside else {}),
        **reactions,
    }


def _came_of(trace: Iterable[Event]) -> Iterator[str]:
    """Yield what came of the app's events, if there were any."""
    if lines := [*reactions_of(trace).lines()]:
        yield from lines
        yield ""


def broken_reserves(events: Iterable[Event]) -> Iterator[str]:
    """Yield a line for each time that a drone came home with less than its reserve."""
    for event in events:
        if event["event"] == DRAINED:
            yield printable(sentence_of(event) or "")


def last_line(outcome: SimulationResult) -> str:
    """Return the whole outcome in one line."""
    trips = trips_data(outcome)
    statuses = [mission.status for mission in outcome.missions]
    late = sum(mission.late for mission in outcome.missions)
    return in_one_line(
        statuses, outcome.duration, trips["attempts"], trips["failed"], outcome.crashed, late
    )


def in_one_line(
    statuses: Sequence[Status],
    seconds: float,
    flights: int,
    failed: int,
    crashed: int = 0,
    late: int = 0,
) -> str:
    """Return a summary of the missions' statuses, the duration and the flights."""
    parts = [f"{statuses.count(Status.COMPLETED)} of {counted(len(statuses), 'mission')} completed"]
    rest = len(statuses) - statuses.count(Status.COMPLETED)
    for what, of_these in _OTHER_ENDS.items():
        count = sum(status in of_these for status in statuses)
        rest -= count
        if count:
            parts.append(f"{count} {what if count > 1 else what.replace('wait ', 'waits ')}")
    if rest:
        parts.append(f"{rest} not finished")
    if late:
        parts.append(f"{late} late")
    bad = f", {failed} failed" if failed else ""
    bad += f", {counted(crashed, 'drone')} crashed" if crashed else ""
    return f"{', '.join(parts)} in {duration(seconds)} ({counted(flights, 'flight')}{bad})"


_OTHER_ENDS = {
    "failed": (Status.FAILED,),
    "cancelled": (Status.CANCELLED,),
    "wait for a person": (Status.UNCERTAIN, Status.HELD),
}


_NEEDS_A_PERSON = (Status.UNCERTAIN, Status.HELD)
_BAD = (Status.FAILED, Status.CANCELLED)


def exit_code(outcome: SimulationResult) -> int:
    """Return 0, 1 if a mission failed, a creator had a fault or it was given up, or 4 if one waits for a person.

    A mission that `--until` cut short has not failed.
    """
    code = code_of([mission.status for mission in outcome.missions], outcome.events)
    return 1 if outcome.given_up and not code else code


def code_of(statuses: Sequence[Status], events: Iterable[Event]) -> int:
    """Return the exit code for missions with these statuses, among these events."""
    if any(status in _NEEDS_A_PERSON for status in statuses):
        return 4
    failed = any(status in _BAD for status in statuses)
    return 1 if failed or any(event.get("fault") for event in events) else 0


_HARMLESS = re.compile(r"[\w ,.:;/()+-]+")
"""Names that a shell takes literally in double quotes."""


def report_of(
    app: App, journal: Path, records: Standing, drones: Sequence[Drone] = ()
) -> tuple[int, list[str]]:
    """Return the exit code of a flight that has a journal, and the lines of its report."""
    rows = [_recorded_row(name, record) for name, record in in_order(records)]
    statuses = [row.status for row in rows]
    flights, failed, ended, told = count_flights(journal, {DRAINED, *TOLD_BY})
    lines = [*mission_table(app, rows), ""]
    if drones:
        lines += [*drone_table(drones, {}), ""]
    late = sum(row.late for row in rows)
    lines += [*_came_of(told), *broken_reserves(told)]
    lines.append(in_one_line(statuses, ended or records.time, flights, failed, late=late))
    return code_of(statuses, told), lines


def waiting_lines(app: App, journal: Path, records: Standing) -> Iterator[str]:
    """Yield the open questions, and the commands that answer them."""
    for name, what, question in waiting(records):
        yield f"{printable(name)}: {printable(question)}"
        for answer in ANSWERS[what]:
            yield f"  {app.name} decide {in_shell(journal)} {_typed(name)} {answer}"


def _typed(name: str) -> str:
    """Quote a mission's name, which is untrusted, for a shell."""
    word = f'"{name}"' if _HARMLESS.fullmatch(name) else in_shell(name)
    return f"-- {word}" if name.startswith("-") else word


def _recorded_row(name: str, record: Record) -> MissionRow:
    status, reason = aside(record) or (Status(record["status"]), str(record["reason"]))
    done, todo = len(record["done"]), len(record["todo"])
    return MissionRow(
        name, status, done, todo, record["round"], record["attempts"], reason, record["late"]
    )
