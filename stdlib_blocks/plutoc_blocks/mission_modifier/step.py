"""What a MissionModifier does."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import Cancelled
from plutoc_runtime.flow.asking import ask
from plutoc_runtime.flow.modification import context_of, settle, undeclared

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Run


async def modify_mission(
    run: Run[Any],
    status: Status,
    *,
    hook: Callable[..., object],
    emits: tuple[Status, ...] = (),
) -> Status:
    """Call the hook, and go on with the status that it returns."""
    try:
        returned = await ask(run, hook, run.mission, context_of(run), edits=True)
    except Cancelled as off:  # another branch was faster
        if off.returned is not None and (wrong := undeclared(hook, emits, off.returned)):
            run.core.log(wrong, run.mission.name)
        raise
    return await settle(run, hook, status, emits, returned)
