"""The engine: starts missions, takes each through its graph, and sees it to its end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .blame import blame, blamed
from .errors import HookFault, MissionFailed
from .flight import abort
from .kernel import Cancelled, Task, mission_key
from .run import Run
from .signals import Signal
from .state import State
from .status import FAILED, Status

if TYPE_CHECKING:
    from .core import Core
    from .model import Mission


class Engine:
    """All missions of one running app."""

    def __init__(self, core: Core) -> None:
        self._core = core
        self._living: dict[Task[Status], State] = {}
        self._halted = False
        self.done: Signal[None] = Signal()
        """Set when the last mission has ended."""

    def start(self, missions: Sequence[Mission[Any]]) -> None:
        """Set the missions on their way, all at once."""
        core, kernel = self._core, self._core.kernel
        ended, doomed = self._ended, self._doomed
        for mission in missions:
            state, key = State(core, mission, doomed), mission_key(mission.index)
            run = Run(mission, state, key)
            run.task = state.task = task = kernel.spawn(core.app.flow(run), key, mission.name)
            task.over = ended
            self._living[task] = state

    def halt(self) -> None:
        """Take every mission out of its graph where it is; nothing is launched any more."""
        self._halted = True
        for task, state in list(self._living.items()):
            flight = state.in_flight
            if flight is not None:
                flight.break_off()
            task.cancel()

    def _doomed(self, state: State) -> None:
        """End a doomed mission, once whoever found out has finished its turn."""
        mission = state.mission
        self._core.kernel.spawn(
            _call_off(state), mission_key(mission.index), f"{mission.name} is doomed"
        )

    def _ended(self, task: Task[Status]) -> None:
        """A mission's coroutine is over: see how it ended."""
        if self._halted:
            return
        state, error = self._living.pop(task), task.error
        reason = ""
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
        else:
            blame(error, self._core.app.flow)
            self._core.kernel.crash(error)
            return
        self._end(state, status, reason)

    def _tell(self, fault: HookFault, mission: Mission[Any]) -> None:
        """Log where a hook failed, and by which block it was called."""
        block = blamed(fault, self._core.app.flow)
        self._core.log(fault.detail + (f"\nin block {block}" if block else ""), mission.name)

    def _end(self, state: State, status: Status, reason: str) -> None:
        mission, fleet = state.mission, self._core.fleet
        if state.in_flight is not None:
            abort(state, f"its mission ended: {reason or status.value}")
        if state.allocated is not None:
            fleet.never_flew(state.allocated)
        if state.carrier is not None:
            fleet.recover(state.carrier)  # somebody must take off what it carries
        state.allocated = state.carrier = state.carries = None
        self._core.transitions.end(mission, status, reason)
        if not self._living:
            self.done.set(None)


async def _call_off(state: State) -> None:
    """Take its turn among the coroutines of this instant: before whoever is woken later."""
    if state.task is not None:
        state.task.cancel()
