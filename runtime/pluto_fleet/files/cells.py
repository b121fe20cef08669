"""In which order the lanes of an area are flown that is not convex: in cells, so that few ways lead over what is not of it.

A lane that leaves the area and comes back is cut there. What lies side by side without a fork is a cell (a boustrophedon
decomposition), which is flown back and forth; then comes the cell that begins nearest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import chain, pairwise
from math import dist

from ..shared.domain.airspace import Corner

Lane = Sequence[Corner]
Outside = Callable[[Sequence[Corner]], float]
"""How many metres of a way are not over the area."""

OUTSIDE = 10.0
"""As many metres of detour is one worth that is not over the area."""
MOST_CELLS = 60
"""Of more, the order is not searched: they are flown lane by lane."""


def ordered(
    lanes: Sequence[Lane], along: int, side: float, before: Corner | None, outside: Outside
) -> Sequence[Lane]:
    """Return the lanes, or what they are cut into, in the order and the direction in which they are flown.

    `along`: the axis of the lanes, 0 or 1; `side`: metres between two places of one; `before`: where the drones come from.
    """
    whole = min(_ways(lanes), key=lambda way: _length(way, before))
    cells = _cells([_cut(lane, side, outside) for lane in lanes], along, side)
    if not 1 < len(cells) <= MOST_CELLS:
        return whole
    tours = [whole, *(_tour(cells, first, before) for first in range(len(cells)))]
    return min(tours, key=lambda way: _cost(way, before, outside))


def _ways(lanes: Sequence[Lane]) -> Iterator[Sequence[Lane]]:
    """Yield the four ways back and forth, each from another corner."""
    for order in (lanes, lanes[::-1]):
        for turned in (0, 1):
            yield [lane[:: -1 if (n + turned) % 2 else 1] for n, lane in enumerate(order)]


def _length(way: Sequence[Lane], before: Corner | None) -> float:
    come = [] if before is None else [before]
    return round(sum(dist(a, b) for a, b in pairwise([*come, *chain.from_iterable(way)])), 3)


def _cost(way: Sequence[Lane], before: Corner | None, outside: Outside) -> float:
    return round(_length(way, before) + OUTSIDE * outside([*chain.from_iterable(way)]), 3)


def _cut(lane: Lane, side: float, outside: Outside) -> list[Lane]:
    """Return the parts of a lane, cut where at least one place is left out that is not of the area."""
    found = [[lane[0]]]
    for here, there in pairwise(lane):
        if dist(here, there) > 1.5 * side and outside([here, there]) > side / 2:
            found.append([])
        found[-1].append(there)
    return [*found]


def _cells(lanes: Sequence[Sequence[Lane]], along: int, side: float) -> list[list[Lane]]:
    """Return the cells: parts of lanes of which each has one neighbour before it, and is the only one of that."""

    def is_beside(one: Lane, other: Lane) -> bool:
        low = max(one[0][along], other[0][along])
        return low <= min(one[-1][along], other[-1][along]) + side / 2

    found: list[list[Lane]] = []
    open_cells: list[list[Lane]] = []
    for parts in lanes:
        now: list[list[Lane]] = []
        for part in parts:
            near = [cell for cell in open_cells if is_beside(cell[-1], part)]
            alone = len(near) == 1 and sum(is_beside(near[0][-1], one) for one in parts) == 1
            now.append([*near[0], part] if alone else [part])
            if alone:
                found.remove(near[0])
            found.append(now[-1])
        open_cells = now
    return found


def _tour(cells: Sequence[Sequence[Lane]], first: int, before: Corner | None) -> Sequence[Lane]:
    """Return all cells, one of them first, and then always the one that begins nearest."""
    left = [*range(len(cells))]
    found: list[Lane] = []
    here = before
    while left:
        able = left if found else [first]
        ways = [(number, way) for number in able for way in _ways(cells[number])]
        number, way = min(ways, key=lambda one: 0.0 if here is None else dist(here, one[1][0][0]))
        left.remove(number)
        found += way
        here = way[-1][-1]
    return found
