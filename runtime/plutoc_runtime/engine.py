"""The engine: starts missions, takes each through its graph, and sees it to its end."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from .errors import MissionFailed
from .flight import abort
from .kernel import Cancelled, Kind, Signal
from .run import Run
from .state import State
from .status import Status

if TYPE_CHECKING:
    from .core import Core
    from .model import Mission


class Engine:
    """All missions of one running app."""

    def __init__(self, core: Core) -> None:
        self._core = core
        self._living: dict[Mission[Any], State] = {}
        self._halted = False
        self.done: Signal[None] = Signal()
        """Set when the last mission has ended."""

    def start(self, missions: Sequence[Mission[Any]]) -> None:
        """Set the missions on their way, all at once."""
        for mission in missions:
            self._living[mission] = State(mission=mission)
        for mission, state in self._living.items():
            state.doom.watch(partial(self._kill, state))
            self._core.kernel.spawn(self._live(state), (mission.index,), f"{mission.name} lives")

    async def _live(self, state: State) -> None:
        mission, key = state.mission, (state.mission.index,)
        run = Run(mission, self._core, state, key)
        state.task = self._core.kernel.spawn(self._core.app.flow(run), key, mission.name)
        reason = ""
        try:
            status = await state.task.done
            if status is Status.FAILED:
                reason = mission.reason or "the graph ended it as FAILED"
        except MissionFailed as error:
            status, reason = Status.FAILED, str(error)
        except Cancelled:
            if self._halted:
                return
            status, reason = Status.FAILED, state.doom.result()
        self._end(state, status, reason)

    def halt(self) -> None:
        """Take every mission out of its graph where it is; nothing is launched any more."""
        self._halted = True
        for state in self._living.values():
            flight = state.in_flight
            if flight is not None and flight.task is not None:
                flight.task.cancel()
            if state.task is not None:
                state.task.cancel()

    def _kill(self, state: State) -> None:
        """End a doomed mission, once whoever found out has finished its turn."""
        kernel = self._core.kernel
        task = state.task
        if task is not None:
            kernel.at(kernel.now, Kind.READY, (state.mission.index,), task.cancel)

    def _end(self, state: State, status: Status, reason: str) -> None:
        mission, fleet = state.mission, self._core.fleet
        abort(self._core, state, f"its mission ended: {reason or status.value}")
        if state.allocated is not None:
            fleet.never_flew(state.allocated)
        if state.carrier is not None:
            fleet.recover(state.carrier)  # somebody must take off what it carries
        state.allocated = state.carrier = state.carries = None
        self._core.transitions.end(mission, status, reason)
        del self._living[mission]
        if not self._living:
            self.done.set(None)
