"""Checks that a block of another package returns a status that it declares: the graph's checks rely on it."""

from __future__ import annotations

from ..domain.errors import MissionFailed
from ..domain.status import Status


def declared(block: str, status: object, statuses: tuple[Status, ...]) -> Status:
    """Return the status a block returned; raise `MissionFailed` if it does not declare it."""
    for one in statuses:
        if status is one:
            return one
    given = status.value if isinstance(status, Status) else f"a {type(status).__name__}"
    listed = " or ".join(one.value for one in statuses) or "no status"
    raise MissionFailed(f"block {block} gave {given}, and it declares {listed}")
