"""What a GateFunnel does."""

from __future__ import annotations

from typing import Any

from plutoc_runtime.run import Branch, Run
from plutoc_runtime.status import WORST_FIRST, Status


async def wait_for_all(run: Run[Any], status: Status, *branches: Branch[Any]) -> Status:
    """Send a clone into every branch; go on when all have arrived, with the worst status."""
    clones = run.fork(status, branches)
    try:
        arrived = {await clone.done for clone in clones}
    finally:
        for clone in clones:
            clone.cancel()
    return min(arrived, key=WORST_FIRST.index)
