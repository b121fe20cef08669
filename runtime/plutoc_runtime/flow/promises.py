"""When a mission may begin, and when it is late."""

from __future__ import annotations

from collections.abc import Coroutine
from typing import TYPE_CHECKING, Any

from ..domain.errors import MissionFailed
from ..domain.promises import kept_from
from ..domain.status import COMPLETED
from ..domain.text import quoted
from ..time.future import Future
from ..time.kernel import EventKind, mission_key

if TYPE_CHECKING:
    from ..domain.model import Mission
    from ..domain.status import Status
    from .mission import Core, MissionState


class Promises:
    """The promises of all missions of one running app."""

    def __init__(self, core: Core, states: dict[str, MissionState]) -> None:
        self._core, self._states = core, states
        self._ends: dict[str, Future[None]] = {}
        """Each is set when the mission of that name has ended, if others wait for it."""

    def start(self, mission: Mission[Any]) -> None:
        """Fix a new mission's promises in seconds since the app started, and record them."""
        clock = self._core.kernel
        mission.promises = kept_from(mission.promises, clock.now, clock.time_of_day)
        if self._core.trace.live:
            self._core.trace.note("mission.promised", mission=mission.name, **mission.promises)

    def watch(self, mission: Mission[Any]) -> None:
        """Notice when a mission is late."""
        mission.deadline = deadline = mission.promises.get("deadline")

        def look() -> None:
            state = self._states.get(mission.name)
            if state is not None and not (mission.late or state.ended):
                mission.late = True
                if self._core.trace.live:
                    self._core.trace.note("mission.late", mission=mission.name, deadline=deadline)

        if deadline is not None and not mission.late:
            # what ends at that very instant has ended before
            self._core.kernel.at(deadline, EventKind.ALLOCATE, mission_key(mission.index), look)

    def ended(self, mission: Mission[Any]) -> None:
        """Called when a mission has ended, in any way."""
        if mission.name in self._ends:
            self._ends.pop(mission.name).set(None)

    async def in_time(self, mission: Mission[Any], flow: Coroutine[Any, Any, Status]) -> Status:
        """Run a mission's flow once all that it comes after has completed, and its window has opened."""
        try:
            await self._may_begin(mission)
        except BaseException:
            flow.close()
            raise
        return await flow

    async def _may_begin(self, mission: Mission[Any]) -> None:
        while some := self._under_way(mission):
            one_more: Future[None] = Future()
            for name in some:
                self._ends.setdefault(name, Future()).watch(one_more.set)
            await one_more
        kernel, opens = self._core.kernel, mission.promises.get("opens", 0.0)
        if opens > kernel.now:
            key = mission_key(mission.index)
            await kernel.sleep(opens - kernel.now, EventKind.CLOCK, key)

    def _under_way(self, mission: Mission[Any]) -> list[str]:
        """Return the missions that it comes after and that have not ended; raise if one was in vain."""
        some = []
        for name in mission.promises.get("after", ()):
            state = self._states.get(name)
            if state is None:
                raise MissionFailed(f"it comes after mission {quoted(name)}, which there is not")
            if not state.ended:
                some.append(name)
            elif state.mission.status is not COMPLETED:
                became = state.mission.status.value
                raise MissionFailed(f"it comes after mission {quoted(name)}, which is {became}")
        return some
