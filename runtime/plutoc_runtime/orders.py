"""What the brain says shall be done: commands for drones become orders, and what is told of them is their answer.

An order is a mapping with an `id`, what to `do`, and the `drone`. The orders: `fly` a trip's flight, `attach`
(report the end of a flight that began before an interruption), `break_off` (with `settle`, report then what
came of the flight of that order), `hold` (hover), `read` and `write` (a value of a hovering drone), `home`,
`land`, `recover`, `mended` (a person has repaired it), `probed` (note whether a flight's action was done),
and `cancel` (another `order`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from .domain.errors import Failure, FlightFailed
from .fleet.telemetry import KnownState
from .hooks.values import item_data, value_of
from .time.future import Future

if TYPE_CHECKING:
    from .domain.fleet_data import DroneData
    from .domain.trace import Clock
    from .trips.flight import Flight

Order = dict[str, Any]
Answer = Callable[[object], object]
"""Called with what came of an order: its value, or a `FlightFailed`."""


class Orders:
    """The `Navigation` of a brain that does no input and no output."""

    def __init__(self, clock: Clock, drones: Mapping[str, DroneData]) -> None:
        self.pending: list[Order] = []
        """The orders that have not been taken yet."""
        self.drones = {drone: KnownState(clock, data.home) for drone, data in drones.items()}
        self._answers: dict[int, Answer] = {}
        """What to call with the outcome of each order that is under way, by its id."""
        self._flying: dict[str, int] = {}
        """The latest order to fly of each drone."""
        self._count = 0

    def take(self) -> list[Order]:
        """Return the orders that were given since the last call."""
        pending = self.pending[:]
        self.pending.clear()
        return pending

    # What is told

    def done(self, order: int, value: object) -> None:
        """Called when an order was carried out; one that is not known, or was answered, is ignored."""
        answer = self._answers.pop(order, None)
        if answer is not None:
            answer(value_of(value))

    def failed(self, order: int, why: Mapping[str, Any]) -> None:
        """Called when an order failed, with the `failure` and the `reason`."""
        answer = self._answers.pop(order, None)
        if answer is not None:
            failure = Failure.__members__.get(str(why.get("failure")), Failure.UNKNOWN)
            answer(FlightFailed(failure, str(why.get("reason", ""))))

    # The navigation protocol

    def telemetry(self, drone: str) -> KnownState:
        """Return a drone's telemetry, which is always current."""
        return self.drones[drone]

    def fly(self, flight: Flight, report: Answer) -> None:
        """Order a flight."""
        order = self._give("fly", flight.flier.id, report)
        order["flight"], order["stops"], order["seconds"] = flight.id, flight.stops, flight.seconds
        order["action"], order["parameters"] = flight.action, flight.parameters
        order["item"] = item_data(flight.item)
        self._flying[flight.flier.id] = order["id"]

    def attach(self, flight: Flight, report: Answer) -> None:
        """Order the report of a flight that began before an interruption."""
        order = self._give("attach", flight.flier.id, report)
        order["flight"] = flight.id
        self._flying[flight.flier.id] = order["id"]

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self._answers.pop(self._flying.pop(drone, 0), None)
        self._give("break_off", drone, None)

    def settle(self, flight: Flight) -> None:
        """Stop a flight; what came of it is the answer to the order to fly."""
        order = self._give("break_off", flight.flier.id, None)
        order["settle"], order["flight"] = self._flying.get(flight.flier.id), flight.id

    def probed(self, drone: str, flight: str, answer: bool | None) -> None:
        """Order to note whether the action of a flight was done; None: the app cannot tell."""
        order = self._give("probed", drone, None)
        order["flight"], order["value"] = flight, answer

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone."""
        self._give("mended", drone, None)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._ask("hold", drone)

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable of a drone."""
        return float(await self._ask("read", drone, name=name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone."""
        await self._ask("write", drone, name=name, value=value)

    async def home(self, drone: str) -> None:
        """Fly to its dock, and land there."""
        await self._ask("home", drone)

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._ask("land", drone)

    async def recover(self, drone: str) -> str | None:
        """Bring a drone home after a failed flight, landed; else return why it is lost."""
        home = await self._ask("recover", drone)
        return None if home is True else str(home or "")

    def _give(self, do: str, drone: str, answer: Answer | None) -> Order:
        self._count = number = self._count + 1
        if answer is not None:
            self._answers[number] = answer
        order: Order = {"id": number, "do": do, "drone": drone}
        self.pending.append(order)
        return order

    async def _ask(self, do: str, drone: str, **more: object) -> Any:
        """Give an order, and wait for its outcome; cancelling this cancels the order."""
        outcome: Future[Any] = Future()
        order = self._give(do, drone, outcome.set)
        order.update(more)
        try:
            result = await outcome
        finally:
            if not outcome.is_set:
                self._answers.pop(order["id"], None)
                self._give("cancel", drone, None)["order"] = order["id"]
        if isinstance(result, FlightFailed):
            raise result
        return result
