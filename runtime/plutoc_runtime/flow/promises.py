"""What a plan promises of missions: when they may begin, after which others, and by when they end.

As plain data: `deadline` and `opens` are moments, `after` the names of missions. A moment is a number, seconds
since the mission was started, or a text, a time of day. Once it was started all are seconds since the app was; those
of which `hours` has the text are so by the clock, the others by the app's own time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from datetime import timedelta
from functools import partial
from math import inf, nextafter
from typing import TYPE_CHECKING, Any

from ..domain.errors import MissionFailed
from ..domain.fields import time_of_day
from ..domain.keeper import put, read_only
from ..domain.status import COMPLETED
from ..domain.text import quoted
from ..time.kernel import EventKind, Future, mission_key

if TYPE_CHECKING:
    from ..domain.model import Mission
    from ..domain.status import Status
    from ..time.hours import Hours
    from .mission import Core, MissionState
    from .run import Run

Waits = Callable[[], None]  # called when a mission begins to wait for others


class Promises:
    """The promises of all missions of one running app."""

    def __init__(self, core: Core, states: dict[str, MissionState], waits: Waits) -> None:
        self._core = core
        self._states = states
        self._waits = waits
        self.waiting: dict[str, Future[None]] = {}
        """Of each mission that waits for others: set when it must look again."""
        self._waited_for: dict[str, list[str]] = {}
        core.kernel.on_drift = self._watch_all

    def start(self, mission: Mission[Any]) -> None:
        """Fix a new mission's promises in seconds since the app started, and record them."""
        kernel = self._core.kernel
        promises = kept_from(mission.promises, kernel.hours, kernel.now, kernel.drift)
        put(mission, promises=read_only(promises))
        self._core.transitions.promise(mission)
        self.watch(mission)

    def watch(self, mission: Mission[Any]) -> None:
        """Notice when a mission is late."""
        deadline = moment_of(mission, "deadline", self._core.kernel.drift)
        put(mission, deadline=deadline)
        kernel = self._core.kernel
        if deadline is None or mission.late:
            return
        if deadline < kernel.now:
            self._look(mission)  # it passed while the app did not run
        else:  # what ends at that very instant has ended before
            look = partial(self._look, mission)
            kernel.at(deadline, EventKind.ALLOCATE, mission_key(mission.index), look)

    def _watch_all(self) -> None:
        """Called when the clock has moved: what is due at an hour is so at another time of the app."""
        for state in self._states.values():
            if state.mission.promises.get("hours") and not state.ended:
                self.watch(state.mission)

    def _look(self, mission: Mission[Any]) -> None:
        due = moment_of(mission, "deadline", self._core.kernel.drift)
        if due is not None and due > self._core.kernel.now:
            return  # the clock was set back
        if not (mission.late or self._states[mission.name].ended):
            put(mission, late=True)
            self._core.transitions.note("mission.late", mission, deadline=mission.deadline)

    def ended(self, mission: Mission[Any]) -> None:
        """Called when a mission has ended, in any way; of one that did not complete all hear that wait for any."""
        self.waiting.pop(mission.name, None)
        some = [mission.name] if mission.status is COMPLETED else [*self._waited_for]
        for name in [name for one in some for name in self._waited_for.pop(one, ())]:
            if name in self.waiting:
                self.waiting.pop(name).set(None)

    async def in_time(self, run: Run[Any]) -> Status:
        """Run a mission's flow once all that it comes after has completed, and its window has opened."""
        mission = run.mission
        names = mission.promises.get("after", ())
        while (name := self._first_open(names)) is not None:
            self._waited_for.setdefault(name, []).append(mission.name)
            self.waiting[mission.name] = must_look = Future[None]()
            self._waits()
            await must_look
        kernel = self._core.kernel

        def opens() -> float:
            return moment_of(mission, "opens", kernel.drift) or 0.0

        if opens() > kernel.now:
            await kernel.before(Future(), opens, EventKind.CLOCK, mission_key(mission.index))
        return await self._core.app.flow(run)

    def _first_open(self, names: Sequence[str]) -> str | None:
        """Return the first of these that has not ended; raise if it is in vain to come after one of them."""
        first = None
        for name in names:
            state = self._states.get(name)
            if state is None:
                raise MissionFailed(f"it comes after mission {quoted(name)}, which there is not")
            if not state.ended:
                first = first or name
            elif state.mission.status is not COMPLETED:
                became = state.mission.status.value
                raise MissionFailed(f"it comes after mission {quoted(name)}, which is {became}")
        return first


def moment_of(mission: Mission[Any], which: str, drift: float) -> float | None:
    """Return when its window `opens`, or its `deadline`, in the app's own time; None: it has none."""
    moment: float | None = mission.promises.get(which)
    by_hour = which in mission.promises.get("hours", ())
    return moment - drift if moment is not None and by_hour else moment


def kept_from(
    promises: Mapping[str, Any], hours: Hours, now: float = 0.0, drift: float = 0.0
) -> Mapping[str, Any]:
    """Return promises of a mission that starts now, in seconds since the app started.

    A window that is open now has opened, though that was earlier; what is due at this hour is so tomorrow. `drift`
    is by how much the clock of the hours is ahead of the app's own time.
    """
    found = {**promises}
    said = dict[str, str]()
    day = None
    for name in ("deadline", "opens"):
        moment = promises.get(name)
        if not isinstance(moment, str):
            if moment is not None:
                found[name] = now + moment
            continue
        said[name] = moment
        hour = time_of_day(moment)
        clock = now + drift
        if name == "deadline":
            clock = nextafter(clock, inf)
        if day is not None:  # of a window that closes on that day
            day -= (hour >= time_of_day(said["deadline"])) * timedelta(days=1)
        else:
            day = hours.day(hour, clock)
        found[name] = hours.on(day, hour)
    return {**found, "hours": said} if said else found
