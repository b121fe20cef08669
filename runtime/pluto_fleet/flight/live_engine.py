"""The engine of an app that really flies: missions wait for people, are taken out, and go on."""

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
        """The missions that wait for a person."""
        self._halted: tuple[MissionState, ...] | None = None
        """Who was in a graph when all were taken out."""
        self.patient = False
        """Whether missions that wait for a person's decision keep it from being over."""

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
        """Set more missions on their way, while others fly or after all have ended."""
        if self.done.is_set:
            self.done = Future()
        self.start(missions)

    def resume(self, state: MissionState, status: Status) -> None:
        """Let a mission that was interrupted go on at the block where it can, with this status."""
        if self.done.is_set:
            self.done = Future()
        self._aside.pop(state.mission.name, None)
        self._enter(state, status)

    def set_aside(self, state: MissionState) -> None:
        """Take a mission out of its graph, if it is in it, until a person says how it goes on."""
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
        """Say whether a mission waits for a person."""
        return self._aside.get(state.mission.name) is state

    def waits(self, state: MissionState) -> None:
        """Take a mission out of its graph: only a person's decision lets it go on."""
        self.set_aside(state)
        self._core.kernel.spawn(
            self._look(), mission_key(state.mission.index), f"{state.mission.name} waits"
        )

    async def _look(self) -> None:
        self.look_for_the_end()

    def end(self, state: MissionState, status: Status, reason: str) -> None:
        """End a mission that waits for a person."""
        self._aside.pop(state.mission.name, None)
        self._end(state, status, reason)

    def look_for_the_end(self) -> None:
        """See whether there is nothing left to do; what waits for a person may yet come."""
        paused = (state.mission.status is Status.PAUSED for state in self._aside.values())
        waits = bool(self._aside) if self.patient else any(paused)
        if not waits:
            super().look_for_the_end()

    def halt(self) -> None:
        """Take every mission out of its graph where it is; nothing is launched any more."""
        self._halted = self._in_their_graphs()
        for state in self._halted:
            flight = state.in_flight
            if flight is not None:
                state.break_off(flight)
            state.flight = None  # what is still reported of it is read from the ledger
            if state.task is not None:
                state.task.cancel()

    async def _call_off(self, state: MissionState) -> None:
        if state.task is None and self.is_aside(state):
            self.end(state, FAILED, state.doom or "it was called off")
        else:
            await super()._call_off(state)

    def ended(self, state: MissionState, task: Task[Status]) -> None:
        """A mission's coroutine is over: see how it ended, unless all were taken out."""
        if self._halted is None:
            super().ended(state, task)


def live_engine(session: Session) -> LiveEngine:
    """Return the engine of an app that really flies."""
    assert isinstance(session.engine, LiveEngine)
    return session.engine
