"""A running mission, as the blocks' steps get it."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ..domain.errors import MissionFailed
from ..domain.keeper import current_of
from ..domain.model import Mission
from ..domain.status import UNEXECUTED, Status
from ..time.kernel import branch_key

if TYPE_CHECKING:
    from ..time.kernel import Key, Task
    from .flight import Flight, Limit
    from .mission import MissionState

M = TypeVar("M", bound=Mission[Any])

Way = Coroutine[Any, Any, Status]


class Run(Generic[M]):
    """One mission, or one branch of it, and everything that a step may use."""

    __slots__ = ("_depth", "at", "core", "key", "mission", "state", "status", "task")

    def __init__(self, mission: M, state: MissionState, key: Key, depth: int = 0) -> None:
        self.mission = mission
        self.state = state
        self.core = state.core
        self.key = key
        self.task: Task[Status] | None = None  # the coroutine of this branch
        self.at: str | None = None
        """The block at which an interrupted mission resumes; None: it begins."""
        self.status = UNEXECUTED  # its status when it begins, or resumes
        self._depth = depth

    def meets(self, block: str) -> None:
        """Note a block that waits or allocates: here the mission can resume after an interruption.

        Not within a fork, and not with a drone allocated: an interruption takes both away.
        """
        if self._depth:
            return
        state = self.state
        state.block = block
        if state.allocated is None and state.at != block and block in self.core.app.resumes:
            state.at = block
            self.core.changes.mission(self.mission.name)

    @property
    def trip(self) -> Any:
        """The mission's trip in flight, or the next one; of the app's own class."""
        return current_of(self.mission)

    def fork(
        self, status: Status, branches: Sequence[Callable[[Run[M], Status], Way]]
    ) -> list[Task[Status]]:
        """Start a task for each branch of a fork; the gate that calls this ends them."""
        clones: list[Task[Status]] = []
        depth = self._depth + 1
        for number, branch in enumerate(branches):
            key = branch_key(self.key, number, depth)
            run = Run(self.mission, self.state, key, depth)
            name = f"{self.mission.name}: branch {number + 1}"
            run.task = self.core.kernel.spawn(branch(run, status), key, name)
            clones.append(run.task)
        return clones


Branch = Callable[[Run[M], Status], Way]
"""A branch of a fork; it returns the status with which it arrives at the gate."""


def watch(run: Run[Any], *limits: Limit | None) -> Flight:
    """Return the flight, to be awaited: it gives the mission's status at its end.

    A limit fails the trip; a trip that ends at that very instant has ended first. A limit is void
    once the branch that set it has ended.
    """
    flight = run.state.flight
    if flight is None:
        raise RuntimeError(f"mission {run.mission.name} has no flight to watch")
    for number, limit in enumerate(limits, 1):
        if limit is not None:
            limit.flight = flight
            limit.branch = run.task
            limit.key = run.key + number
            limit.abort = run.state.abort
            run.core.limits.add(limit)
    return flight


def declared(block: str, status: object, statuses: tuple[Status, ...]) -> Status:
    """Return the status that a block of another package gave; raise `MissionFailed` if it does not declare it."""
    if isinstance(status, Status) and status in statuses:
        return status
    given = status.value if isinstance(status, Status) else f"a {type(status).__name__}"
    listed = " or ".join(one.value for one in statuses) or "no status"
    raise MissionFailed(f"block {block} gave {given}, and it declares {listed}")
