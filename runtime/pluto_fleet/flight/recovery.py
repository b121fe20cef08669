"""Resuming from the records of an earlier run and a report of the drones, in plain data.

Every flight that had not ended is settled first: its outcome is an event, as if it had been seen. Then the
records say how each mission goes on.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from ..jobs.reports import reported_result, result_data
from ..shared.domain.fields import Entity
from ..shared.domain.own_fields import OwnField
from ..shared.domain.status import Status
from .kept_events import tell_kept
from .reconcile import (
    ANSWERS,
    CANCELLED,
    Outcome,
    drone_told,
    id_of,
    in_flight,
    outcome_of,
)

if TYPE_CHECKING:
    from ..app import App
    from ..jobs.reports import FleetReport
    from ..journal.standing import Record
    from .control import Control
    from .recorded_brain import RecordedBrain


class Recovery:
    """Settles what an earlier run has left, and says how a brain goes on."""

    def __init__(self, run: RecordedBrain, control: Control, fleet_report: FleetReport) -> None:
        self._run = run
        self._control = control
        self._report = fleet_report
        self._app = run.app
        self._link = run.link
        self._outcomes: dict[str, Outcome] = {}
        """What came of the missions' flights that had not ended."""
        self._unfit: dict[str, str] = {}
        """Why missions do not fit the present app."""
        self._resumed: dict[str, Mapping[str, Any]] = {}
        """The missions that go on; with the report of a flight that ended after the earlier run."""

    def restore(self) -> None:
        """Give the brain all rows; delays that a Stop interrupted keep their remaining time."""
        run = self._run
        known = self._run.records
        missions = {}
        for name, record in known.missions.items():
            missions[name] = record
            if (why := unfit(self._app, record)) is not None:
                missions[name] = {**record, "unfit": _needed(self._app)}
                if not record["ended"]:
                    self._unfit[name] = why
        shift = run.kernel.now - known.app["stopped"] if known.stopped else 0.0
        data = {**known.data, "missions": missions, "shift": shift}
        run.driver.call(partial(run.brain.restore, data))
        run.recorder.fact("stopped", None)
        for drone in known.mended:  # they were repaired, and not back when the earlier run ended
            self._link.send({"do": "mended", "drone": drone})

    async def find_out(self) -> None:
        """Find out the outcome of each flight that had not ended.

        This may take a while, and nothing begins before all outcomes are known.
        """
        for name, record in self._living():
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
                if not self._has_lost_its_item(name, record):
                    self._run.command("hold", mission=name, reason=why)
            elif name in self._outcomes:
                self._settle_flight(name, record, self._outcomes[name])
            elif not self._has_lost_its_item(name, record):
                self._resume(name)

    def _living(self) -> list[tuple[str, Record]]:
        return [(name, self._run.record(name)) for name in self._run.brain.under_way()]

    def _settle_flight(self, name: str, record: Record, what: Outcome) -> None:
        flight = record["flight"]
        entry = self._report.jobs.get(id_of(name, flight))
        if what is Outcome.FLIES_ON and entry is not None:
            ended = {} if entry.flies else {"report": result_data(reported_result(entry))}
            self._resume(name, ended)
            return
        if what is Outcome.UNKNOWN:
            answer = record["answer"] if record["question"] else None
            if answer not in ANSWERS:
                self._control.doubt(name, record)
                return
            what = ANSWERS[answer]
        else:
            self._link.send({"do": "break_off", "drone": flight["drone"]})
        if what is Outcome.DONE:
            self._run.command("settle", mission=name, done=True)
        else:
            self._run.interrupted(name, flight)
        self._resume(name)

    def _resume(self, name: str, flown: Mapping[str, Any] | None = None) -> None:
        record = self._run.record(name)
        if record["ended"]:
            return
        if record["paused"] is not None:
            self._run.command("pause", mission=name)
        else:
            self._resumed[name] = flown or {}

    def _has_lost_its_item(self, name: str, record: Record) -> bool:
        """End a mission whose item is not aboard its drone any more."""
        if record["carrier"] is None or record["carries"] is None:
            return False
        found, item = self._report.drones[record["carrier"]], record["carries"]["name"]
        if not found.reached or found.carrying == item:
            return False
        self._end(name, Status.FAILED, f"{item} is not aboard {found.drone} any more")
        return True

    def _end(self, name: str, status: Status, reason: str) -> None:
        self._run.command("cancel", mission=name, status=status.value, reason=reason)

    def _why_held(self, name: str, record: Record) -> str | None:
        if name in self._unfit:
            return self._unfit[name]
        at, points = record["at"], self._app.entries
        if at is None or at in points or (at == record["accepted"] and points):
            return None
        return f"it stopped at block {at}, which the app has no more as a place to go on"

    def _call_off(self, record: Record) -> None:
        flight = in_flight(record)
        if flight is not None:
            self._link.send({"do": "break_off", "drone": flight["drone"]})

    def go_on(self) -> None:
        """Have the brain go on; the drones that fly for no mission are called off."""
        self._run.driver.call(partial(self._run.brain.go_on, self._resumed, self._drones()))
        tell_kept(self._run)

    def _drones(self) -> Mapping[str, Mapping[str, Any]]:
        wanted = {
            self._run.record(name)["flight"]["drone"]
            for name, what in self._outcomes.items()
            if what is Outcome.FLIES_ON and name in self._resumed
        }
        at_work = {entry.drone for entry in self._report.jobs.values() if entry.flies} - wanted
        told = {}
        for drone, report in self._report.drones.items():
            told[drone] = drone_told(report)
            if drone in at_work:  # the earlier run could not abort its job any more
                self._link.send({"do": "break_off", "drone": drone})
                told[drone]["landed"] = False  # it may take off before it receives that
        return told


def _needed(app: App) -> dict[str, Any]:
    """Return the fields without which a mission cannot be, of one that does not fit the app."""
    return {one.name: one.sample for one in _own(app, Entity.MISSION) if one.hint}


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
