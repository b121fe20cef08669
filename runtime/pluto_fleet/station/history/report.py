"""The report of a flight, to be printed: missions, results, drones, incidents, commands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import inf, isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...flight.mission_status import aside, in_order
from ...report.sentences import sentence_of
from .commands import commands_of
from .logbook import logbook

if TYPE_CHECKING:
    from ...app import App
    from ...journal.standing import Record
    from ..wire import (
        FlightReport,
        Incident,
        ReportDrone,
        ReportMission,
        ReportResults,
        ReportTrip,
    )
    from .digest import Digest
    from .reading import Event, JournalText

_KINDS: Mapping[str, Any] = {
    "drone.lost": "lost",
    "drone.drained": "drained",
    "trip.failed": "failed",
    "mission.uncertain": "uncertain",
    "mission.held": "held",
    "mission.late": "late",
    "mission.judged": "finding",
    "mission.extended": "finding",
    "stopped": "stopped",
}
"""The events that are incidents."""


def report_of(
    app: App, journal: JournalText, again: JournalText, digest: Digest, own_folder: Path
) -> FlightReport:
    """Return the report of a flight; its journal is read twice."""
    trips = _Trips()
    incidents: list[Incident] = []
    commanded: list[tuple[Event, float]] = []
    for instant, events in journal.instants():
        for event in events:
            trips.take(event)
            kind = _KINDS.get(event["event"])
            if kind is not None:
                incidents.append(_incident(kind, event))
            if event["event"] == "commanded":
                commanded.append((event, instant.wall))
    records = journal.standing()
    return {
        "flight": digest.summary,
        "missions": [_mission(name, record, trips) for name, record in in_order(records)],
        "results": _results(logbook(app, again).feed.brought()),
        "drones": _drones(digest),
        "incidents": incidents,
        "commands": commands_of(digest.summary, commanded, own_folder),
    }


class _Trips:
    """When each trip was flown last, and when each mission began and ended."""

    def __init__(self) -> None:
        self.flown: dict[tuple[str, str], Event] = {}
        """Of a trip's last flight: drone, attempts, began, ended, why."""
        self.began: dict[str, float] = {}
        self.ended: dict[str, float] = {}

    def take(self, event: Event) -> None:
        match event["event"]:
            case "trip.launched":
                which = event["mission"], event["trip"]
                attempts = self.flown.get(which, {}).get("attempts", 0) + 1
                flown = {"drone": event["drone"], "attempts": attempts, "began": event["t"]}
                self.flown[which] = flown
                self.began.setdefault(event["mission"], event["t"])
            case "trip.completed" | "trip.failed" | "trip.interrupted":
                flown = self.flown.setdefault((event["mission"], event["trip"]), {})
                flown.update(ended=event["t"], why=event.get("reason", ""))
            case "mission.ended":
                self.ended[event["mission"]] = event["t"]


def _incident(kind: Any, event: Event) -> Incident:
    return {
        "time": event["t"],
        "kind": kind,
        "mission": event.get("mission"),
        "drone": event.get("drone"),
        "text": sentence_of(event) or str(event.get("reason", "")),
    }


def _mission(name: str, record: Record, trips: _Trips) -> ReportMission:
    status, why = aside(record) or (None, record["reason"])
    parts = (("COMPLETED", "done"), ("WAITING", "todo"), ("SKIPPED", "gone"))
    return {
        "name": name,
        "status": record["status"] if status is None else status.value,
        "why": why,
        "began": trips.began.get(name),
        "ended": trips.ended.get(name),
        "due": record["promises"].get("deadline"),
        "late": record["late"],
        "rounds": record["round"] + 1,
        "trips": [
            _trip(trip, usual, trips.flown.get((name, trip["name"]), {}))
            for usual, part in parts
            for trip in record[part]
        ],
    }


def _trip(trip: Record, usual: str, flown: Event) -> ReportTrip:
    return {
        "name": trip["name"],
        "action": trip["action"],
        "status": trip.get("status", usual),
        "drone": flown.get("drone"),
        "attempts": flown.get("attempts", 0),
        "began": flown.get("began"),
        "ended": flown.get("ended"),
        "why": flown.get("why", ""),
    }


def _results(brought: Iterable[Any]) -> list[ReportResults]:
    """Return the results in groups of what was done, and of what was measured."""
    groups: dict[tuple[str | None, str, str | None, str | None], list[Any]] = {}
    for one in brought:
        which = one.get("action"), one["kind"], one.get("quantity"), one.get("unit")
        groups.setdefault(which, []).append(one["value"])
    return [_group(*which, values) for which, values in groups.items()]


def _group(
    action: str | None, kind: str, quantity: str | None, unit: str | None, values: list[Any]
) -> ReportResults:
    numbers = [one for one in values if type(one) in (int, float)]
    all_are = len(numbers) == len(values)
    mean = sum(numbers) / len(numbers) if all_are else inf
    return {
        "action": action,
        "kind": kind,
        "quantity": quantity,
        "unit": unit,
        "count": len(values),
        "lowest": min(numbers) if all_are else None,
        "mean": mean if isfinite(mean) else None,
        "highest": max(numbers) if all_are else None,
    }


def _drones(digest: Digest) -> list[ReportDrone]:
    return [
        {
            "id": drone,
            "trips": work.trips,
            "launched": work.launched,
            "hours": work.seconds / 3600 if work.measured else None,
            "first_battery": work.first_level,
            "lowest_battery": work.lowest_level,
            "last_battery": work.last_level,
            "lost": work.lost,
        }
        for drone, work in sorted(digest.work.items())
    ]
