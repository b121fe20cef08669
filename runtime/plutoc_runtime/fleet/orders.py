"""What the brain says shall be done: orders for drones, and what is told of them.

An order is a mapping with an `id`, what to `do`, and the `drone`: `fly` a trip's flight, `attach` (report the
end of a flight that began before an interruption), `break_off` (with `settle`, report then what came of the
flight of that order), `hold` (hover), `read` and `write` (a value of a hovering drone), `home`, `land`,
`recover`, `mended` (a person has repaired it), `probed` (note whether a flight's action was done), and
`cancel` (another `order`). Metres, seconds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput, Failure, FlightFailed
from ..domain.keeper import Keeper, hand_to
from ..domain.model import Drone
from ..hooks.plain_data import value_of
from ..time.kernel import Future
from .telemetry import KnownState

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.status import DroneStatus
    from ..domain.trace import Clock

_NOBODY = Keeper()  # who lets no hook write anything

Order = dict[str, Any]
Answer = Callable[[object], object]
"""Called with what came of an order: its value, or a `FlightFailed`."""


class Orders:
    """The orders of one brain. A cancelled command leaves its drone hovering where it is."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.pending: list[Order] = []
        """The orders that have not been taken yet; the kernel looks into this very list while it runs."""
        self.drones: dict[str, KnownState] = {}
        """What was told of the drones, by their ids; always current."""
        self._answers: dict[int, Answer] = {}
        """What to call with the outcome of each order that is under way, by its id."""
        self._flying: dict[str, int] = {}  # the latest order to fly of each drone
        self._count = 0

    def drone_of(self, app: App, data: Mapping[str, Any], status: DroneStatus, index: int) -> Drone:
        """Return a drone of the fleet, of which nothing has been told yet."""
        id = data["id"]
        kinds = {category.name: category for category in app.categories}
        category = kinds.get(data.get("category", app.categories[0].name))
        if category is None or id in self.drones:
            why = "category " + data["category"] if category is None else f"second drone {id}"
            raise BadInput(f"the fleet can have no {why}")
        x, y, *z = data["home"]
        home = (x, y, z[0] if z else 0.0)
        known = KnownState(self._clock, home, app.categories[0].motion)
        self.drones[id] = known
        drone = Drone(
            id=id, category=category, home=home, telemetry=known, status=status, index=index
        )
        hand_to(_NOBODY, drone)
        return drone

    def take(self) -> list[Order]:
        """Return the orders that were given since the last call."""
        pending = self.pending
        self.pending = []
        return pending

    # What is told

    def answered(self, message: Mapping[str, Any]) -> None:
        """Called when an order was `done` or has `failed`; an unknown or earlier one is ignored."""
        failed = "failed" in message
        answer = self._answers.pop(message["failed" if failed else "done"], None)
        if answer is not None:
            answer(failure_of(message) if failed else value_of(message.get("value")))

    # Flights

    def fly(self, drone: str, answer: Answer, flight: Order) -> None:
        """Order a flight, or attach to one: its end is the answer."""
        self._flying[drone] = self.give(flight, answer)

    def redirect(self, flight: Order) -> None:
        """Order a flight that is under way to other stops; its end is the answer to the order to fly."""
        self.give({**flight, "do": "redirect"})

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; nothing of its flight is answered any more."""
        self._answers.pop(self._flying.pop(drone, 0), None)
        self.give({"do": "break_off", "drone": drone})

    def settle(self, drone: str, flight: str, answer: Answer | None = None) -> None:
        """Stop a flight; what came of it is the answer to the order to fly."""
        order = self._flying.get(drone)
        if order is not None and answer is not None:
            self._answers[order] = answer
        self.give({"do": "break_off", "drone": drone, "flight": flight, "settle": order})

    # All else

    def forget(self, number: int) -> None:
        """Want no answer to an order any more."""
        self._answers.pop(number, None)

    def call_off(self, number: int, drone: str) -> None:
        """Cancel an order, unless it was answered."""
        if self._answers.pop(number, None) is not None:
            self.give({"do": "cancel", "drone": drone, "order": number})

    async def ask(self, do: str, drone: str, **more: object) -> Any:
        """Give an order, and return what came of it; raise `FlightFailed`. Cancelling this cancels the order."""
        outcome: Future[Any] = Future()
        number = self.give({"do": do, "drone": drone, **more}, outcome.set)
        try:
            result = await outcome
        finally:
            self.call_off(number, drone)
        if isinstance(result, FlightFailed):
            raise result
        return result

    def give(self, order: Order, answer: Answer | None = None) -> int:
        """Give an order, and return its id."""
        self._count += 1
        order["id"] = self._count
        if answer is not None:
            self._answers[self._count] = answer
        self.pending.append(order)
        return self._count


def failure_of(told: Mapping[str, Any]) -> FlightFailed:
    """Return the failure that a message tells."""
    failure = Failure.__members__.get(str(told.get("failure")), Failure.UNKNOWN)
    return FlightFailed(failure, str(told.get("reason", "")))
