"""What is picked must be released: the order of a mission's trips with items."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from plutoc_runtime.domain.actions import PICK, RELEASE

from . import errors

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Item, Trip

    from .table import Table


def check_items(trips: Sequence[tuple[Trip, Table]]) -> None:
    """Tell every pick without a release, release without a pick, and second item aboard."""
    aboard: tuple[Item, Trip, Table] | None = None
    for trip, table in trips:
        if trip.item is None:
            if trip.action in (PICK, RELEASE):
                return  # its item could not be read: what comes after it would only be guessed at
            continue
        if trip.action == PICK:
            if aboard is not None:
                carried, since, _ = aboard
                table.problem(
                    errors.carries_already(trip.item.name, carried.name, since.name), "item"
                )
            aboard = trip.item, trip, table
        elif trip.action == RELEASE:
            problem = _release(trip.item, aboard)
            if problem is not None:
                table.problem(problem, "item")
            aboard = None
    if aboard is not None:
        item, _, table = aboard
        table.problem(errors.never_released(item.name), "item")


def _release(item: Item, aboard: tuple[Item, Trip, Table] | None) -> str | None:
    if aboard is None:
        return errors.never_picked(item.name)
    carried, since, _ = aboard
    if carried.name != item.name:
        return errors.other_item(item.name, carried.name, since.name)
    if carried.mass != item.mass:
        return errors.other_mass(item.name, since.name)
    return None
