"""Courses: routes cut into pieces, with resting places, times, and which pieces come too near to another."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from math import ceil, dist
from typing import TYPE_CHECKING

from ...shared.domain.motion import MOST, PEAK, PUSH, SHORTEST, smoothly
from .legs import between
from .reservations import Box, box_of, part_way
from .ways import Section

if TYPE_CHECKING:
    from ...shared.domain.model import Point
    from ...shared.domain.motion import Motion


PIECE, SHORT = 0.5, 0.2
"""The length of pieces in metres: a drone waits until another has left a piece near its course. Where
real drones land they are shorter."""
_BESIDE = 3.0
"""Seconds that a drone prefers to wait rather than land beside its place."""
_BLURRED = 0.05
"""The accuracy of a drone's position, in metres."""
_RESTS = 30
"""The approximate maximum number of resting places on a course."""
_LOWEST = 0.3
"""Metres of height below which no drone rests on the way."""
_SMOOTHLY = [smoothly(n / 100) for n in range(101)]
"""The share of a smooth leg that a drone has flown after each hundredth of its time."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a course, the unit in which space is occupied."""

    start: Point
    end: Point


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight part of a course: a range of pieces."""

    first: int
    last: int
    start: Point
    end: Point
    box: Box

    @property
    def piece(self) -> float:
        """The length of its pieces in metres."""
        return dist(self.start, self.end) / (self.last - self.first)


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A section, in pieces. The first piece is where the drone is until it departs."""

    section: Section
    pieces: tuple[Piece, ...]
    legs: tuple[Leg, ...]
    """The first is no leg, but the start."""
    speed: float
    motion: Motion
    seconds: float = field(init=False)
    """Its duration without rests."""
    cost: float = field(init=False)
    """Its duration, plus penalties for what is to be avoided."""
    rests: tuple[int, ...] = field(init=False)
    """The pieces at whose ends a drone may rest without much delay, with the first and the last."""
    _least: dict[int, float] = field(init=False, default_factory=dict, repr=False)
    _times: dict[tuple[int, int], tuple[float, ...]] = field(
        init=False, default_factory=dict, repr=False
    )

    def __post_init__(self) -> None:
        # Frozen, yet all of this follows from its legs.
        lasts = self.times(0, len(self.pieces) - 1)[-1]
        start, end = self.pieces[0].start, self.pieces[-1].end
        beside = dist(start[:2], end[:2]) if self.section.aside else 0.0
        object.__setattr__(self, "seconds", lasts)
        object.__setattr__(self, "cost", lasts + _BESIDE + 2 * beside if beside else lasts)
        object.__setattr__(self, "rests", tuple(sorted({*self._places()})))

    def _places(self) -> Iterator[int]:
        """Yield resting places: ends of legs, points on long ones, and points low above the ground."""
        end = len(self.pieces) - 1
        yield from (0, end)
        hop = max(PIECE, sum(dist(leg.start, leg.end) for leg in self.legs) / _RESTS)
        if self.motion.smooth:  # on a shorter one it is not the speed that counts
            mean = self.speed / PEAK
            hop = max(hop, SHORTEST * mean, PUSH / MOST * mean**2)
        for leg in self.legs[1:]:
            count = leg.last - leg.first
            if self.section.lands and leg.last > end:
                high = (i for i in range(leg.first, end) if self.pieces[i].end[2] >= _LOWEST)
                yield from [*high][::-2]
            else:
                hops = max(1, int(count * leg.piece / hop))
                yield from (leg.first - 1 + round(count * n / hops) for n in range(1, hops + 1))

    @property
    def least(self) -> dict[int, float]:
        """The least remaining duration from each resting place."""
        least, places = self._least, self.rests
        if not least:
            least[places[-1]] = 0.0
            for number in range(len(places) - 2, -1, -1):
                here = places[number]
                least[here] = min(
                    self.times(here, there)[-1] + least[there]
                    for there in places[number + 1 : number + 3]
                )
        return least

    def times(self, first: int, last: int) -> tuple[float, ...]:
        """Return when a drone that departs from the end of a piece has left that piece, and those that follow.

        The last time is that of its arrival at the end of the last piece.
        """
        times = self._times.get((first, last))
        if times is None:
            times = self._times[first, last] = tuple(self._worked_out(first, last))
        return times

    def _worked_out(self, first: int, last: int) -> Iterator[float]:
        now, end, motion = 0.0, len(self.pieces) - 1, self.motion
        for leg in self.legs[1:]:
            begins, ends = max(leg.first, first + 1), min(leg.last - 1, last)
            if begins > ends:
                continue
            metres = leg.piece * (ends - begins + 1)
            rises = self.section.stands and first == 0 and leg.first == 1
            sinks = self.section.lands and last == end and leg.last > end
            flies = motion.climb if rises else motion.sink if sinks else motion.leg
            lasts = flies(metres, self.speed)
            now += motion.take_off if rises else 0.0
            for part in range(ends - begins + 1):
                yield now + lasts * self._share(part * leg.piece + _BLURRED, metres)
            now += lasts + motion.settles
        yield now

    def _share(self, metres: float, of: float) -> float:
        """Return the share of a leg's time after which a drone has flown this share of it."""
        part = min(1.0, metres / of) if of else 1.0
        return bisect_left(_SMOOTHLY, part) / 100 if self.motion.smooth else part

    def piece_at(self, place: Point, first: int, last: int) -> int:
        """Return the piece in which a drone is; the first, if it may be in two."""
        far = [
            between(place, place, piece.start, piece.end) for piece in self.pieces[first : last + 1]
        ]
        near = min(far) + _BLURRED
        return first + next(index for index, metres in enumerate(far) if metres <= near)

    def stretch(self, here: Point, stands: bool, first: int, last: int) -> Section:
        """Return the section from here, at or soon after the end of one piece, to the end of another."""
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


def course(section: Section, speed: float, motion: Motion) -> Course:
    """Cut a section into pieces, for a drone that moves so."""
    first = section.points[0]
    pieces, legs = [Piece(first, first)], [Leg(0, 1, first, first, (*first, *first))]
    last = len(section.points) - 2
    for number, (a, b) in enumerate(pairwise(section.points)):
        metres = SHORT if motion.smooth and number == last and section.lands else PIECE
        count = max(1, ceil(dist(a, b) / metres - 1e-9))
        legs.append(Leg(len(pieces), len(pieces) + count, a, b, box_of((a, b))))
        ends = [a, *(part_way(a, b, part / count) for part in range(1, count)), b]
        pieces += [Piece(start, end) for start, end in pairwise(ends)]
    return Course(section, tuple(pieces), tuple(legs), speed, motion)


Near = tuple[int, int, int]
"""A piece of the first course, and a range of pieces of the second."""


def near(one: Course, other: Course, limit: float) -> list[Near]:
    """Return the pieces of two courses, by number, that come nearer to each other than a distance."""
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
    """Yield those of two legs. As these are straight, the near pieces are one range of each."""
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
    """Return the pieces of a course that come nearer to a point than a distance."""
    return [
        index
        for leg in one.legs
        if between(leg.start, leg.end, place, place) < limit
        for index in range(leg.first, leg.last)
        if between(one.pieces[index].start, one.pieces[index].end, place, place) < limit
    ]
