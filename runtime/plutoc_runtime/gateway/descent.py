"""How all drones come down at once: where they are, or each at home, apart from one another.

Who goes home does so even if it stands somewhere else; what it carries comes along.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import floor
from typing import TYPE_CHECKING, Any, Protocol

from ..energy import CLIMB_SPEED, docked, length, share
from ..errors import FlightFailed
from ..geometry import distance
from ..kernel import FLEET, Kernel, Task
from ..standing import Down
from .spots import free_spot

if TYPE_CHECKING:
    from ..airspace import Airspace
    from ..model import Category, Point
    from .controls import Controls

_Command = Callable[[], Coroutine[Any, Any, None]]


class Craft(Protocol):
    """What must be known of a drone."""

    @property
    def id(self) -> str:
        """Its name in the fleet."""
        ...

    @property
    def category(self) -> Category:
        """How fast it flies, and for how long."""
        ...

    @property
    def home(self) -> Point:
        """Where its dock is."""
        ...

    @property
    def index(self) -> int:
        """Its place in the fleet file."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """A drone's way home, at a height of its own."""

    drone: Craft
    height: float
    points: tuple[Point, ...]
    """From where it is now; the last is above its home."""

    def is_clear_of(self, place: Point, apart: float) -> bool:
        """Say whether it leads nowhere near a place."""
        return all(
            distance(place[:2], a[:2], b[:2]) >= apart
            for a, b in pairwise((self.points[0], *self.points))
        )


class Descent:
    """Brings down every drone that flies. One that cannot follow keeps no other up."""

    def __init__(
        self,
        kernel: Kernel,
        navigation: Controls,
        drones: Sequence[Craft],
        airspace: Airspace,
        apart: float,
    ) -> None:
        self._kernel, self._navigation, self._airspace = kernel, navigation, airspace
        self._drones, self._apart = drones, apart
        self._tasks: list[Task[bool]] = []

    async def down(self, how: Down) -> None:
        """Bring them down; whoever cancels this leaves them hovering."""
        try:
            await (self._land() if how is Down.LAND else self._fly_home())
        finally:
            for task in self._tasks:
                task.cancel()

    async def _land(self) -> None:
        for task in self._landings(self._flying()):
            await task

    def _landings(self, drones: Sequence[Craft]) -> list[Task[bool]]:
        """Land drones where they are, or beside it where they may not; the lowest choose first."""
        taken = [self._location(drone) for drone in self._drones if self._is_landed(drone)]
        tasks = []
        for drone in drones:
            here = self._location(drone)
            spot = free_spot(self._airspace, here, taken, self._apart)
            taken.append(spot)
            there = (spot[0], spot[1], here[2])
            tasks.append(self._send(drone, partial(self._land_at, drone, there)))
        return tasks

    async def _land_at(self, drone: Craft, place: Point) -> None:
        if self._location(drone) != place:
            await self._navigation.go_to(drone.id, place)
        await self._navigation.land(drone.id)

    async def _fly_home(self) -> None:
        """Let drones fly home, each at a height of its own; as many at once as there are heights."""
        drones = [*self._strays(), *self._flying()]
        lowest = self._airspace.cruise_height
        heights = 1 + max(0, floor((self._airspace.ceiling - lowest) / self._apart + 1e-9))
        for first in range(0, len(drones), heights):
            stay, ways = self._ways(drones[first : first + heights], lowest)
            landing = self._landings(stay)
            climbing = [(way, self._send(way.drone, partial(self._climb, way))) for way in ways]
            up = [way for way, task in climbing if await task]
            for task in landing:
                await task
            tasks: dict[_Way, Task[bool]] = {}
            for way in up:
                below = [(other, tasks[other]) for other in tasks]
                tasks[way] = self._send(way.drone, partial(self._follow, way, below))
            for task in tasks.values():
                await task

    def _ways(self, drones: Sequence[Craft], lowest: float) -> tuple[list[Craft], list[_Way]]:
        """Return who had better land here, and the ways home of all others, the lowest first."""
        stay: list[Craft] = []
        ways: list[_Way] = []
        for drone in drones:
            height = lowest + len(ways) * self._apart
            x, y, z = self._location(drone)
            route = self._airspace.route((x, y, height), (drone.home[0], drone.home[1], height))
            if docked((x, y, z), drone.home) or route is None:
                if not self._is_landed(drone):
                    stay.append(drone)
                continue
            way = _Way(drone, height, ((x, y, height), *route))
            climbs = abs(height - z) + height
            seconds = climbs / CLIMB_SPEED + length(way.points[0], route) / drone.category.speed
            level = self._navigation.telemetry(drone.id).battery_level
            if share(drone.category, seconds) < level:
                ways.append(way)
            elif not self._is_landed(drone):
                stay.append(drone)
        return stay, ways

    async def _climb(self, way: _Way) -> None:
        """Rise, or sink, to the way's height: who is above another now, stays so."""
        if self._is_landed(way.drone):
            self._navigation.begins(way.drone.id, None, 0.0)
            await self._navigation.takeoff(way.drone.id, way.height)
        await self._navigation.go_to(way.drone.id, way.points[0])

    async def _follow(self, way: _Way, below: Sequence[tuple[_Way, Task[bool]]]) -> None:
        """Fly home; then come down through the heights of others once they are out of the way."""
        for point in way.points[1:]:
            await self._navigation.go_to(way.drone.id, point)
        for other, task in below:
            if not other.is_clear_of(way.drone.home, self._apart):
                await task
        await self._navigation.land(way.drone.id)

    def _send(self, drone: Craft, command: _Command) -> Task[bool]:
        key = FLEET + 1 + drone.index
        task = self._kernel.spawn(_well(command), key, f"{drone.id} comes down")
        self._tasks.append(task)
        return task

    def _strays(self) -> list[Craft]:
        """Return who stands on the ground, but not at home."""
        return [
            drone
            for drone in self._drones
            if self._is_landed(drone) and not docked(self._location(drone), drone.home)
        ]

    def _flying(self) -> list[Craft]:
        """Return who flies, the lowest first."""
        flying = [drone for drone in self._drones if not self._is_landed(drone)]
        return sorted(flying, key=lambda drone: (self._location(drone)[2], drone.index))

    def _location(self, drone: Craft) -> Point:
        return self._navigation.telemetry(drone.id).location

    def _is_landed(self, drone: Craft) -> bool:
        return self._navigation.telemetry(drone.id).landed


async def _well(command: _Command) -> bool:
    """Say whether a drone could do it; whatever keeps it, it keeps no other."""
    try:
        await command()
    except FlightFailed:
        return False
    return True
