"""Resuming from the records of an earlier run and a report of the drones, in plain data.

Every flight that had not ended is settled first: its outcome is an event, as if it had been seen. Then the
records say how each mission goes on.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..jobs.reports import reported_result, result_data
from ..shared.domain.fields import Entity
from ..shared.domain.own_fields import OwnField
from ..shared.domain.status import Status
from .mission_status import in_order
from .reconcile import (
    ANSWERS,
    CANCELLED,
    Outcome,
    drone_told,
    ended,
    for_brain,
    id_of,
    in_flight,
    outcome_of,
)

if TYPE_CHECKING:
    from ..app import App
    from ..jobs.reports import FleetReport
    from ..journal.fold import Record
    from .control import Control
    from .recorded_brain import RecordedBrain


class Recovery:
    """Settles what an earlier run has left, and says how a brain goes on."""

    def __init__(self, run: RecordedBrain, control: Control, fleet_report: FleetReport) -> None:
        self._run, self._control, self._report = run, control, fleet_report
        self._app, self._link, self._records = run.app, run.link, run.records
        self._outcomes: dict[str, Outcome] = {}
        """What came of the missions' flights that had not ended."""
        self._suspended: set[str] = set()
        self._unfit: dict[str, str] = {}
        """Why missions do not fit the present app."""
        self._reports: dict[str, Mapping[str, Any]] = {}
        """What was reported of flights that ended after the earlier run, by mission."""

    def ask_the_mended(self) -> None:
        """Ask those drones anew that were repaired, and not back when the earlier run ended."""
        for drone in self._records.mended:
            self._link.send({"do": "mended", "drone": drone})

    async def find_out(self) -> None:
        """Find out the outcome of each flight that had not ended.

        This may take a while, and nothing begins before all outcomes are known.
        """
        for name, record in self._living():
            if (why := unfit(self._app, record)) is not None:
                self._unfit[name] = why
            flight = in_flight(record)
            if flight is not None and self._why_held(name, record) is None:
                entry = self._report.jobs.get(id_of(name, flight))
                what = outcome_of(entry, self._run.repeat_of(record), bool(flight["begun"]))
                if what is Outcome.UNKNOWN:
                    what = await self._control.probe(name, record)
                self._outcomes[name] = what

    def settle(self) -> None:
        """Record what came of every mission's flight, and how the mission goes on."""
        for name, record in self._living():
            why = self._why_held(name, record)
            if record["answer"] == "cancel":
                self._end(name, Status.CANCELLED, CANCELLED)
            elif why is not None:
                self._call_off(record)
                self._check_carrier(name, record)
                if not record["ended"]:
                    self._run.note("mission.held", mission=name, reason=why)
                    self._suspended.add(name)
            elif name in self._outcomes:
                self._settle_flight(name, record, self._outcomes[name])
            else:
                self._check_carrier(name, record)
                self._resume(name, record)

    def _living(self) -> list[tuple[str, Record]]:
        return [(name, record) for name, record in in_order(self._records) if not record["ended"]]

    def _settle_flight(self, name: str, record: Record, what: Outcome) -> None:
        flight = record["flight"]
        entry = self._report.jobs.get(id_of(name, flight))
        if what is Outcome.FLIES_ON and entry is not None:
            if not entry.flies:
                self._reports[name] = result_data(reported_result(entry))
            self._resume(name, record)
            return
        if what is Outcome.UNKNOWN:
            answer = record["answer"] if record["question"] else None
            if answer not in ANSWERS:
                self._control.doubt(name, record)
                self._suspended.add(name)
                return
            what = ANSWERS[answer]
        else:
            self._link.send({"do": "break_off", "drone": flight["drone"]})
        if what is Outcome.DONE:
            self._run.take(ended(name, flight))
        else:
            self._run.interrupted(name, flight)
        self._resume(name, record)

    def _resume(self, name: str, record: Record) -> None:
        if record["paused"] is not None and not record["ended"]:
            self._run.note("mission.paused", mission=name)
            self._suspended.add(name)

    def _check_carrier(self, name: str, record: Record) -> None:
        """Check that the mission's item is still aboard its drone."""
        if record["carrier"] is None or record["carries"] is None:
            return
        found, item = self._report.drones[record["carrier"]], record["carries"]["name"]
        if found.reached and found.carrying != item:
            self._end(name, Status.FAILED, f"{item} is not aboard {found.drone} any more")

    def _end(self, name: str, status: Status, reason: str) -> None:
        self._run.note("mission.ended", mission=name, status=status.value, reason=reason)

    def _why_held(self, name: str, record: Record) -> str | None:
        if name in self._unfit:
            return self._unfit[name]
        at, points = record["at"], self._app.resumes
        if at is None or at in points or (at == record["accepted"] and points):
            return None
        return f"it stopped at block {at}, which the app has no more as a place to go on"

    def _call_off(self, record: Record) -> None:
        flight = in_flight(record)
        if flight is not None:
            self._link.send({"do": "break_off", "drone": flight["drone"]})

    # For the brain

    def standing(self) -> Mapping[str, Any]:
        """Return how everything stands."""
        records = self._records
        return {
            "missions": {name: self._record(name) for name in records.missions},
            "results": records.results,
            "flown": records.flown,
            "lost": {drone: one["reason"] for drone, one in records.lost.items()},
            "retired": records.retired,
        }

    def _record(self, name: str) -> Record:
        record = self._records.missions[name]
        if name in self._unfit:
            return {**_bare(self._app, record), "status": "HELD"}
        if record["ended"] and unfit(self._app, record) is not None:
            return {**_bare(self._app, record), "status": record["status"], "ended": True}
        record = for_brain(self._app, record)
        if name in self._suspended:
            record["suspended"] = True
        elif name in self._reports:
            record["flight"] = {**record["flight"], "report": self._reports[name]}
        return record

    def drones(self) -> Mapping[str, Mapping[str, Any]]:
        """Call off the drones that fly for no mission, and return the reports of all."""
        wanted = {
            self._records.missions[name]["flight"]["drone"]
            for name, what in self._outcomes.items()
            if what is Outcome.FLIES_ON and name not in self._suspended
        }
        at_work = {entry.drone for entry in self._report.jobs.values() if entry.flies} - wanted
        told = {}
        for drone, report in self._report.drones.items():
            told[drone] = drone_told(report)
            if drone in at_work:  # the earlier run could not abort its job any more
                self._link.send({"do": "break_off", "drone": drone})
                told[drone]["landed"] = False  # it may take off before it receives that
        return told


def _bare(app: App, record: Record) -> dict[str, Any]:
    """Return what a brain must know of a mission that cannot go on: its trips and fields do not fit."""
    needed = {one.name: one.sample for one in _own(app, Entity.MISSION) if one.hint}
    return {"index": record["index"], "fields": needed, "suspended": True}


def _own(app: App, on: Entity) -> list[OwnField]:
    return [one for one in app.fields if isinstance(one, OwnField) and one.on is on]


def unfit(app: App, record: Record) -> str | None:
    """Return why a mission does not fit the app, or None."""
    for trip in (*record["todo"], *record["done"], *record["gone"]):
        if trip["action"] not in app.actions:
            return f"its trip {trip['name']} needs the action {trip['action']}, which the app has no more"
    known = {entity: {f.name for f in app.fields if f.on is entity} for entity in Entity}
    trips = (*record["todo"], *record["done"], *record["gone"])
    for fields, entity in (
        (record["fields"], Entity.MISSION),
        *((trip.get("fields", {}), Entity.TRIP) for trip in trips),
    ):
        for name in fields:
            if name not in known[entity]:
                return f"it does not fit into the app as it is now: there is no field {name}"
        for one in app.fields:
            if one.on is not entity:
                continue
            if one.name not in fields and isinstance(one, OwnField) and one.hint:
                return f"it does not fit into the app as it is now: it has no {one.name}"
            if one.name in fields and (wanted := one.wanted(fields[one.name], app.evaluators)):
                now = f"its {one.name} must be {wanted} now"
                return f"it does not fit into the app as it is now: {now}"
    return None
