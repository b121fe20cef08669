"""A way cut into short pieces, each with the time when its drone should be there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, dist, sqrt
from typing import TYPE_CHECKING

from ...energy import CLIMB_SPEED
from ...geometry import between
from .claims import Box, box_of
from .detours import Section

if TYPE_CHECKING:
    from ...model import Point

PIECE = 0.5
"""Metres: where two ways come near each other, one drone waits until another has left a piece."""
_BESIDE = 3.0
"""Seconds that a drone rather waits than land beside where it is."""
_AT_LEAST = 1.0
"""Seconds that a leg takes from rest to rest, however short."""
_PUSH, _MOST = 7.52, 4.0
"""On such a leg: the peak acceleration over distance and squared time; metres per second squared
that it usually may be. Speeds are mean ones already: see `files.real`."""
_BLURRED = 0.05
"""Metres: so exactly is it known where a drone is."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a way that is flown without looking; times are seconds after the departure."""

    start: Point
    end: Point
    enters: float
    leaves: float


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight part of a way: pieces from one number up to another."""

    first: int
    last: int
    start: Point
    end: Point
    box: Box


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A section, in pieces. The first piece is where the drone is until it departs."""

    section: Section
    pieces: tuple[Piece, ...]
    legs: tuple[Leg, ...]
    """The first is no leg, but the start."""
    seconds: float
    cost: float
    """The same, and more for what nobody likes."""

    def piece_at(self, place: Point, first: int, last: int) -> int:
        """Return in which of these pieces a drone is; where it may be in two, in the first."""
        far = [
            between(place, place, piece.start, piece.end) for piece in self.pieces[first : last + 1]
        ]
        near = min(far) + _BLURRED
        return first + next(index for index, metres in enumerate(far) if metres <= near)

    def stretch(self, here: Point, stands: bool, first: int, last: int) -> Section:
        """Return the section from here, where one piece ends or soon after, to another's end."""
        ends = {leg.last - 1 for leg in self.legs}
        points = [
            piece.end
            for index, piece in enumerate(self.pieces[: last + 1])
            if index > first and (index in ends or index == last)
        ]
        return Section(
            self.section.drone,
            (here, *points),
            stands,
            self.section.lands and last == len(self.pieces) - 1,
        )


def course(section: Section, speed: float, from_rest: bool) -> Course:
    """Cut a section into pieces; `from_rest`: each leg begins and ends at rest, as real ones do."""
    first = section.points[0]
    pieces, now = [Piece(first, first, 0.0, 0.0)], 0.0
    legs = [Leg(0, 1, first, first, (*first, *first))]
    last = len(section.points) - 2
    for number, (a, b) in enumerate(pairwise(section.points)):
        length = dist(a, b)
        slow = (number == 0 and section.stands) or (number == last and section.lands)
        lasts = seconds(length, CLIMB_SPEED if slow else speed, from_rest)
        count = max(1, ceil(length / PIECE - 1e-9))
        legs.append(Leg(len(pieces), len(pieces) + count, a, b, box_of((a, b))))
        at = a
        for part in range(1, count + 1):
            to = b if part == count else _between(a, b, part / count)
            until = now + lasts / count
            pieces.append(Piece(at, to, now, until))
            at, now = to, until
    beside = dist(first[:2], section.points[-1][:2]) if section.aside else 0.0
    cost = now + _BESIDE + 2 * beside if beside else now
    return Course(section, tuple(pieces), tuple(legs), now, cost)


def seconds(length: float, speed: float, from_rest: bool) -> float:
    """Return how long a leg lasts."""
    if not from_rest:
        return length / speed
    return max(_AT_LEAST, length / speed, sqrt(_PUSH * length / _MOST))


def _between(a: Point, b: Point, part: float) -> Point:
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])


def near(one: Course, other: Course, limit: float) -> list[tuple[int, int]]:
    """Return the pieces of two courses that come too near to each other, by their numbers."""
    found: list[tuple[int, int]] = []
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


def _near_pieces(
    one: Course, mine: Leg, other: Course, its: Leg, limit: float
) -> Iterator[tuple[int, int]]:
    for i in range(mine.first, mine.last):
        a = one.pieces[i]
        if between(a.start, a.end, its.start, its.end) < limit:
            for j in range(its.first, its.last):
                b = other.pieces[j]
                if between(a.start, a.end, b.start, b.end) < limit:
                    yield i, j


def near_start(one: Course, place: Point, limit: float) -> list[int]:
    """Return the pieces of a course that come too near to a place."""
    return [
        index
        for leg in one.legs
        if between(leg.start, leg.end, place, place) < limit
        for index in range(leg.first, leg.last)
        if between(one.pieces[index].start, one.pieces[index].end, place, place) < limit
    ]
