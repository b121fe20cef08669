"""What a plan promises of missions: when they may begin, after which others, and by when they end.

As plain data: `deadline` and `opens` are moments, `after` the names of missions. A moment is a number, seconds
since the mission was started, or a text, a time of day; once it was started, seconds since the app was.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import MissionFailed
from ..domain.fields import time_of_day
from ..domain.status import COMPLETED
from ..domain.text import quoted
from ..time.future import Future
from ..time.kernel import EventKind, mission_key

if TYPE_CHECKING:
    from ..domain.model import Mission
    from ..domain.status import Status
    from .mission import Core, MissionState
    from .run import Run

Waits = Callable[[], None]  # called when a mission begins to wait for others


class Promises:
    """The promises of all missions of one running app."""

    def __init__(self, core: Core, states: dict[str, MissionState], waits: Waits) -> None:
        self._core, self._states, self._waits = core, states, waits
        self.waiting: dict[str, Future[str]] = {}
        """Of each mission that waits for others: set to which has ended, when it must look again."""
        self._waited_for: dict[str, list[str]] = {}

    def start(self, mission: Mission[Any]) -> None:
        """Fix a new mission's promises in seconds since the app started, and record them."""
        clock = self._core.kernel
        mission.promises = kept_from(mission.promises, clock.now, clock.time_of_day)
        if self._core.trace.live:
            self._core.trace.note("mission.promised", mission=mission.name, **mission.promises)
        self.watch(mission)

    def watch(self, mission: Mission[Any]) -> None:
        """Notice when a mission is late."""
        mission.deadline = deadline = mission.promises.get("deadline")
        kernel, key = self._core.kernel, mission_key(mission.index)
        if deadline is None or mission.late:
            return
        if deadline < kernel.now:
            self._look(mission)  # it passed while the app did not run
        else:  # what ends at that very instant has ended before
            kernel.at(deadline, EventKind.ALLOCATE, key, partial(self._look, mission))

    def _look(self, mission: Mission[Any]) -> None:
        if not (mission.late or self._states[mission.name].ended):
            mission.late = True
            if (trace := self._core.trace).live:
                trace.note("mission.late", mission=mission.name, deadline=mission.deadline)

    def ended(self, mission: Mission[Any]) -> None:
        """Called when a mission has ended, in any way; of one that did not complete all hear that wait for any."""
        self.waiting.pop(mission.name, None)
        some = [mission.name] if mission.status is COMPLETED else [*self._waited_for]
        for name in [name for one in some for name in self._waited_for.pop(one, ())]:
            if name in self.waiting:
                self.waiting.pop(name).set(mission.name)

    async def in_time(self, run: Run[Any]) -> Status:
        """Run a mission's flow once all that it comes after has completed, and its window has opened."""
        mission, names = run.mission, run.mission.promises.get("after", ())
        for name in names:
            self._refuse_vain(name)
        for name in names:
            while not self._states[name].ended:
                self._waited_for.setdefault(name, []).append(mission.name)
                self.waiting[mission.name] = must_look = Future[str]()
                self._waits()
                if (ended := await must_look) in names:
                    self._refuse_vain(ended)
            self._refuse_vain(name)
        kernel, opens = self._core.kernel, mission.promises.get("opens", 0.0)
        if opens > kernel.now:
            await kernel.sleep(opens - kernel.now, EventKind.CLOCK, mission_key(mission.index))
        return await self._core.app.flow(run)

    def _refuse_vain(self, name: str) -> None:
        """Raise if it would be in vain to come after a mission."""
        state = self._states.get(name)
        if state is None:
            raise MissionFailed(f"it comes after mission {quoted(name)}, which there is not")
        if state.ended and state.mission.status is not COMPLETED:
            became = state.mission.status.value
            raise MissionFailed(f"it comes after mission {quoted(name)}, which is {became}")


DAY = 86_400.0


def kept_from(promises: Mapping[str, Any], now: float, of_day: float) -> Mapping[str, Any]:
    """Return promises of a mission that starts now, at this time of day, in seconds since the app started.

    A window that is open now has opened, though that was earlier this day; one that closes now opens tomorrow.
    """
    deadline, opens = promises.get("deadline"), promises.get("opens")
    found: dict[str, Any] = {**promises}
    if deadline is not None:  # what is due at this hour is so tomorrow
        found["deadline"] = now + (_until(deadline, of_day) or DAY * isinstance(deadline, str))
    if opens is not None:
        found["opens"] = now + _until(opens, of_day)
    if isinstance(deadline, str) and isinstance(opens, str):
        found["opens"] = found["deadline"] - _until(deadline, time_of_day(opens))
    return found


def _until(moment: float | str, of_day: float) -> float:
    return (time_of_day(moment) - of_day) % DAY if isinstance(moment, str) else moment
