"""The event that an action is done beside its target, where another drone has the place."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..jobs.flown import ACTS_BESIDE

if TYPE_CHECKING:
    from ..jobs.flown import Flown
    from ..shared.brain import Brain


def acts_beside(brain: Brain, told: Flown) -> dict[str, Any] | None:
    """Return the event for what a gateway tells; None: the flight is no mission's any more."""
    for mission, stands in brain.whereabouts().items():
        head = f"{mission}/"
        flight = str(told["flight"])
        if stands["flies"] and stands["drone"] == told["drone"] and flight.startswith(head):
            trip, round_, attempt = flight.removeprefix(head).rsplit("/", 2)
            return {
                "event": ACTS_BESIDE,
                "mission": mission,
                "trip": trip,
                "drone": told["drone"],
                "round": int(round_),
                "attempt": int(attempt),
                "target": told["target"],
                "at": told["at"],
            }
    return None
