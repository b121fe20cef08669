"""Steps of blocks that fail when asked to: `run` is the names of those that do."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from plutoc_runtime.domain.status import Status

Branch = Callable[[Any, Status], Coroutine[Any, Any, Status]]


class Failing(frozenset[str]):
    """In place of a run, the names of the blocks that fail on it."""

    at = None
    status = Status.UNEXECUTED


def hand_on(run: Any, status: Status, *, block: str) -> Status:
    """Go on with the status as it is."""
    return _go(run, block, status)


async def allocate(run: Any, status: Status, *, block: str) -> Status:
    """Go on with the status as it is, as a coroutine."""
    return _go(run, block, status)


def launch(run: Any, status: Status, *, block: str) -> Status:
    """Go on as RUNNING."""
    return _go(run, block, Status.RUNNING)


async def watch(run: Any, status: Status, *, block: str = "watch") -> Status:
    """End as COMPLETED; a block that only watches does not get its name."""
    return _go(run, block, Status.COMPLETED)


def limit(run: Any, *, block: str) -> None:
    """Add no limit to a wait."""
    _go(run, block, Status.RUNNING)


async def first(run: Any, status: Status, *branches: Branch) -> Status:
    """Close a fork; a gate does not get its name."""
    return await _close(run, branches, "first")


async def both(run: Any, status: Status, *branches: Branch) -> Status:
    """Close another fork."""
    return await _close(run, branches, "both")


async def _close(run: Any, branches: tuple[Branch, ...], block: str) -> Status:
    """Go through the branches of a fork, one after the other."""
    status = Status.RUNNING
    for branch in branches:
        status = await branch(run, Status.RUNNING)
    return _go(run, block, status)


def _go(run: Any, block: str, status: Status) -> Status:
    if block in run:
        raise ZeroDivisionError(block)
    return status
