"""A small team over a small map, and how to fly it in a test."""

from __future__ import annotations

from collections.abc import Coroutine
from typing import Any, TypeVar

from pluto_fleet.gateway.executor import Executor
from pluto_fleet.jobs.controls import FleetDrone, TakeOff
from pluto_fleet.shared.alone.world import Faults, draw
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.events.world import MovingWorld
from pluto_fleet.shared.time.kernel import FLEET, Kernel
from pluto_fleet.shared.time.told import VirtualTime
from pluto_fleet.simulation.drones import SimulatedNavigation

T = TypeVar("T")

Flight = tuple[str, float]
"""Its id, and the seconds that it is expected to take."""

SCOUT = Category(name="scout", speed=0.5, flight_time=420, charge_time=1200)
HOME = (1.0, 1.0, 0.0)
CLIMB = 4.0  # seconds to the cruise height of 1.2 m
PLAIN = Airspace()


class Team(SimulatedNavigation):
    """The same, with what a gateway adds: flights begin, and drones are brought home."""

    def __init__(
        self,
        kernel: Kernel,
        drones: list[FleetDrone],
        faults: Faults,
        seed: int,
        space: Airspace,
    ) -> None:
        super().__init__(kernel, drones, MovingWorld(seed, space), faults, seed)
        self.kernel, self.faults, self.seed, self.space = kernel, faults, seed, space
        self.drones = drones

    async def takes_off(self, drone: str, height: float, order: Flight | None) -> None:
        drawn = draw(self.faults, self.seed, *order) if order else {}
        self.bodies[drone].begin(order and order[0], drawn)
        await self.do(drone, TakeOff(height))

    async def recover(self, drone: str) -> bool:
        return await Executor(self.kernel, self, self.drones, self.space).recover(drone)


def team(
    kernel: Kernel,
    faults: Faults | None = None,
    *,
    airspace: Airspace = PLAIN,
    seed: int = 1,
    battery_level: float = 1.0,
    category: Category = SCOUT,
) -> Team:
    """Two drones, cf1 at (1, 1) and cf2 beside it."""
    drones = [
        FleetDrone(
            id=f"cf{i + 1}",
            category=category,
            home=(HOME[0] + i, HOME[1], 0.0),
            index=i,
        )
        for i in range(2)
    ]
    made = Team(kernel, drones, faults or Faults(), seed, airspace)
    for drone in drones:
        made.bodies[drone.id].stand(drone.home, battery_level)
    return made


def fly(kernel: VirtualTime, coroutine: Coroutine[Any, Any, T]) -> T:
    """Run one coroutine to its end in virtual time."""
    task = kernel.spawn(coroutine, FLEET, "test")
    task.watch(lambda _: None)
    kernel.run(task)
    return task.result()


def at_home(faults: Faults | None = None, **given: Any) -> tuple[VirtualTime, Team]:
    kernel = VirtualTime()
    return kernel, team(kernel, faults, **given)


def hovering(faults: Faults | None = None, **given: Any) -> tuple[VirtualTime, Team]:
    """Return the same, with cf1 at its cruise height above its home, on its flight."""
    kernel, navigation = at_home(faults, **given)
    fly(kernel, navigation.takes_off("cf1", 1.2, order()))
    return kernel, navigation


def failure(kernel: VirtualTime, coroutine: Coroutine[Any, Any, object]) -> FlightFailed:
    """Run a coroutine that must fail, and return how."""
    try:
        fly(kernel, coroutine)
    except FlightFailed as error:
        return error
    raise AssertionError("the flight went well")


def order(name: str = "North field/A/0/1", seconds: float = 15.0) -> Flight:
    """Return the id and the seconds of a flight; to (4, 5) and a photo take 15 s from home."""
    return name, seconds
