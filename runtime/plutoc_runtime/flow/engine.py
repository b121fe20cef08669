"""The engine: starts missions, runs each through its graph, and handles its end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import Cancelled, Failure, FlightFailed, HookFault, MissionFailed
from ..domain.fields import Entity
from ..domain.keeper import Keeper, keep, keeper_of, trips_of
from ..domain.model import Mission
from ..domain.status import FAILED, UNEXECUTED, Status
from ..domain.text import said
from ..time.kernel import FLEET, Future, Task, mission_key
from .blame import as_crash, blame, blamed, traced
from .mission import Core, MissionState
from .promises import Promises
from .run import Run

if TYPE_CHECKING:
    from ..domain.model import Trip


class Engine:
    """All missions of one running app."""

    def __init__(self, core: Core, states: dict[str, MissionState]) -> None:
        self.core, self.states = core, states
        app = core.app
        kinds = {Entity.MISSION: core.app.mission, Entity.TRIP: core.app.trip}
        self._fields = {(kinds[field.on], field.name): field for field in app.fields}
        self.promises = Promises(core, states, self.look_for_the_end)
        self._begun = 0  # how many missions are on their way through their graphs
        self._expected = 0  # what may begin more of them
        self.whole: Task[float] | None = None
        """Waits for the end of all; gives when the last mission has ended."""
        self.done: Future[None] = Future()  # set when the last mission has ended, or was suspended

    @property
    def living(self) -> int:
        """How many missions are on their way through their graphs, and not waiting for others."""
        return self._begun - len(self.promises.waiting)

    def start(self, missions: Sequence[Mission[Any]], at: str | None = None) -> None:
        """Start the missions, all at the same instant; `at` is the block where they enter the graph."""
        states = [self.new_state(mission) for mission in missions]
        for state in states:
            state.at = at
            self.states[state.mission.name] = state
            if state.mission.promises:
                self.promises.start(state.mission)
            self.enter(state, UNEXECUTED)
        self.look_after_the_end()

    def expect(self) -> None:
        """Note that something, such as an event, may yet begin a mission: this is not the end."""
        if self.done.is_set:
            self.done = Future()
        self._expected += 1
        self.look_after_the_end()

    def expect_no_more(self) -> None:
        """Note that what was expected is there, or will not come."""
        self._expected -= 1
        self.look_for_the_end()

    def look_after_the_end(self) -> None:
        """Have somebody wait for the end of all, unless somebody does."""
        if self.whole is None or self.whole.is_set:
            self.whole = self.core.kernel.spawn(self._see_through(), FLEET, "the whole")

    async def _see_through(self) -> float:
        """Wait until every mission has ended and every drone has landed; return when the last one ended."""
        while True:
            await self.done
            ended = self.core.kernel.now
            await self.core.fleet.all_down()
            if self.done.is_set:  # no mission has been resumed meanwhile
                return ended

    def new_state(self, mission: Mission[Any]) -> MissionState:
        """Return the initial state of a mission."""
        self.keep(mission, trips_of(mission))
        return MissionState(self.core, mission, self._doomed)

    def keep(self, mission: Mission[Any], trips: Iterable[Trip]) -> Keeper:
        """Have a mission kept, with trips that it has or had: from now on hooks may write what they may."""
        core = self.core
        keeper = keeper_of(mission) or Keeper(core.kernel.time, self._fields, core.app.evaluators)
        keep(keeper, mission, trips)
        return keeper

    def enter(self, state: MissionState, status: Status) -> None:
        """Start a mission's flow, at its beginning or at the block where it resumes."""
        if self.done.is_set:
            self.done = Future()
        core, mission, key = self.core, state.mission, mission_key(state.mission.index)
        run = Run(mission, state, key)
        run.at, run.status = state.at, status
        waits = mission.promises and status is UNEXECUTED
        flow = self.promises.in_time(run) if waits else core.app.flow(run)
        run.task = state.task = task = core.kernel.spawn(flow, key, mission.name)
        task.over = partial(self._ended, state)
        self._begun += 1

    def _doomed(self, state: MissionState) -> None:
        key, name = mission_key(state.mission.index), f"{state.mission.name} is doomed"
        self.core.kernel.spawn(self._call_off(state), key, name)

    async def _call_off(self, state: MissionState) -> None:
        """Cancel a mission once the coroutine that found out that it must end has had its turn.

        So this is a task of its own; it comes before coroutines that are woken later at this instant.
        """
        if state.task is not None:
            state.task.cancel()
        elif state.suspended and self.states[state.mission.name] is state:
            self._end(state, FAILED, state.doom or "it was called off", was_out=True)

    def suspend(self, state: MissionState) -> None:
        """Take a mission out of its graph; its flight is broken off, and what has its item waits there.

        What came of the flight is found out elsewhere, and settled then.
        """
        self._leave(state)
        flight = state.in_flight
        if flight is not None:
            state.break_off(flight)
            if flight.trip.item is not None:
                state.holds = flight.flier
            holds = state.carrier or state.holds
            if holds is None:
                self.core.fleet.recover(flight.flier)
            else:
                state.keep_carrier(holds)
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
        task, state.task = state.task, None
        self.promises.waiting.pop(state.mission.name, None)
        if task is not None:
            self._begun -= 1
            task.over = None
            task.cancel()

    def _ended(self, state: MissionState, task: Task[Status]) -> None:
        """End a mission by the outcome of its coroutine."""
        self._begun -= 1
        error, reason = task.error, ""
        if error is None:
            status = task.result()
            if status is FAILED:
                reason = state.mission.reason or "the graph ended it as FAILED"
        elif isinstance(error, MissionFailed):
            status, reason = FAILED, str(error)
            if isinstance(error, HookFault) and error.detail:
                self._tell(error, state.mission)
        elif isinstance(error, Cancelled):
            status, reason = FAILED, state.doom or "it was called off"
        elif (keeper := keeper_of(state.mission)) is not None and keeper.changed:
            reason = f"by a bug of Pluto, or of a hook that has changed the mission: {said(error)}"
            status = FAILED
            self._tell(HookFault(reason, traced(error)), state.mission)
        else:
            crash = as_crash(error)
            blame(crash, self.core.app.flow)
            self.core.kernel.crash(crash)
            return
        self._end(state, status, reason)

    def _tell(self, fault: HookFault, mission: Mission[Any]) -> None:
        """Log where a hook failed, and which block called it."""
        block = blamed(fault, self.core.app.flow)
        self.core.log(fault.detail + (f"\nin block {block}" if block else ""), mission.name)

    def look_for_the_end(self) -> None:
        """Set `done` if every mission has ended, or was suspended, or waits for others that were."""
        if not (self.living or self._expected):
            self.done.set(None)

    def _end(
        self, state: MissionState, status: Status, reason: str, *, was_out: bool = False
    ) -> None:
        """End a mission; `was_out`: it was out of its graph already, and its flight is broken off."""
        mission, fleet = state.mission, self.core.fleet
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
        self.core.transitions.end(mission, status, reason)
        self.promises.ended(mission)
        self.look_for_the_end()
