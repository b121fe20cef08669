"""The statuses of a flight's missions, according to its journal."""

from __future__ import annotations

from collections.abc import Container, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..journal.facts import Event
from ..journal.facts import check as check_facts
from ..journal.header import check
from ..journal.reader import Reader
from ..journal.standing import Record, Standing
from ..shared.domain.status import Status

if TYPE_CHECKING:
    from ..app import App

ANSWERS = {Status.UNCERTAIN: ("done", "not-done", "cancel"), Status.HELD: ("go-on", "cancel")}
"""The possible answers, by the status of a mission that asks."""

_ASIDE = {"question": Status.UNCERTAIN, "held": Status.HELD, "paused": Status.PAUSED}


def records_in(app: App, journal: Path) -> Standing:
    """Return where everything stands by a journal, while an app may be writing it.

    Another app's journal is refused, and so is a damaged one, whose missing part cannot be known.
    """
    with closing(Reader(journal)) as reader:
        if reader.damaged is None:
            check(journal, reader.header, app)
        return reader.standing()


def in_order(records: Standing) -> list[tuple[str, Record]]:
    """Return the missions with their names, in the order of the plan."""
    return sorted(records.missions.items(), key=lambda item: int(item[1]["index"]))


def finished(records: Standing) -> int:
    """Return how many trips and missions have ended."""
    ended = sum(record["ended"] for record in records.missions.values())
    failed = sum(
        trip.get("status") == "FAILED"
        for record in records.missions.values()
        for trip in record["todo"]
    )
    return int(ended + failed + len(records.results))


def all_over(records: Standing) -> bool:
    """Whether every mission has ended."""
    missions = records.missions.values()
    return bool(missions) and all(record["ended"] for record in missions)


def has_ended(records: Standing) -> bool:
    """Whether nothing flies any more: each mission has ended, or waits for an answer."""
    missions = records.missions.values()
    asides = [record["ended"] or aside(record) is not None for record in missions]
    return bool(asides) and all(asides)


def waiting(records: Standing, *, answered: bool = False) -> Iterator[tuple[str, Status, str]]:
    """Yield the missions that wait for the user: name, status, and the question.

    `answered`: also those that have been answered without effect yet.
    """
    for name, record in in_order(records):
        asked = aside(record)
        if asked is not None and asked[0] in ANSWERS and (answered or record["answer"] is None):
            yield name, *asked


def aside(record: Record) -> tuple[Status, str] | None:
    """Return the status and question of a mission that waits for the user, or None."""
    for what, status in _ASIDE.items():
        if record[what] is not None and not record["ended"]:
            return status, record[what] if status in ANSWERS else ""
    return None


def count_flights(journal: Path, wanted: Container[str]) -> tuple[int, int, float, list[Event]]:
    """Count the flights and those that failed; return how many seconds the missions took, too.

    With it come the entries of the kinds that are wanted. The seconds are from when the drones were connected, as in a simulation; 0: none has ended.
    """
    launched = failed = 0
    began = None
    ended = 0.0
    told = list[Event]()
    with closing(Reader(journal)) as reader:
        for instant in reader.instants():
            with suppress(ValueError):
                for event in instant.events:
                    check_facts(event)
                    kind = event["event"]
                    launched += kind == "trip.launched"
                    failed += kind == "trip.failed"
                    if kind in wanted:
                        told.append(event)
                    if began is None and kind == "brain.began":
                        began = event["t"]
                    if kind == "mission.ended":
                        ended = event["t"]
    seconds = max(ended - (began or 0.0), 0.0) if ended else 0.0
    return launched, failed, seconds, told
