"""The lines on which an area is flown over where its action is done on the way, instead of at each place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import ceil, dist
from typing import NamedTuple

from ..shared.domain.airspace import Airspace
from ..shared.domain.model import Category, Point

SHARE = 1 / 3
"""The most that a line takes of what a battery has above its reserve: as much is left for the way there, and back."""

NEAREST = 0.1
"""The fewest metres between two places on the way."""
_FAR = 1e6
_TINY = 1e-6


class Line(NamedTuple):
    """A straight way, and at how many places of it something is done; at one alone its ends are the same."""

    start: Point
    end: Point
    places: int

    @property
    def every(self) -> float:
        """How many metres lie between two of its places."""
        return dist(self.start, self.end) / max(1, self.places - 1)


def stops(lane: Iterable[Point]) -> list[Line]:
    """Return a stop at each place of a lane."""
    return [Line(place, place, 1) for place in lane]


def lines(lane: Sequence[Point], airspace: Airspace, longest: float) -> list[Line]:
    """Return the fewest lines through all places of a lane, none of them longer, in metres."""
    found: list[Line] = []
    for run in _runs(lane, airspace):
        parts = max(1, ceil(dist(run[0], run[-1]) / longest - _TINY))
        size = ceil(len(run) / parts)
        cut = [run[first : first + size] for first in range(0, len(run), size)]
        for part in cut:
            line = Line(part[0], part[-1], len(part))
            found += [line] if line.every >= NEAREST else stops(part)
    return found


def longest_line(categories: Iterable[Category], action: str) -> float:
    """Return how many metres a line may have, so that each drone that can do its action can fly it."""
    able = [one for one in categories if one.can(action)]
    return min((_metres(one) for one in able), default=1.0)


def _metres(category: Category) -> float:
    """Return how far the share of a battery takes a drone that flies straight on."""
    a_metre = category.motion.leg(_FAR, category.speed) / _FAR
    return SHARE * category.endurance * (1 - category.reserve) / a_metre


def _runs(lane: Sequence[Point], airspace: Airspace) -> Iterator[Sequence[Point]]:
    """Yield the places that one straight way leads through, an even distance apart."""
    first = 0
    for number, (here, there) in enumerate(pairwise(lane), 1):
        is_first = number - first == 1
        goes_on = airspace.route(here, there) == (there,)
        if not goes_on or not (is_first or _is_even(lane[number - 2], here, there)):
            yield lane[first:number]
            first = number
    if lane:
        yield lane[first:]


def _is_even(before: Point, here: Point, there: Point) -> bool:
    """Return whether the second of three places is in the middle of the others."""
    return all(abs(a + c - 2 * b) < 1e-4 for a, b, c in zip(before, here, there, strict=True))
