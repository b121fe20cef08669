"""The report of a flight, from its journal."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.status import Status
from plutoc_runtime.domain.text import in_shell, printable

from ..flight.standing import ANSWERS, aside, count_flights, in_order, waiting

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone

    from ..journal.fold import Record, Records

_HARMLESS = re.compile(r"[\w ,.:;/()+-]+")
"""Names of which a shell leaves everything as it is, in quotation marks."""


def report_of(
    app: App, journal: Path, records: Records, drones: Sequence[Drone] = ()
) -> tuple[int, list[str]]:
    """Return the exit code of a flight that has a journal, and the lines of its report."""
    rows = [_recorded_row(name, record) for name, record in in_order(records)]
    statuses = [row.status for row in rows]
    flights, failed, ended = count_flights(journal)
    lines = [*mission_table(app, rows), ""]
    if drones:
        lines += [*drone_table(drones, {}), ""]
    lines.append(in_one_line(statuses, ended or records.time, flights, failed))
    return code_of(statuses), lines


def waiting_lines(app: App, journal: Path, records: Records) -> Iterator[str]:
    """Yield what is asked of a person, and the commands that answer it."""
    for name, what, question in waiting(records):
        yield f"{printable(name)}: {printable(question)}"
        for answer in ANSWERS[what]:
            yield f"  {app.name} decide {in_shell(journal)} {_typed(name)} {answer}"


def _typed(name: str) -> str:
    """Write a mission's name, which may come from a stranger, as it can be typed safely."""
    word = f'"{name}"' if _HARMLESS.fullmatch(name) else in_shell(name)
    return f"-- {word}" if name.startswith("-") else word


def _recorded_row(name: str, record: Record) -> MissionRow:
    status, reason = aside(record) or (Status(record["status"]), str(record["reason"]))
    done, todo = len(record["done"]), len(record["todo"])
    return MissionRow(name, status, done, todo, record["round"], record["attempts"], reason)
