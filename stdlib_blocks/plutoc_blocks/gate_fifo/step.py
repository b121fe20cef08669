"""What a GateFIFO does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plutoc_runtime.signals import Signal

if TYPE_CHECKING:
    from plutoc_runtime.kernel import Task
    from plutoc_runtime.run import Branch, Run
    from plutoc_runtime.status import Status


async def pass_first(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """Send a clone into every branch; go on as the first that arrives."""
    first: Signal[Task[Status]] = Signal()
    clones = run.fork(status, branches)
    for clone in clones:
        clone.watch(first.set)
    try:
        return (await first).result()
    finally:
        for clone in clones:
            clone.cancel()
