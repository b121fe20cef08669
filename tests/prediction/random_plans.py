"""Random plans of `TOURS`: the same seed gives the same plans."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import hypot
from random import Random

from tests.prediction.plans import Plan, Rectangle, Stop, tour

Place = tuple[float, ...]

_KINDS = ("plain", "plain", "swift", "slow")
_FROM_WALLS, _FROM_EDGES, _HOMES, _APART = 0.7, 0.8, 0.8, 0.9
"""Metres from a wall to a target, from the map's edge, of the row of homes, and between two of them."""


def random_plans(number: int, seed: int) -> Iterator[Plan]:
    """Yield so many plans, each of which flies for some minutes."""
    for count in range(number):
        yield random_plan(f"random {seed}/{count}", Random(f"{seed}/{count}"))


def random_plan(name: str, chance: Random) -> Plan:
    """Return one plan of two to six drones, and of one mission or more for each."""
    size = width, depth = float(chance.randint(7, 14)), float(chance.randint(6, 10))
    walls = tuple(_walls(chance, width, depth))
    drones = chance.randint(2, 6)
    kinds = [*chance.choices(_KINDS, k=drones - 1), "plain"]  # which can do everything

    def somewhere() -> Place:
        while True:
            x = round(chance.uniform(_FROM_EDGES, width - _FROM_EDGES), 1)
            y = round(chance.uniform(2 * _HOMES, depth - _FROM_EDGES), 1)
            if all(_distance(x, y, wall) > _FROM_WALLS for wall in walls):
                return (x, y, 2.0) if chance.random() < 0.15 else (x, y)

    return tour(
        name,
        size=size,
        cruise=chance.choice((0.8, 1.0, 1.3, 1.6)),
        drones={(round(_HOMES + _APART * at, 1), _HOMES): kind for at, kind in enumerate(kinds)},
        missions={
            f"M{number}": tuple(_stops(chance, somewhere, f"item {number}"))
            for number in range(chance.randint(drones, drones + 2))
        },
        no_fly=walls,
        after_trip=chance.choice(("home", "home", "stay", "next")),
    )


def _stops(chance: Random, somewhere: Callable[[], Place], item: str) -> Iterator[Stop]:
    """Yield the trips of a mission: an item is carried, or one to three places are visited."""
    if chance.random() < 0.25:
        yield Stop(action="pick_item", at=somewhere(), item=item)
        yield Stop(action="release_item", at=somewhere(), item=item)
        return
    for _ in range(chance.randint(1, 3)):
        action = chance.choice(("measure", "take_photo", "take_photo", "inspect"))
        yield Stop(action=action, at=somewhere(), delay=chance.choice((0.0, 0.0, 0.0, 10.0)))


def _walls(chance: Random, width: float, depth: float) -> Iterator[Rectangle]:
    """Yield up to two walls in the middle of the map, around which there is room."""
    for share in chance.sample((0.35, 0.65), chance.randint(0, 2)):
        x, y = round(share * width, 1), round(0.4 * depth, 1)
        yield x, y, x + 0.2, round(y + chance.uniform(1.0, 0.35 * depth), 1)


def _distance(x: float, y: float, wall: Rectangle) -> float:
    """Return how far a place is from a wall."""
    west, south, east, north = wall
    return hypot(max(west - x, 0.0, x - east), max(south - y, 0.0, y - north))
