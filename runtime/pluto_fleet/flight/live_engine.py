"""The engine of a real flight: missions can be suspended, wait for the user, and resume."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import FAILED, Status
from plutoc_runtime.flow.engine import Engine
from plutoc_runtime.flow.mission import MissionState
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import Task, mission_key

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.flow.engine import Session
    from plutoc_runtime.flow.mission import Core


class LiveEngine(Engine):
    """An engine whose missions may be paused, uncertain or held."""

    def __init__(self, core: Core) -> None:
        super().__init__(core)
        self._aside: dict[str, MissionState] = {}
        """The missions that wait for the user."""
        self._halted: tuple[MissionState, ...] | None = None
        """The missions that were running when all were halted."""
        self.patient = False
        """Whether the flight goes on while missions wait for the user's decision."""

    @property
    def states(self) -> Iterator[MissionState]:
        """Every mission that has not ended."""
        yield from self._in_their_graphs()
        yield from self._aside.values()

    def _in_their_graphs(self) -> tuple[MissionState, ...]:
        if self._halted is not None:
            return self._halted
        tasks = self._core.kernel.under_way()
        return tuple(task.over for task in tasks if isinstance(task.over, MissionState))

    def add(self, missions: Sequence[Mission[Any]]) -> None:
        """Start more missions, while others fly or after all have ended."""
        if self.done.is_set:
            self.done = Future()
        self.start(missions)

    def resume(self, state: MissionState, status: Status) -> None:
        """Resume an interrupted mission at its last resumable block, with this status."""
        if self.done.is_set:
            self.done = Future()
        self._aside.pop(state.mission.name, None)
        self._enter(state, status)

    def set_aside(self, state: MissionState) -> None:
        """Suspend a mission until the user says how it goes on."""
        self._aside[state.mission.name] = state
        task, state.task = state.task, None
        if task is not None:
            self._living -= 1
            task.over = None
            task.cancel()
        if state.allocated is not None:
            if state.allocated is not state.carrier:
                self._core.fleet.never_flew(state.allocated)
            state.allocated = None

    def is_aside(self, state: MissionState) -> bool:
        """Return whether a mission waits for the user."""
        return self._aside.get(state.mission.name) is state

    def waits(self, state: MissionState) -> None:
        """Suspend a mission until the user decides."""
        self.set_aside(state)
        self._core.kernel.spawn(
            self._look(), mission_key(state.mission.index), f"{state.mission.name} waits"
        )

    async def _look(self) -> None:
        self.look_for_the_end()

    def end(self, state: MissionState, status: Status, reason: str) -> None:
        """End a mission that waits for the user."""
        self._aside.pop(state.mission.name, None)
        self._end(state, status, reason)

    def look_for_the_end(self) -> None:
        """Set `done` if every mission has ended; missions that wait for the user may go on."""
        paused = (state.mission.status is Status.PAUSED for state in self._aside.values())
        waits = bool(self._aside) if self.patient else any(paused)
        if not waits:
            super().look_for_the_end()

    def halt(self) -> None:
        """Cancel every mission where it is; nothing more is launched."""
        self._halted = self._in_their_graphs()
        for state in self._halted:
            flight = state.in_flight
            if flight is not None:
                state.break_off(flight)
            state.flight = None  # later reports are read from the ledger
            if state.task is not None:
                state.task.cancel()

    async def _call_off(self, state: MissionState) -> None:
        if state.task is None and self.is_aside(state):
            self.end(state, FAILED, state.doom or "it was called off")
        else:
            await super()._call_off(state)

    def ended(self, state: MissionState, task: Task[Status]) -> None:
        """End a mission by the outcome of its coroutine, unless all were halted."""
        if self._halted is None:
            super().ended(state, task)


def live_engine(session: Session) -> LiveEngine:
    """Return the engine of a real flight."""
    assert isinstance(session.engine, LiveEngine)
    return session.engine
