"""What is kept in mind of a flight: its line in the list of flights, and its drones' work."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...flight.mission_status import all_over
from ...journal.header import check
from ...journal.standing import Standing
from ...shared.domain.errors import BadInput
from .airborne import FleetWork, Work
from .reading import JournalText

if TYPE_CHECKING:
    from ...app import App
    from ..wire import FlightEnd, FlightSummary


@dataclass(frozen=True, slots=True, kw_only=True)
class Digest:
    """One flight, as far as its journal is read; whether it flies just now is no part of it."""

    summary: FlightSummary
    work: dict[str, Work]
    """By the drones that have flown, or were lost."""


def digest_of(id: str, text: JournalText, app: App) -> Digest:
    """Read a journal to its end; what is wrong with it is said, and never raised."""
    work = FleetWork()
    begun_at = ended_at = last_at = None
    by: str | None = None
    simulated: bool | None = None
    said, results, seconds = "", 0, 0.0
    for instant, events in text.instants():
        last_at = round(instant.wall * 1000)
        for event in events:
            kind, seconds = event["event"], max(seconds, float(event["t"]))
            work.take(event)
            if kind == "journal.begun":
                begun_at, simulated = last_at, event.get("sim") is True
                by = _name(event.get("by"))
                said = _unfit(text.path, event, app)
            elif kind in ("mission.ended", "stopped"):
                ended_at = last_at
            results += kind == "trip.completed" and event.get("result") is not None
        if said:
            break
    work.end()
    records = Standing() if said else text.standing()
    said = said or text.damaged
    known = not said
    statuses = [record["status"] for record in records.missions.values() if record["ended"]]
    end = end_of(records) if known else "unknown"
    return Digest(
        summary={
            "id": id,
            "begun_at": begun_at,
            "ended_at": (ended_at or last_at) if end in ("over", "stopped") else None,
            "seconds": seconds,
            "by": by,
            "simulated": simulated,
            "end": end,
            "missions": len(records.missions),
            "completed": statuses.count("COMPLETED"),
            "failed": statuses.count("FAILED"),
            "cancelled": statuses.count("CANCELLED"),
            "trips": sum(one.trips for one in work.drones.values()),
            "results": results,
            "drones": [drone for drone, one in work.drones.items() if one.launched],
            "lost": [drone for drone, one in work.drones.items() if one.lost],
            "said": said,
        },
        work=work.drones,
    )


def end_of(records: Standing) -> FlightEnd:
    """Return how a flight has ended that does not fly any more."""
    if all_over(records):
        return "over"
    return "stopped" if records.stopped else "interrupted"


def _unfit(path: Path, header: dict[str, Any], app: App) -> str:
    """Return why this app cannot read a journal with this header; empty: it can."""
    try:
        check(path, header, app)
    except BadInput as error:
        return str(error)
    return ""


def _name(by: object) -> str | None:
    return by if isinstance(by, str) and by else None
