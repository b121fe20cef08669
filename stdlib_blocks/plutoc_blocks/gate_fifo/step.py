"""What a GateFIFO does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.time.kernel import Future

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.flow.run import Branch, Run
    from plutoc_runtime.time.kernel import Task


async def pass_first(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """Send a clone into every branch; go on as the first that arrives."""
    first: Future[Task[Status]] = Future()
    clones = run.fork(status, branches)
    for clone in clones:
        clone.watch(first.set)
    try:
        return (await first).result()
    finally:
        for clone in clones:
            clone.cancel()
