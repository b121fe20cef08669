"""Flights that a second drone takes over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .run import Run


def relieve_at(run: Run[Any], level: float) -> None:
    """Have the flight of this moment taken over once its battery holds only the way home and this.

    No drone takes over yet: the flight ends as it would without.
    """
