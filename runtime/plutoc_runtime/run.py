"""A mission on its way through its graph, as the blocks' steps get it."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .context import Context
from .errors import ActionFailed, HookFault, MissionFailed
from .hooks import call_hook, hook_name, trace_of
from .model import Mission
from .status import Status

if TYPE_CHECKING:
    from .core import Core
    from .kernel import Key, Task
    from .state import State

M = TypeVar("M", bound=Mission[Any])

Way = Coroutine[Any, Any, Status]


class Run(Generic[M]):
    """One mission, or one branch of it, and everything that a step may use."""

    __slots__ = ("core", "key", "mission", "state")

    def __init__(self, mission: M, core: Core, state: State, key: Key) -> None:
        self.mission, self.core, self.state, self.key = mission, core, state, key

    async def hook(self, hook: Callable[..., object], *args: object) -> object:
        """Call a hook of the app's with these arguments; its faults end the mission."""
        if self.state.goes_round(self.core.kernel.now):
            raise MissionFailed(
                f"it goes round in its graph for ever without time passing, by hook {hook_name(hook)}"
            )
        try:
            return await self._called(hook, args)
        except HookFault as fault:
            self.core.log(fault.detail, self.mission.name)
            raise

    async def _called(self, hook: Callable[..., object], args: Sequence[object]) -> object:
        try:
            return await call_hook(self.core.kernel, hook, *args)
        except ActionFailed as error:
            reason = (
                f"hook {hook_name(hook)} raised ActionFailed, which only an action may: {error}"
            )
            raise HookFault(reason, trace_of(error)) from error

    @property
    def context(self) -> Context:
        """What a hook gets of it."""
        return Context(self.core, self.state)

    def fork(
        self, status: Status, branches: Sequence[Callable[[Run[M], Status], Way]]
    ) -> list[Task[Status]]:
        """Send a clone of the mission into each branch; the gate that calls this closes them."""
        return [
            self.core.kernel.spawn(
                branch(Run(self.mission, self.core, self.state, (*self.key, number)), status),
                (*self.key, number),
                f"{self.mission.name}: branch {number + 1}",
            )
            for number, branch in enumerate(branches)
        ]


Branch = Callable[[Run[M], Status], Way]
"""One way through a fork; it gives the status with which its clone arrives at the gate."""
