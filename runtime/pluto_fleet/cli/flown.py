"""How a flight stands, as its journal has it: for the report, and for whoever waits."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.status import Status
from plutoc_runtime.domain.text import in_shell, printable

from ..journal.errors import Damaged
from ..journal.fold import Record, Records
from ..journal.header import check
from ..journal.reader import Reader
from .report import MissionRow, drone_table, in_one_line, mission_table
from .verdict import code_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone

ANSWERS = {"question": ("done", "not-done", "cancel"), "held": ("go-on", "cancel")}
"""What can be said to a mission that waits for this."""

_HARMLESS = re.compile(r"[\w ,.:;/()+-]+")
"""Names of which a shell leaves everything as it is, in quotation marks."""

_ASIDE = {"question": Status.UNCERTAIN, "held": Status.HELD, "paused": Status.PAUSED}


def report_of(
    app: App, journal: Path, records: Records, drones: Sequence[Drone] = ()
) -> tuple[int, list[str]]:
    """Return the exit code of a flight, and the lines of its report."""
    rows = [_row(name, record) for name, record in _in_order(records)]
    statuses = [row.status for row in rows]
    flights, failed, ended = _flights(journal)
    lines = [*mission_table(app, rows), ""]
    if drones:
        lines += [*drone_table(drones, {}), ""]
    lines.append(in_one_line(statuses, ended or records.time, flights, failed))
    return code_of(statuses), lines


def finished(records: Records) -> int:
    """Return how many trips and missions have come to an end."""
    ended = sum(record["ended"] for record in records.missions.values())
    failed = sum(
        trip.get("status") == "FAILED"
        for record in records.missions.values()
        for trip in record["todo"]
    )
    return int(ended + failed + len(records.results))


def all_over(records: Records) -> bool:
    """Whether every mission has ended."""
    missions = records.missions.values()
    return bool(missions) and all(record["ended"] for record in missions)


def has_ended(records: Records) -> bool:
    """Whether nothing flies any more: each mission has ended, or waits for a person's answer."""
    missions = records.missions.values()
    asides = [record["ended"] or aside(record) is not None for record in missions]
    return bool(asides) and all(asides)


def waiting(records: Records, *, answered: bool = False) -> Iterator[tuple[str, str, str]]:
    """Yield the missions that wait for a person: name, for what, and the question.

    `answered`: those, too, of whom somebody has decided already, with nothing come of it yet.
    """
    for name, record in _in_order(records):
        for what in ANSWERS:
            asks = record[what] is not None and not record["ended"]
            if asks and (answered or record["answer"] is None):
                yield name, what, record[what]
                break


def waiting_lines(app: App, journal: Path, records: Records) -> Iterator[str]:
    """Yield what is asked, and what can be answered."""
    for name, what, question in waiting(records):
        yield f"{printable(name)}: {printable(question)}"
        for answer in ANSWERS[what]:
            yield f"  {app.name} decide {in_shell(journal)} {_typed(name)} {answer}"


def _typed(name: str) -> str:
    """Write a mission's name, which may come from a stranger, as it can be typed safely."""
    word = f'"{name}"' if _HARMLESS.fullmatch(name) else in_shell(name)
    return f"-- {word}" if name.startswith("-") else word


def records_in(app: App, journal: Path) -> Records:
    """Return what a journal says, while somebody else may write it.

    One of another app is refused, and so is a damaged one: nobody knows what is missing.
    """
    records = Records()
    with closing(Reader(journal)) as reader:
        for row in reader.more():
            for event in json.loads(row.text):
                if row.seq == 0:
                    check(journal, event, app)
                records.take(event)
        if reader.damaged is not None:
            raise Damaged(reader.damaged)
    return records


def _in_order(records: Records) -> list[tuple[str, Record]]:
    return sorted(records.missions.items(), key=lambda item: int(item[1]["index"]))


def aside(record: Record) -> tuple[Status, str] | None:
    """Return how a mission stands that waits for a person, and what for; None: it does not."""
    for what, status in _ASIDE.items():
        if record[what] is not None and not record["ended"]:
            return status, record[what] if what in ANSWERS else ""
    return None


def _row(name: str, record: Record) -> MissionRow:
    status, reason = aside(record) or (Status(record["status"]), str(record["reason"]))
    done, todo = len(record["done"]), len(record["todo"])
    return MissionRow(name, status, done, todo, record["round"], record["attempts"], reason)


def _flights(journal: Path) -> tuple[int, int, float]:
    """Count the flights and those that failed; say when the last mission ended, too."""
    launched = failed = 0
    last = "[]"
    with closing(Reader(journal)) as reader:
        for row in reader.rows():  # a quotation mark within a text is written otherwise
            launched += row.text.count('"event": "trip.launched"')
            failed += row.text.count('"event": "trip.failed"')
            if '"event": "mission.ended"' in row.text:
                last = row.text
    ends = [event["t"] for event in json.loads(last) if event["event"] == "mission.ended"]
    return launched, failed, max(ends, default=0.0)
