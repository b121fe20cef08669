"""Which pieces of two courses come too near to each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from plutoc_runtime.domain.geometry import between

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .courses import Course, Leg

Near = tuple[int, int, int]
"""A piece of the first course; pieces of the second, from one to another."""


def near(one: Course, other: Course, limit: float) -> list[Near]:
    """Return the pieces of two courses that come nearer to each other than that, by their numbers."""
    found: list[Near] = []
    for mine in one.legs:
        low, high = mine.box[:3], mine.box[3:]
        x, y, z = low[0] - limit, low[1] - limit, low[2] - limit
        most_x, most_y, most_z = high[0] + limit, high[1] + limit, high[2] + limit
        for its in other.legs:
            box = its.box
            if (
                box[0] < most_x
                and box[3] > x
                and box[1] < most_y
                and box[4] > y
                and box[2] < most_z
                and box[5] > z
                and between(mine.start, mine.end, its.start, its.end) < limit
            ):
                found += _near_pieces(one, mine, other, its, limit)
    return found


def _near_pieces(one: Course, mine: Leg, other: Course, its: Leg, limit: float) -> Iterator[Near]:
    """Yield those of two legs. They are straight: what is near is in one part of each."""
    was_near = False
    for i in range(mine.first, mine.last):
        a = one.pieces[i]
        if between(a.start, a.end, its.start, its.end) < limit:
            was_near = True
            first = last = -1
            for j in range(its.first, its.last):
                b = other.pieces[j]
                if between(a.start, a.end, b.start, b.end) < limit:
                    first, last = (j if first < 0 else first), j
                elif first >= 0:
                    break
            if first >= 0:
                yield i, first, last
        elif was_near:
            break


def near_place(one: Course, place: Point, limit: float) -> list[int]:
    """Return the pieces of a course that come nearer to a place than that."""
    return [
        index
        for leg in one.legs
        if between(leg.start, leg.end, place, place) < limit
        for index in range(leg.first, leg.last)
        if between(one.pieces[index].start, one.pieces[index].end, place, place) < limit
    ]
