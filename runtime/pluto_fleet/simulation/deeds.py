"""What drones do to their world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.model import Item


@dataclass(frozen=True, slots=True, kw_only=True)
class Deed:
    """Something that a drone does to the world, or sees of it."""

    drone: str
    action: str
    item: Item | None
    job: str | None
    """For which it was done."""
    boot: int
    """The drone's."""
    value: object
    """What it gave."""
    aboard: Item | None
    """What the drone carries afterwards."""
