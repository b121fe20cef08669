"""The corners of an area that has a name, which may not cross itself."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from ..shared.domain import values
from ..shared.domain.airspace import EPSILON, distance, tidy
from ..shared.domain.text import place

if TYPE_CHECKING:
    from ..shared.domain.airspace import Corner, Polygon

MOST_CORNERS = 200


def outline(value: object) -> Polygon:
    """Read the corners of a polygon that does not cross itself."""
    corners = tidy(values.polygon(value))
    if len(corners) > MOST_CORNERS:
        raise ValueError(f"has more than {MOST_CORNERS} corners")
    if (spot := crossing(corners)) is not None:
        where = place((*spot, 0.0))
        raise ValueError(
            f"crosses or touches itself near {where}: name the corners in their order around it"
        )
    return corners


def crossing(corners: Sequence[Corner]) -> Corner | None:
    """Return a corner beside which an outline crosses or touches itself, or None."""
    edges = [*pairwise([*corners, *corners[:1]])]
    for i, (a, b) in enumerate(edges):
        if _turns_back(a, b, edges[(i + 1) % len(edges)][1]):
            return b
        last = len(edges) - (i == 0)  # the edges beside this one share a corner with it
        if any(_meet(a, b, c, d) for c, d in edges[i + 2 : last]):
            return a
    return None


def _turns_back(a: Corner, b: Corner, c: Corner) -> bool:
    """Return whether the edge from b to c lies on the one from a to b."""
    return min(distance(c, a, b), distance(a, b, c)) <= EPSILON


def _meet(a: Corner, b: Corner, c: Corner, d: Corner) -> bool:
    """Return whether two edges cross or touch."""
    if min(distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)) <= EPSILON:
        return True
    return _side(a, b, c) != _side(a, b, d) and _side(c, d, a) != _side(c, d, b)


def _side(a: Corner, b: Corner, c: Corner) -> bool:
    """Return whether c is to the left of the line from a to b."""
    return (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
