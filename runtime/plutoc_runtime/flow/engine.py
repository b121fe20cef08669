"""The engine: starts missions, runs each through its graph, takes it out and back, and handles its end."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import Cancelled, Failure, FlightFailed, HookFault, MissionFailed
from ..domain.fields import Entity
from ..domain.keeper import Keeper, keep, keeper_of, put, trips_of
from ..domain.status import FAILED, RUNNING, STANDBY, UNEXECUTED, Status
from ..domain.text import said
from ..fleet.orders import failure_of
from ..hooks.plain_data import value_of
from .mission import Core, MissionState
from .promises import Promises
from .record import Record, mission_of, restore_drone, restore_results, restored
from .run import Run

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from ..time.kernel import Task
    from .flight import Flight


class Engine:
    """All missions of one running app."""

    def __init__(self, core: Core, states: dict[str, MissionState]) -> None:
        self.core = core
        self.states = states
        kinds = {Entity.MISSION: core.app.mission, Entity.TRIP: core.app.trip}
        self._fields = {(kinds[field.on], field.name): field for field in core.app.fields}
        self.promises = Promises(core, states, self.look_for_the_end)
        self._begun = 0  # how many missions are on their way through their graphs
        self._expected = 0  # what may begin more of them
        self.ended_at: float | None = None
        """When the last mission on its way ended, or was suspended; None: not yet."""

    @property
    def living(self) -> int:
        """How many missions are on their way through their graphs, and not waiting for others."""
        return self._begun - len(self.promises.waiting)

    def start(self, missions: Sequence[Record]) -> None:
        """Start missions, given as data, all at the same instant."""
        index = len(self.states)
        self.begin([mission_of(self.core.app, data, index + i) for i, data in enumerate(missions)])

    def begin(self, missions: Sequence[Mission[Any]], at: str | None = None) -> None:
        """Begin new missions; `at` is the block where they enter the graph."""
        for state in [self.new_state(mission) for mission in missions]:
            state.at = at
            self.states[state.mission.name] = state
            if state.mission.promises:
                self.promises.start(state.mission)
            self.enter(state, UNEXECUTED)

    def expect(self) -> None:
        """Note that something, such as an event, may yet begin a mission: this is not the end."""
        self._expected += 1
        self.ended_at = None

    def expect_no_more(self) -> None:
        """Note that what was expected is there, or will not come."""
        self._expected -= 1
        self.look_for_the_end()

    def new_state(self, mission: Mission[Any]) -> MissionState:
        """Return the initial state of a mission."""
        self.keep(mission, trips_of(mission))
        return MissionState(self.core, mission, self._call_off)

    def keep(self, mission: Mission[Any], trips: Iterable[Trip]) -> None:
        """Have a mission kept, with trips that it has: from now on hooks may write what they may."""
        core = self.core
        keeper = keeper_of(mission) or Keeper(core.kernel.time, self._fields, core.app.evaluators)
        keep(keeper, mission, trips)

    def enter(self, state: MissionState, status: Status) -> None:
        """Start a mission's flow, at its beginning or at the block where it resumes."""
        self.ended_at = None
        mission = state.mission
        run = Run(mission, state, state.key)
        run.at = state.at
        run.status = status
        state.block = ""
        waits = mission.promises and status is UNEXECUTED
        flow = self.promises.in_time(run) if waits else self.core.app.flow(run)
        run.task = state.task = state.spawn(flow, mission.name)
        run.task.over = partial(self._ended, state)
        self._begun += 1

    async def _call_off(self, state: MissionState) -> None:
        """Cancel a mission once the coroutine that found out that it must end has had its turn.

        So this is a task of its own; it comes before coroutines that are woken later at this instant.
        """
        if state.task is not None:
            state.task.cancel()
        elif state.suspended and self.states[state.mission.name] is state:
            self._end(state, FAILED, state.doom or "it was called off", was_out=True)

    # Out of the graph

    def suspend(self, state: MissionState) -> None:
        """Take a mission out of its graph; its flight is broken off, and what has its item waits there.

        What came of the flight is found out elsewhere, and settled then.
        """
        self._leave(state)
        flight = state.in_flight
        if flight is not None:
            state.break_off(flight)
            if state.keep_item(flight) is None:
                self.core.fleet.recover(flight.flier)
        if state.allocated is not None and state.allocated is not state.carrier:
            self.core.fleet.never_flew(state.allocated)
        state.allocated = None
        self.core.changes.mission(state.mission.name)
        self.look_for_the_end()

    def cancel(self, state: MissionState, status: Status, reason: str) -> None:
        """End a mission, wherever it is."""
        was_out = state.suspended
        self._leave(state)
        self._end(state, status, reason, was_out=was_out)

    def _leave(self, state: MissionState) -> None:
        self.promises.waiting.pop(state.mission.name, None)
        task = state.task
        state.task = None
        if task is not None:
            self._begun -= 1
            task.over = None
            task.cancel()

    # From rows, and back into the graph

    def restore(self, standing: Record) -> None:
        """Have missions, drones and results as their rows say; each mission is out of its graph."""
        core = self.core
        for id, row in standing.get("drones", {}).items():
            if (drone := core.fleet.named(id)) is not None:
                restore_drone(drone, row, core.fleet)
        missions = standing.get("missions", {}).items()
        for name, row in sorted(missions, key=lambda named: int(named[1]["index"])):
            self.states[name] = restored(core, name, row, self.new_state)
        restore_results(standing.get("results", ()), self.states, core.results)
        core.changes.clear(len(core.results.results))
        for state in self.states.values():
            self.promises.watch(state.mission)  # which may be late by now
        if seconds := standing.get("shift"):
            self._shift(seconds)

    def _shift(self, seconds: float) -> None:
        """Postpone every pending delay by the seconds in which everything was stopped."""
        for name, state in self.states.items():
            if state.ended or (state.delay is None and state.paused is None):
                continue
            state.postpone(seconds)
            if state.paused is not None:
                state.paused += seconds
            self.core.changes.mission(name)

    def go_on(self, missions: Mapping[str, Record], drones: Mapping[str, Record]) -> None:
        """Let these missions go on, and take over the drones that none needs.

        A mission may have the `report` of the end of its flight; the others stay out of their graphs.
        """
        fleet = self.core.fleet
        engaged: set[Drone] = set()
        for name, state in self.states.items():
            if state.ended or state.task is not None:
                continue
            if name in missions:
                self._resume(state, missions[name].get("report"), engaged)
            elif drones and (drone := state.keep_item(state.unsettled)) is not None:
                engaged.add(drone)
        for id, report in drones.items():
            free = fleet.named(id)
            if free is not None and free not in engaged and free not in fleet.errands:
                fleet.take_up(free, report)
        self.look_for_the_end()

    def _resume(self, state: MissionState, report: Record | None, engaged: set[Drone]) -> None:
        """Let a mission go on; add the drones that it needs."""
        core = self.core
        mission = state.mission
        flight = state.flight
        if state.holds is not None and state.holds is not state.carrier:
            core.fleet.recover(state.holds)  # it may have had the mission's item
        state.holds = None
        state.goes_on = flight is not None and not flight.heard
        if flight is not None and not flight.is_set:
            engaged.add(flight.flier)
            state.goes_on = True
            put(mission, status=RUNNING)
            core.fleet.flies_on(flight.flier)
            self._hear(state, flight, report)
        if state.carrier is not None and state.carrier not in engaged:
            engaged.add(state.carrier)
            state.keep_carrier(state.carrier)
        if state.doom is not None:  # it is to be ended at once
            return
        entries = core.app.entries
        if state.at is not None and state.at not in entries and entries:
            state.at = entries[0]  # a person has said so
        status = STANDBY if mission.attempts or state.interrupted else UNEXECUTED
        if not state.goes_on:
            put(mission, status=status, reason="")
        self.enter(state, status)

    def _hear(self, state: MissionState, flight: Flight, report: Record | None) -> None:
        """Register for the end of a flight; if it is known, report it at once, before any time-out."""
        if report is None:
            order = {"do": "attach", "drone": flight.drone, "flight": flight.id}
            self.core.orders.fly(flight.drone, partial(state.reported, flight), order)
        else:
            failed = "failure" in report
            state.reported(flight, failure_of(report) if failed else value_of(report.get("value")))

    # The end

    def _ended(self, state: MissionState, task: Task[Status]) -> None:
        """End a mission by the outcome of its coroutine."""
        self._begun -= 1
        error = task.error
        status = FAILED
        reason = ""
        if error is None:
            status = task.result()
            if status is FAILED:
                reason = state.mission.reason or "the graph ended it as FAILED"
        elif isinstance(error, MissionFailed):
            reason = str(error)
            if isinstance(error, HookFault) and error.detail:
                self._tell(state, error.detail)
        elif isinstance(error, Cancelled):
            reason = state.doom or "it was called off"
        elif (keeper := keeper_of(state.mission)) is not None and keeper.changed:
            from traceback import format_tb  # only where something has gone wrong

            reason = f"by a bug of Pluto, or of a hook that has changed the mission: {said(error)}"
            self._tell(state, "".join(format_tb(error.__traceback__)) + said(error))
        else:
            if not isinstance(error, Exception):  # a `SystemExit` would pass for a normal end
                where = f" in block {state.block}" if state.block else ""
                what = RuntimeError(f"it raised {said(error)}{where}")
                error = what.with_traceback(error.__traceback__)
            self.core.kernel.crash(error)
            return
        self._end(state, status, reason)

    def _tell(self, state: MissionState, detail: str) -> None:
        """Log what went wrong, and at which block."""
        block = f"\nin block {state.block}" if state.block else ""
        self.core.log(detail + block, state.mission.name)

    def look_for_the_end(self) -> None:
        """Note when every mission has ended, or was suspended, or waits for others that were."""
        if not (self.living or self._expected) and self.ended_at is None:
            self.ended_at = self.core.kernel.now

    def _end(
        self, state: MissionState, status: Status, reason: str, *, was_out: bool = False
    ) -> None:
        """End a mission; `was_out`: it was out of its graph already, and its flight is broken off."""
        fleet = self.core.fleet
        flight = state.in_flight
        if flight is not None and state.question is None:
            why = f"its mission ended: {reason or status.value}"
            if was_out:
                state.settle(flight, FlightFailed(Failure.REFUSED, why))
            else:
                state.break_off(flight)
                state.fail(flight, why)
        if state.allocated is not None:
            fleet.never_flew(state.allocated)
        for drone in dict.fromkeys((state.carrier, state.holds)):
            if drone is not None:
                fleet.recover(drone)  # what it carries must be taken off
        state.allocated = state.carrier = state.carries = state.holds = None
        state.question = state.held = state.paused = state.delay = None
        state.ended = True
        self.core.transitions.end(state.mission, status, reason)
        self.promises.ended(state.mission)
        self.look_for_the_end()
