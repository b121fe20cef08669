"""What a drone answers when it is asked where it is and how it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .model import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """What one drone answers when the roll is called."""

    drone: str
    reached: bool
    """Whether it answered at all; if not, the rest is what was known of it last."""
    location: Point
    landed: bool
    battery_level: float
    boot: int
    """Another number than before: it was switched off in between, and has forgotten."""
    carrying: str | None
    """The name of the item aboard."""
    done: Mapping[str, object] | None
    """The jobs whose action it did since it was switched on, with what that gave.

    None: this kind of drone cannot tell.
    """
    problems: tuple[str, ...] = ()
    """Why it may not fly now, a sentence each."""
