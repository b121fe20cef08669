"""What a GateFunnel does."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.status import WORST_FIRST, Status
from plutoc_runtime.time.kernel import Future

if TYPE_CHECKING:
    from plutoc_runtime.flow.run import Branch, Run
    from plutoc_runtime.time.kernel import Task


async def wait_for_all(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """Send a clone into every branch; go on when all have arrived, with the worst status.

    What goes wrong in one branch is not kept waiting for the others.
    """
    clones = run.fork(status, branches)
    over: Future[None] = Future()
    for clone in clones:
        clone.watch(partial(_arrived, clones, over))
    try:
        await over
        arrived = {clone.result() for clone in clones}
    finally:
        for clone in clones:
            clone.cancel()
    return min(arrived, key=WORST_FIRST.index)


def _arrived(clones: Sequence[Task[Status]], over: Future[None], clone: Task[Status]) -> None:
    if clone.error is not None:
        over.fail(clone.error)
    elif all(other.is_set for other in clones):
        over.set(None)
