"""The fence that an autopilot keeps by itself, beside ours: the map, and its ceiling, each by some metres more.

No-fly areas are ours alone: drones fly along their edges, and places by satellites are metres off.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..geodesy import LocalPlane
    from ..shared.domain.airspace import Airspace

_HEIGHT_AND_POLYGON = 1 | 4
"""Of FENCE_TYPE: without the circle around home, which is 300 m wide unless it is set otherwise."""


def fence_of(airspace: Airspace, plane: LocalPlane, beyond: float) -> Sequence[tuple[float, float]]:
    """Return latitude and longitude of the corners of a map that is larger by so many metres all around.

    Raises `ValueError` if it reaches too far from its origin.
    """
    width, depth = airspace.size
    left = -beyond
    right = width + beyond
    low = -beyond
    high = depth + beyond
    around = ((left, low), (right, low), (right, high), (left, high))
    places = [plane.to_degrees((x, y, 0.0)) for x, y in around]
    return [(latitude, longitude) for latitude, longitude, _ in places]


def settings(make: str, height: float) -> Mapping[str, float]:
    """Return the parameters that let it keep its fence, to a height above its home in metres.

    What it does beyond it stays as it is set.
    """
    if make == "PX4":
        return {"GF_MAX_VER_DIST": height}
    return {
        "FENCE_TYPE": _HEIGHT_AND_POLYGON,
        "FENCE_ALT_MAX": height,
        "FENCE_ENABLE": 1,
    }
