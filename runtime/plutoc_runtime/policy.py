"""How one of several drones is chosen: the shape of every allocation policy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from .errors import HookFault
from .hooks import hook_name, trace_of
from .model import Drone, Trip


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Offer:
    """A trip that waits, and the free drones that could fly it now, in the fleet's order."""

    trip: Trip
    candidates: tuple[Drone, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Decision:
    """The drone that gets a trip, and why it was chosen."""

    offer: Offer
    drone: Drone | None = None
    why: str = ""
    fault: HookFault | None = None


Policy = Callable[[Sequence[Offer]], Sequence[Decision]]
"""Shares free drones out among trips of equal priority; a trip without a decision waits."""

Chooser = Callable[[Trip, Sequence[Drone]], "tuple[Drone, str] | None"]


def one_by_one(offers: Sequence[Offer], choose: Chooser) -> list[Decision]:
    """Serve the trips in their order, each from the drones that are left."""
    taken: set[Drone] = set()
    decisions = []
    for offer in offers:
        left = [drone for drone in offer.candidates if drone not in taken]
        chosen = choose(offer.trip, left) if left else None
        if chosen is not None:
            taken.add(chosen[0])
            decisions.append(Decision(offer=offer, drone=chosen[0], why=chosen[1]))
    return decisions


def own_policy(hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> Policy:
    """Make a policy of the app's own hook: it is asked trip by trip."""
    return OwnPolicy(hook)


@dataclass(frozen=True, slots=True)
class OwnPolicy:
    """A policy of the app's own. Two that ask the same hook are equal."""

    hook: Callable[[Any, Sequence[Drone]], Drone | None]

    def __call__(self, offers: Sequence[Offer]) -> list[Decision]:
        """Ask the hook for each trip in turn."""
        taken: set[Drone] = set()
        decisions = []
        for offer in offers:
            left = tuple(drone for drone in offer.candidates if drone not in taken)
            decision = self._ask(offer, left) if left else None
            if decision is not None:
                decisions.append(decision)
                taken.update((decision.drone,) if decision.drone else ())
        return decisions

    def _ask(self, offer: Offer, left: tuple[Drone, ...]) -> Decision | None:
        name = hook_name(self.hook)
        try:
            drone = self._answer(name, offer.trip, left)
        except HookFault as fault:
            return Decision(offer=offer, fault=fault)
        return Decision(offer=offer, drone=drone, why=f"chosen by {name}") if drone else None

    def _answer(self, name: str, trip: Trip, left: tuple[Drone, ...]) -> Drone | None:
        try:
            drone = self.hook(trip, left)
        except Exception as error:
            raise HookFault(
                f"policy {name} raised {type(error).__name__}: {error}", trace_of(error)
            ) from error
        if drone is not None and drone not in left:
            raise HookFault(
                f"policy {name} must return one of the candidates or None, not {drone!r}"
            )
        return drone
