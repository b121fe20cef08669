"""A gateway over a small simulated team, jobs for it, and a brain's ears."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.actions import BUILT_IN, Plain
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Item, Point
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.shared.time.virtual import VirtualTime
from pluto_fleet.simulation.body import SimulatedDrone
from pluto_fleet.simulation.drones import SimulatedNavigation

SCOUT = Category(name="scout", speed=0.5, flight_time=420, charge_time=1200)
PILLS = Item(name="pills", mass=0.004)
THERE = (4.0, 5.0, 1.2)
"""From cf1's home at (1, 1): 4 s up, 10 s there; then the action."""


@dataclass(slots=True, kw_only=True)
class Task:
    """A job as the brain gives it."""

    id: str = "North field/A/0/1"
    drone: str = "cf1"
    stops: tuple[Point, ...] = (THERE,)
    action: str | None = "pick_item"
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    item: Item | None = PILLS
    beside: bool = False
    begun: int = 0

    @property
    def seconds(self) -> float:
        """How long the action is expected to take."""
        return 0.0 if self.action is None else BUILT_IN[self.action].seconds

    def begins(self) -> None:
        self.begun += 1


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
            SimulatedDrone(id=f"cf{i + 1}", category=category, home=(x, y, 0.0), index=i)
            for i, (x, y) in enumerate(homes)
        ]
        world = World(1, self.airspace)
        self.navigation = SimulatedNavigation(
            self.kernel, self.drones, world, faults or Faults(), 1, self.airspace
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

    def advance(self, seconds: float) -> None:
        self.kernel.run(self.kernel.spawn(self.kernel.sleep(seconds), FLEET, "time passes"))
