"""Rules of a plan that no value breaks alone: homes apart, and items picked and released in turn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist
from typing import TYPE_CHECKING

from .actions import PICK, RELEASE
from .text import quoted

if TYPE_CHECKING:
    from .model import Item, Point, Trip

HOME_SIZE = 0.1
"""The diameter of a drone on the ground, in metres."""

Cells = dict[tuple[int, int], list[tuple["Point", str]]]
"""Homes and their drones, by squares of the map with sides of that length."""


def crowded(home: Point, drone: str, homes: Cells) -> str | None:
    """Add a home to the others; return what is wrong if it is too near to one of them."""
    x, y = int(home[0] // HOME_SIZE), int(home[1] // HOME_SIZE)
    around = [homes.get((x + i, y + j), []) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    near = [other for cell in around for at, other in cell if dist(home, at) < HOME_SIZE]
    homes.setdefault((x, y), []).append((home, drone))
    if not near:
        return None
    return f"home is where drone {quoted(near[0])} has its own: each needs a place to stand"


def wrongly_carried(trips: Sequence[Trip]) -> Iterator[tuple[int, str]]:
    """Yield each pick without a release, release without a pick, and second item aboard.

    With the index of its trip.
    """
    aboard: tuple[int, Trip, Item] | None = None
    for index, trip in enumerate(trips):
        if trip.action not in (PICK, RELEASE):
            continue
        if trip.item is None:
            return  # it is invalid: errors after it would be guesses
        item = quoted(trip.item.name)
        _, since, carried = aboard or (index, trip, None)
        if trip.action == PICK and carried is not None:
            name = quoted(carried.name)
            yield index, f"picks {item}, but {name} is still aboard since trip {since.name}"
        elif trip.action == RELEASE and carried is None:
            yield index, f"releases {item}, which no trip before it has picked"
        elif trip.action == RELEASE and carried is not None and carried != trip.item:
            other = f"releases {item}, but trip {since.name} picked {quoted(carried.name)}"
            same = f"{item} has another mass here than in trip {since.name}"
            yield index, same if carried.name == trip.item.name else other
        aboard = (index, trip, trip.item) if trip.action == PICK else None
    if aboard is not None:
        index, _, carried = aboard
        yield index, f"picks {quoted(carried.name)}, which no trip after it releases"
