"""Resuming missions from the records of an earlier run and a report of the drones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import Status
from plutoc_runtime.trips.flight import Flight

from . import interventions
from .control import CANCELLED
from .live_fleet import live_fleet
from .reconcile import (
    Outcome,
    doubt,
    find_outcome,
    fly_again,
    fly_on,
    resume_status,
    settle_doubt,
    was_done,
)
from .restore import Rebuilt, last_flight, rebuilt, remember, restore_results

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Drone, Mission
    from plutoc_runtime.flow.mission import Core, MissionState

    from ..jobs.job import CommandLink
    from ..jobs.reports import FleetReport
    from ..journal.fold import Records
    from .live_engine import LiveEngine


async def go_on(
    core: Core, engine: LiveEngine, link: CommandLink, fleet_report: FleetReport, records: Records
) -> list[Mission[Any]]:
    """Resume everything where it was interrupted; return all missions, also those that have ended."""
    by_index = sorted(records.missions.items(), key=lambda item: int(item[1]["index"]))
    missions = {name: rebuilt(core, name, record) for name, record in by_index}
    restore_results(core, records, missions)
    drones = {drone.id: drone for drone in core.fleet.drones}
    for drone in drones.values():
        drone.trips = records.flown.get(drone.id, 0)
    revivals = [
        _Revival(core, engine, link, fleet_report, one, drones)
        for one in missions.values()
        if not one.record["ended"]
    ]
    for (
        revival
    ) in revivals:  # this may take a while, and nothing begins before all outcomes are known
        await revival.find_out()
    engaged: set[Drone] = set()
    for revival in revivals:
        revival.revive(engaged)
    at_work = {entry.drone for entry in fleet_report.jobs.values() if entry.flies}
    for drone in drones.values():
        if drone not in engaged:
            found = fleet_report.drones[drone.id]
            if drone.id in at_work:  # the earlier run could not abort its job any more
                link.break_off(drone.id)
                found = replace(found, landed=False)  # it may take off before it receives that
            live_fleet(core).take_up(drone, found)
    engine.look_for_the_end()
    return [one.mission for one in missions.values()]


class _Revival:
    """Resumes one mission."""

    def __init__(
        self,
        core: Core,
        engine: LiveEngine,
        link: CommandLink,
        fleet_report: FleetReport,
        one: Rebuilt,
        drones: Mapping[str, Drone],
    ) -> None:
        self._core, self._engine, self._link, self._fleet_report = core, engine, link, fleet_report
        self._mission, self._record, self._unfit = one.mission, one.record, one.unfit
        self._state: MissionState = engine.new_state(one.mission)
        remember(self._state, one.record, drones)
        self._flight: Flight | None = last_flight(self._state, one, drones)
        self._fate: Outcome | None = None

    async def find_out(self) -> None:
        """Find out the outcome of a flight that had not ended."""
        flight, record = self._flight, self._record
        if flight is not None and not flight.is_set and self._why_held() is None:
            entry, begun = self._fleet_report.jobs.get(flight.id), bool(record["flight"]["begun"])
            self._fate = await find_outcome(self._core, flight, entry, begun)

    def revive(self, engaged: set[Drone]) -> None:
        """Resume the mission, or say why it waits for the user; add the drones that it uses."""
        state, record, engine = self._state, self._record, self._engine
        why_held = self._why_held()
        if record["answer"] == "cancel":
            engine.set_aside(state)
            state.flight = state.carrier = None
            engine.end(state, Status.CANCELLED, CANCELLED)
        elif why_held is not None:
            self._call_off()
            self._check_carrier(engaged)
            engine.set_aside(state)
            interventions.hold(self._core, self._mission, why_held)
        else:
            if state.at is not None and state.at not in self._core.app.resumes:
                state.at = self._core.app.resumes[0]  # the user has said so
            if self._fate is None:
                self._check_carrier(engaged)
                self._resume()
            else:
                self._settle(self._fate, engaged)

    def _settle(self, what: Outcome, engaged: set[Drone]) -> None:
        """Settle a flight that had not ended, and resume."""
        state, flight, link = self._state, self._flight, self._link
        assert flight is not None
        entry = self._fleet_report.jobs.get(flight.id)
        if what is Outcome.FLIES_ON and entry is not None:
            engaged.add(flight.flier)
            fly_on(state, flight, link, entry)
            self._resume()
            return
        if what is Outcome.UNKNOWN:
            if flight.trip.item is not None:
                engaged.add(flight.flier)
            answer = self._record["answer"] if self._record["question"] else None
            if answer in _ANSWERS:
                settle_doubt(state, self._engine, link, _ANSWERS[answer])
            else:
                self._engine.set_aside(state)
                doubt(state, flight)
            return
        link.break_off(flight.drone)
        if what is Outcome.DONE:
            was_done(state, flight)
        else:
            fly_again(state, flight, link)
        if state.carrier is not None:
            engaged.add(state.carrier)
            state.keep_carrier(state.carrier)
        self._resume()

    def _resume(self) -> None:
        state, mission = self._state, self._mission
        if state.doom is not None:
            self._engine.set_aside(state)  # to be ended at once
        elif self._record["paused"] is not None:
            self._engine.set_aside(state)
            interventions.pause(self._core, mission)
        else:
            status = resume_status(state)
            if not state.goes_on:
                mission.status, mission.reason = status, ""
            self._engine.resume(state, status)

    def _check_carrier(self, engaged: set[Drone]) -> None:
        """Check that the mission's item is still aboard its drone."""
        state = self._state
        drone, item = state.carrier, state.carries
        if drone is None or item is None:
            return
        found = self._fleet_report.drones[drone.id]
        if found.reached and found.carrying != item.name:
            state.carrier = state.carries = None
            state.end(f"{item.name} is not aboard {drone.id} any more")
        else:
            engaged.add(drone)
            state.keep_carrier(drone)

    def _why_held(self) -> str | None:
        if self._unfit is not None:
            return self._unfit
        at, points = self._record["at"], self._core.app.resumes
        if at is None or at in points or (at == self._record["accepted"] and points):
            return None
        return f"it stopped at block {at}, which the app has no more as a place to go on"

    def _call_off(self) -> None:
        flown = self._record["flight"]
        if flown is not None and flown["outcome"] is None and not flown["heard"]:
            self._link.break_off(flown["drone"])


_ANSWERS = {"done": True, "not-done": False}
"""The user's answers, by whether the action was done."""
