"""Which photo is seen at a point of the ground, where several show it: what pages must agree with."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pluto_fleet.station.wire import PhotoValue

Shot = tuple[int, "PhotoValue"]
"""The number of a result, and its photo."""


def shows(photo: PhotoValue, x: float, y: float) -> bool:
    """Return whether a point lies on the ground that a photo shows, its edges included."""
    middle_x, middle_y = photo["position"][:2]
    return abs(x - middle_x) <= photo["width"] / 2 and abs(y - middle_y) <= photo["height"] / 2


def on_top(shots: Iterable[Shot], x: float, y: float) -> int | None:
    """Return the result whose photo is seen at a point: the sharpest that shows it, of equals the newest.

    None: no photo shows it.
    """
    there = [shot for shot in shots if shows(shot[1], x, y)]
    return max(there, key=_rank)[0] if there else None


def stacked(shots: Iterable[Shot]) -> list[Shot]:
    """Return photos in the order in which they are drawn one over another: the one on top last."""
    return sorted(shots, key=_rank)


def _rank(shot: Shot) -> tuple[float, int]:
    number, photo = shot
    return photo["sharpness"], number
