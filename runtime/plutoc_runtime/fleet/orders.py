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
        id, kinds = data["id"], {category.name: category for category in app.categories}
        category = kinds.get(data.get("category", app.categories[0].name))
        if category is None or id in self.drones:
            why = "category " + data["category"] if category is None else f"second drone {id}"
            raise BadInput(f"the fleet can have no {why}")
        x, y, *z = data["home"]
        home = x, y, z[0] if z else 0.0
        self.drones[id] = known = KnownState(self._clock, home, app.categories[0].motion)
        drone = Drone(
            id=id, category=category, home=home, telemetry=known, status=status, index=index
        )
        hand_to(_NOBODY, drone)
        return drone

    def take(self) -> list[Order]:
        """Return the orders that were given since the last call."""
        pending, self.pending = self.pending, []
        return pending

    # What is told

    def answered(self, message: Mapping[str, Any]) -> None:
        """Called when an order was `done` or has `failed`; an unknown or earlier one is ignored."""
        failed = "failed" in message
        order = message["failed"] if failed else message["done"]
        answer = self._answers.pop(order, None)
        if answer is not None:
            answer(failure_of(message) if failed else value_of(message.get("value")))

    # Flights

    def fly(self, drone: str, answer: Answer, flight: Order) -> None:
        """Order a flight: take off, fly to its stops and do its action; without one, arrive and hover."""
        self._flying[drone] = self._give(flight, answer)

    def attach(self, drone: str, answer: Answer, flight: str) -> None:
        """Order the report of a flight that began before an interruption."""
        order = {"do": "attach", "drone": drone, "flight": flight}
        self._flying[drone] = self._give(order, answer)

    def redirect(self, flight: Order) -> None:
        """Order a flight that is under way to other stops; its end is the answer to the order to fly."""
        self._give({**flight, "do": "redirect"})

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; nothing of its flight is answered any more."""
        self._answers.pop(self._flying.pop(drone, 0), None)
        self._give({"do": "break_off", "drone": drone})

    def settle(self, drone: str, flight: str, answer: Answer | None = None) -> None:
        """Stop a flight; what came of it is the answer to the order to fly."""
        settle = self._flying.get(drone)
        if settle is not None and answer is not None:
            self._answers[settle] = answer
        self._give({"do": "break_off", "drone": drone, "flight": flight, "settle": settle})

    # All else

    def give(self, do: str, drone: str, answer: Answer, **more: object) -> int:
        """Give an order, and call this with what came of it, unless it is forgotten; return its number."""
        return self._give({"do": do, "drone": drone, **more}, answer)

    def forget(self, number: int) -> None:
        """Want no answer to an order any more."""
        self._answers.pop(number, None)

    async def ask(self, do: str, drone: str, **more: object) -> Any:
        """Give an order, and return what came of it; raise `FlightFailed`. Cancelling this cancels the order."""
        outcome: Future[Any] = Future()
        number = self._give({"do": do, "drone": drone, **more}, outcome.set)
        try:
            result = await outcome
        finally:
            if not outcome.is_set:
                self._answers.pop(number, None)
                self._give({"do": "cancel", "drone": drone, "order": number})
        if isinstance(result, FlightFailed):
            raise result
        return result

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        self._give({"do": "mended", "drone": drone})

    def probed(self, drone: str, flight: str, answer: bool | None) -> None:
        """Order to note whether the action of a flight was done; None: the app cannot tell."""
        self._give({"do": "probed", "drone": drone, "flight": flight, "value": answer})

    def _give(self, order: Order, answer: Answer | None = None) -> int:
        self._count = order["id"] = number = self._count + 1
        if answer is not None:
            self._answers[number] = answer
        self.pending.append(order)
        return number


def failure_of(told: Mapping[str, Any]) -> FlightFailed:
    """Return the failure that a message tells."""
    failure = Failure.__members__.get(str(told.get("failure")), Failure.UNKNOWN)
    return FlightFailed(failure, str(told.get("reason", "")))
