"""Blocks of other packages are held to what they declare: the checks of a graph rest on it."""

from __future__ import annotations

from ..domain.errors import MissionFailed
from ..domain.status import Status


def declared(block: str, status: object, statuses: tuple[Status, ...]) -> Status:
    """Return what a block has given; raise `MissionFailed` if it is none of what it declares."""
    for one in statuses:
        if status is one:
            return one
    given = status.value if isinstance(status, Status) else f"a {type(status).__name__}"
    listed = " or ".join(one.value for one in statuses) or "no status"
    raise MissionFailed(f"block {block} gave {given}, and it declares {listed}")
