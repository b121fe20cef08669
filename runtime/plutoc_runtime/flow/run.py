"""A mission on its way through its graph, as the blocks' steps get it."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ..domain.errors import ANY_ERROR, MissionFailed
from ..domain.guard import NOT_ITS_OWN
from ..domain.model import Mission
from ..domain.status import UNEXECUTED, Status
from ..hooks.calls import ProtectedFacts, changed, fault_of, hook_name, look
from ..time.kernel import branch_key
from .mission import MOST_CALLS, MissionState

if TYPE_CHECKING:
    from ..time.kernel import Key, Task
    from ..trips.deadlines import Limit
    from ..trips.flight import Flight

M = TypeVar("M", bound=Mission[Any])

Way = Coroutine[Any, Any, Status]


class Run(Generic[M]):
    """One mission, or one branch of it, and everything that a step may use."""

    __slots__ = ("_depth", "at", "core", "key", "mission", "state", "status", "task")

    def __init__(self, mission: M, state: MissionState, key: Key, depth: int = 0) -> None:
        self.mission, self.state, self.key, self._depth = mission, state, key, depth
        self.core = state.core
        self.task: Task[Status] | None = None
        """The coroutine of this branch."""
        self.at: str | None = None
        """The block at which a mission that was interrupted goes on; None: it begins."""
        self.status = UNEXECUTED
        """How it stands when it begins, or goes on."""

    def meets(self, block: str) -> None:
        """A block that waits or allocates: the mission can go on here when it is interrupted.

        Not within a fork, and not with a drone in hand: an interruption takes both away.
        """
        state = self.state
        if not self._depth and state.allocated is None and block in self.core.app.resumes:
            state.at = block

    async def hook(self, hook: Callable[..., object], *args: object) -> object:
        """Call a hook of the app's with these arguments; its faults end the mission."""
        if self.state.calls_too_often():
            raise MissionFailed(
                f"it goes round in its graph for ever: its hooks were called {MOST_CALLS:,} times "
                f"since its last launch, and now {hook_name(hook)} again"
            )
        mission, flying = self.mission, self.state.in_flight
        name, index = mission.name, mission.index
        held = None if flying is None else ProtectedFacts(flying.trip, "name", "action")
        try:
            answer = await self.core.kernel.call_hook(hook, *args)
        except NOT_ITS_OWN:
            raise
        except ANY_ERROR as error:
            raise fault_of(hook, error) from error
        finally:
            known = mission.name is name and mission.index is index
            if not known:
                mission.name, mission.index = name, index
            fact = held and held.put_back()
        if not known:
            raise changed(hook, "mission", "name or index")
        if fact:
            raise changed(hook, "trip", fact)
        if self.core.recorder is not None:
            look(hook, self.core.recorder.look, self.mission)
        return answer

    @property
    def trip(self) -> Any:
        """The mission's trip that flies now, or flies next: of the app's own class."""
        trips = self.mission.trips
        return trips[0] if trips else self.mission.current

    def abort(self, reason: str) -> None:
        """Fail the trip that flies now."""
        self.state.abort(reason)

    def fork(
        self, status: Status, branches: Sequence[Callable[[Run[M], Status], Way]]
    ) -> list[Task[Status]]:
        """Send a clone of the mission into each branch; the gate that calls this closes them."""
        return [self._branch(status, branch, number) for number, branch in enumerate(branches)]

    def _branch(
        self, status: Status, branch: Callable[[Run[M], Status], Way], number: int
    ) -> Task[Status]:
        depth = self._depth + 1
        key = branch_key(self.key, number, depth)
        run = Run(self.mission, self.state, key, depth)
        name = f"{self.mission.name}: branch {number + 1}"
        run.task = self.core.kernel.spawn(branch(run, status), key, name)
        return run.task


def watch(run: Run[Any], *limits: Limit | None) -> Flight:
    """Return the flight, to be awaited: its end is how the mission stands then.

    A limit fails the trip; a trip that ends at that very instant has ended first. Nothing is watched
    any longer once the branch that asked for it is over.
    """
    core, flight = run.core, run.state.flight
    if flight is None:
        raise RuntimeError(f"mission {run.mission.name} has no flight to watch")
    for number, limit in enumerate(limits, 1):
        if limit is not None:
            limit.set(core.kernel, core.limits, run, flight, number)
    return flight


Branch = Callable[[Run[M], Status], Way]
"""One way through a fork; it gives the status with which its clone arrives at the gate."""
