"""How one of several drones is chosen: the shape of every allocation policy."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .errors import HookFault
from .hooks import hook_name, said, trace_of

if TYPE_CHECKING:
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


Policy = Callable[[Iterable[Offer]], Iterable[Decision]]
"""Shares free drones out among trips of equal priority; a trip without a decision waits.

The offers come one by one: each has the drones that are left after the decisions so far.
"""

Chooser = Callable[["Trip", Sequence["Drone"]], tuple["Drone", str]]


def one_by_one(offers: Iterable[Offer], choose: Chooser) -> Iterator[Decision]:
    """Serve the trips in their order, each from the drones that are left."""
    for offer in offers:
        drone, why = choose(offer.trip, offer.candidates)
        yield Decision(offer=offer, drone=drone, why=why)


def own_policy(hook: Callable[[Any, Sequence[Drone]], Drone | None]) -> Policy:
    """Make a policy of the app's own hook: it is asked trip by trip."""
    return OwnPolicy(hook)


@dataclass(frozen=True, slots=True)
class OwnPolicy:
    """A policy of the app's own. Two that ask the same hook are equal."""

    hook: Callable[[Any, Sequence[Drone]], Drone | None]

    def __call__(self, offers: Iterable[Offer]) -> Iterator[Decision]:
        """Ask the hook for each trip in turn."""
        name = hook_name(self.hook)
        for offer in offers:
            try:
                drone = self._answer(name, offer.trip, offer.candidates)
            except HookFault as fault:
                yield Decision(offer=offer, fault=fault)
            else:
                if drone is not None:
                    yield Decision(offer=offer, drone=drone, why=f"chosen by {name}")

    def _answer(self, name: str, trip: Trip, left: tuple[Drone, ...]) -> Drone | None:
        try:
            drone = self.hook(trip, left)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise HookFault(f"policy {name} raised {said(error)}", trace_of(error)) from error
        if drone is not None and drone not in left:
            raise HookFault(
                f"policy {name} must return one of the candidates or None, not {drone!r}"
            )
        return drone
