"""A gateway over a small simulated team, jobs for it, and a brain's ears."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.jobs.flown import Flown
from pluto_fleet.jobs.link import Link, Message, Order
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.actions import BUILT_IN, Plain
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.domain.model import Category, Item, Point
from pluto_fleet.shared.events.world import MovingWorld
from pluto_fleet.shared.fleet.orders import failure_of
from pluto_fleet.shared.hooks.plain_data import item_data, value_of
from pluto_fleet.shared.time.kernel import FLEET, Future
from pluto_fleet.shared.time.told import VirtualTime
from pluto_fleet.simulation.drones import SimulatedNavigation

SCOUT = Category(name="scout", speed=0.5, flight_time=420, charge_time=1200)
PILLS = Item(name="pills", mass=0.004)
THERE = (4.0, 5.0, 1.2)
"""From cf1's home at (1, 1): 4 s up, 10 s there; then the action."""


@dataclass(slots=True, kw_only=True)
class Task:
    """A job, and how a brain orders it."""

    id: str = "North field/A/0/1"
    drone: str = "cf1"
    stops: tuple[Point, ...] = (THERE,)
    action: str | None = "pick_item"
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    item: Item | None = PILLS
    beside: bool = False

    def order(self, number: int) -> Order:
        """Return the order to fly it."""
        return {
            "do": "fly",
            "id": number,
            "drone": self.drone,
            "flight": self.id,
            "stops": self.stops,
            "action": self.action,
            "parameters": self.parameters,
            "item": item_data(self.item),
            "seconds": 0.0 if self.action is None else BUILT_IN[self.action].seconds,
            "beside": self.beside,
        }


class Commander:
    """A brain behind a link: it gives orders, and listens to what comes of each."""

    def __init__(self, link: Link) -> None:
        self.link = link
        self.telemetry = link.telemetry
        self.fleet_report = link.fleet_report
        self.drone_report = link.drone_report
        self.bring_down = link.bring_down
        self.flown: list[Flown] = []
        """What was told of commands that drones have flown."""
        self._reports: dict[int, Callable[[object], object]] = {}
        self._count = 0
        link.hear = self._hear

    def _hear(self, message: Message) -> None:
        if "flown" in message:
            self.flown.append(message["flown"])
        else:
            number = message.get("done", message.get("failed"))
            report = self._reports.pop(int(str(number)))
            failed = "failed" in message
            report(failure_of(message) if failed else value_of(message["value"]))

    def _expect(self, report: Callable[[object], object]) -> int:
        self._count += 1
        self._reports[self._count] = report
        return self._count

    def fly(self, job: Task, report: Callable[[object], object]) -> None:
        self.link.send(job.order(self._expect(report)))

    def attach(self, id: str, report: Callable[[object], object]) -> None:
        self.link.send({"do": "attach", "id": self._expect(report), "flight": id})

    def break_off(self, drone: str) -> None:
        self.link.send({"do": "break_off", "drone": drone})

    def mended(self, drone: str) -> None:
        self.link.send({"do": "mended", "drone": drone})

    def forget(self, id: str) -> None:
        self.link.send({"do": "forget", "flight": id})

    def heartbeat(self) -> None:
        self.link.send({"do": "heartbeat"})

    async def ask(self, do: str, drone: str, **more: object) -> Any:
        """Give an order, and return what came of it; a cancellation cancels it."""
        over: Future[Any] = Future()
        number = self._expect(over.set)
        self.link.send({"do": do, "id": number, "drone": drone, **more})
        try:
            result = await over
        finally:
            if not over.is_set:
                self.link.send({"do": "cancel", "order": number})
        if isinstance(result, FlightFailed):
            raise result
        return result

    async def hold(self, drone: str) -> None:
        await self.ask("hold", drone)

    async def home(self, drone: str) -> None:
        await self.ask("home", drone)

    async def land(self, drone: str) -> None:
        await self.ask("land", drone)

    async def recover(self, drone: str) -> bool:
        return await self.ask("recover", drone) is True

    async def goes(self, drone: str, target: Point) -> None:
        """Fly to a point, with nothing to do there."""
        over: Future[object] = Future()
        job = Task(
            id=f"{drone}/{self._count}", drone=drone, stops=(target,), action=None, item=None
        )
        self.fly(job, over.set)
        result = await over
        if isinstance(result, FlightFailed):
            raise result


class Field:
    """A kernel, a world with drones in it, and gateways that come and go."""

    def __init__(
        self,
        *,
        airspace: Airspace | None = None,
        faults: Faults | None = None,
        homes: Sequence[tuple[float, float]] = ((1, 1), (2, 1), (3, 1)),
        category: Category = SCOUT,
        ledger: Ledger | None = None,
        **options: Any,
    ) -> None:
        self.airspace = airspace or Airspace()
        self.kernel = VirtualTime()
        self.drones = [
            FleetDrone(id=f"cf{i + 1}", category=category, home=(x, y, 0.0), index=i)
            for i, (x, y) in enumerate(homes)
        ]
        world = MovingWorld(1, self.airspace)
        self.deeds: list[str] = []
        """The flights whose actions the drones have done."""
        self.navigation = SimulatedNavigation(
            self.kernel,
            self.drones,
            world,
            faults or Faults(),
            1,
            lambda deed: self.deeds.append(str(deed.job)),
        )
        self.ledger = ledger or Ledger()
        self.options = options
        """What each gateway is given besides."""
        self.gateway = self.another()

    def another(self) -> Gateway:
        """Return another gateway over the same drones, with the same ledger."""
        self.gateway = Gateway(
            self.kernel,
            self.navigation,
            self.drones,
            self.airspace,
            ledger=self.ledger,
            **self.options,
        )
        return self.gateway

    def link(self, epoch: int, lost: Callable[[], object] | None = None) -> Commander:
        """Put a brain in command."""
        return Commander(self.gateway.link(epoch, lost))

    def advance(self, seconds: float) -> None:
        self.kernel.run(self.kernel.spawn(self.kernel.sleep(seconds), FLEET, "time passes"))
