"""Narrow places, fleets that fly there, and how long each flight waits for others."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from pluto_fleet.shared.domain.airspace import Airspace, Polygon
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.traffic.real_skies import RealSky
from tests.library.gateway.traffic.skies import Sky

HEIGHT, SPEED = 1.2, 0.5
"""Metres; metres a second, of drones that fly as real ones do at the peak."""
STAYS = (0.0, 2.0, 10.0)
"""Seconds that a drone hovers at a target."""
A_DAY = 86_400.0


@dataclass(frozen=True, slots=True)
class Place:
    """A map, where docks are, and targets."""

    airspace: Airspace
    docks: Sequence[Point]
    targets: Sequence[Point]


@dataclass(frozen=True, slots=True)
class Trip:
    """What a drone is asked for after a pause: where to, how long it stays, and whether it returns."""

    pause: float
    target: Point
    stays: float
    returns: bool


@dataclass(slots=True)
class Flight:
    """One flight of a drone, out or home."""

    drone: str
    trip: int
    is_out: bool
    asked: float
    ended: float
    stays: float
    alone: float = 0.0
    """Seconds that it takes where no others are."""

    @property
    def waited(self) -> float:
        """Seconds that others have cost."""
        return self.ended - self.asked - self.alone


# Places


def _box(x: float, y: float, to_x: float, to_y: float) -> Polygon:
    return (x, y), (to_x, y), (to_x, to_y), (x, to_y)


def _rows(x: float, y: float, to_x: float, to_y: float, step: float, z: float = 0.0) -> list[Point]:
    across, along = int((to_x - x) / step + 1e-9) + 1, int((to_y - y) / step + 1e-9) + 1
    return [(x + i * step, y + j * step, z) for j in range(along) for i in range(across)]


def corridor(step: float, ceiling: float) -> Place:
    """Return two rooms, and between them a corridor as wide as one drone."""
    walls = _box(3, -1, 6, 1.3), _box(3, 1.7, 6, 4)
    docks, targets = [], []
    for x in (0.2, 6.3):
        docks += _rows(x, 0.2, x + 2.5, 2.8, step)
        targets += _rows(x + 0.1, 0.3, x + 2.3, 2.7, 0.8, HEIGHT)
    return Place(Airspace(size=(9, 3), ceiling=ceiling, no_fly=walls), docks, targets)


def rooms(step: float, ceiling: float) -> Place:
    """Return a corridor with the doors of six rooms on both sides."""
    walls = [_box(x - 0.1, y, x + 0.1, y + 2.6) for x in (3, 6) for y in (-1, 2.6)]
    docks, targets = [], _rows(0.5, 2.1, 8.5, 2.1, 2.0, HEIGHT)
    for x in (0, 3, 6):
        for y in (1.6, 2.4):
            walls += [_box(x, y, x + 1.3, y + 0.2), _box(x + 1.7, y, x + 3, y + 0.2)]
        for y in (0.1, 3.0):
            docks += _rows(x + 0.25, y, x + 2.65, y + 1.1, step)
            targets += _rows(x + 0.4, y + 0.2, x + 2.4, y + 1.0, 0.8, HEIGHT)
    return Place(Airspace(size=(9, 4.2), ceiling=ceiling, no_fly=tuple(walls)), docks, targets)


def gap(step: float, ceiling: float) -> Place:
    """Return a wall with one gap."""
    walls = _box(2.9, -1, 3.1, 1.8), _box(2.9, 2.2, 3.1, 5)
    docks, targets = [], []
    for x in (0.2, 3.5):
        docks += _rows(x, 0.2, x + 2.3, 3.8, step)
        targets += _rows(x + 0.2, 0.4, x + 2.1, 3.6, 0.8, HEIGHT)
    return Place(Airspace(size=(6, 4), ceiling=ceiling, no_fly=walls), docks, targets)


def rows(step: float, ceiling: float) -> Place:
    """Return docks in rows, and targets within a few metres."""
    docks, targets = _rows(0.2, 0.2, 4.8, 1.8, step), _rows(0.5, 2.0, 4.5, 4.5, 0.7, HEIGHT)
    return Place(Airspace(size=(5, 5), ceiling=ceiling), docks, targets)


def dead_end(step: float, ceiling: float) -> Place:
    """Return a room, and a corridor with most targets that leads nowhere else."""
    walls = _box(3.2, -1, 9, 1.3), _box(3.2, 1.7, 9, 4)
    targets = [(3.5 + 0.8 * i, 1.5, HEIGHT) for i in range(5)] + _rows(
        0.4, 0.4, 2.6, 0.4, 1.1, HEIGHT
    )
    docks = _rows(0.1, 0.2, 3.0, 2.8, step)
    return Place(Airspace(size=(7, 3), ceiling=ceiling, no_fly=walls), docks, targets)


PLACES: tuple[Callable[[float, float], Place], ...] = (corridor, rooms, gap, rows, dead_end)


# Flights


def _script(chance: Random, targets: Sequence[Point], stays: Sequence[float]) -> list[Trip]:
    count = chance.choice([1, 2, 3])
    return [
        Trip(
            chance.choice([0.0, 0.0, 1.0, 8.0]),
            chance.choice(targets),
            chance.choice(stays),
            number == count or chance.random() < 0.6,
        )
        for number in range(1, count + 1)
    ]


async def _flies(sky: Sky, drone: str, trips: Sequence[Trip], flights: list[Flight]) -> None:
    now = sky.kernel.time
    for number, trip in enumerate(trips):
        await sky.pause(trip.pause)
        asked = now()
        result = await sky.fly(drone, trip.target)
        assert result is None, result
        flights.append(Flight(drone, number, True, asked, now(), trip.stays))
        await sky.pause(trip.stays)
        if trip.returns:
            asked = now()
            await sky.commander.home(drone)
            flights.append(Flight(drone, number, False, asked, now(), 0.0))


def _sky(place: Place, docks: Sequence[Point], is_real: bool) -> Sky:
    if is_real:
        return RealSky(list(docks), {}, place.airspace, SPEED)
    return Sky([(x, y) for x, y, _ in docks], airspace=place.airspace)


def flown(
    kind: Callable[[float, float], Place],
    seed: int,
    drones: int,
    is_real: bool,
    stays: Sequence[float] = STAYS,
) -> tuple[list[Flight], Sky]:
    """Let so many drones fly in a place of that kind; return all flights, and the sky."""
    chance = Random(f"{kind.__name__} {seed} {drones}")
    place = kind(chance.choice([0.5, 0.6, 0.7]), chance.choice([1.3, 1.9, 2.6]))
    docks = chance.sample(place.docks, min(drones, len(place.docks)))
    targets = chance.sample(place.targets, min(len(place.targets), max(2, drones)))
    scripts = {f"cf{n + 1}": _script(chance, targets, stays) for n in range(len(docks))}

    alone: dict[tuple[str, int, bool], float] = {}
    for drone, trips in scripts.items():
        by_itself, _ = _all_flown(_sky(place, docks, is_real), {drone: trips})
        alone.update(
            ((one.drone, one.trip, one.is_out), one.ended - one.asked) for one in by_itself
        )
    flights, sky = _all_flown(_sky(place, docks, is_real), scripts)
    for one in flights:
        one.alone = alone[one.drone, one.trip, one.is_out]
    return flights, sky


def _all_flown(sky: Sky, scripts: Mapping[str, Sequence[Trip]]) -> tuple[list[Flight], Sky]:
    flights: list[Flight] = []
    tasks = [
        sky.kernel.spawn(_flies(sky, drone, trips, flights), FLEET + 100 + i, f"{drone} flies")
        for i, (drone, trips) in enumerate(scripts.items())
    ]
    for task in tasks:
        ended = sky.until(task, A_DAY) if len(tasks) > 1 else sky.kernel.run(task, A_DAY)
        assert ended, f"{task.name} for a day"
        task.result()
    sky.kernel.close()
    return flights, sky


# Who is before whom

IN_ITS_FIRST, EACH = 20.0, 10.0
"""Seconds: in its first ones others may cross a drone's way; and what each of those before it may need to
land where it does not wait in the way of others, and to take off there."""


def longest_wait(flight: Flight, flights: Sequence[Flight]) -> float:
    """Return how long a flight may wait: as long as those before it fly, stay and make room."""
    those = before(flight, flights)
    return sum(those) + IN_ITS_FIRST + EACH * len(those)


def before(flight: Flight, flights: Sequence[Flight]) -> list[float]:
    """Return, for each other drone that was there before, how long its trip takes where no others are.

    That is the flight that it was asked for last by then, if it is not home from it yet, how long it stays
    and its next flight, which makes room.
    """
    found = []
    for drone in {one.drone for one in flights} - {flight.drone}:
        its = [one for one in flights if one.drone == drone]
        asked = [one for one in its if one.asked <= flight.asked]
        if asked and (asked[-1].is_out or asked[-1].ended > flight.asked):
            following = its[len(asked) :][:1] if asked[-1].is_out else []
            found.append(asked[-1].alone + asked[-1].stays + sum(one.alone for one in following))
    return found
