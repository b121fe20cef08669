"""How drones are flown: the protocol between the fleet and whatever moves the drones (thesis 4.4).

Metres, seconds. Each command returns when it is done: on arrival, when landed. It raises
`FlightFailed` when the drone cannot finish it. A command that is cancelled leaves the drone
hovering where it is. The protocol knows no missions: an `Order` only tells one flight from another.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from .actions import Plain
    from .model import Item, Point, Telemetry


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """The flight that a take-off begins. The same flight has the same id in every run."""

    id: str
    """`mission/trip/round/attempt`."""
    seconds: float
    """How long the flight is expected to take until its action is done."""


class Navigation(Protocol):
    """A team of drones that can be flown, by their ids."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        ...

    async def takeoff(self, drone: str, height: float, order: Order | None) -> None:
        """Rise to a height; does nothing for a drone that flies. No order: on the way home."""
        ...

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        ...

    async def act(
        self, drone: str, action: str, parameters: Mapping[str, Plain], item: Item | None
    ) -> object:
        """Do one of the built-in actions here, and return what came of it."""
        ...

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        ...

    async def land(self, drone: str) -> None:
        """Land here."""
        ...

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it is lost."""
        ...
