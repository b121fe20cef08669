"""A simulated camera that looks straight down."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from random import Random

from .model import Photo, Point

# A 4:3 camera with a wide lens sees 77° across and 62° along: twice the tangent of half the angle
# is the ground that it covers from a height of one metre.
_WIDTH, _HEIGHT = 1.6, 1.2

_DRIFT = 0.05
"""How far, in metres, a drone is from where it should be, as a standard deviation. The plan only:
its height it measures to a centimetre."""

_BLURRED = 0.1
"""The share of photos that are not sharp."""


def take(point: Point, by_x: Sequence[tuple[float, float, str]], chance: Random) -> Photo:
    """Return a photo from about this point; what there is to see is given as (x, y, kind), sorted.

    Each thing whose middle is on the photo is seen once, be the photo sharp or not.
    """
    x = round(point[0] + chance.gauss(0.0, _DRIFT), 3)
    y = round(point[1] + chance.gauss(0.0, _DRIFT), 3)
    z = round(point[2], 3)
    width, height = round(z * _WIDTH, 3), round(z * _HEIGHT, 3)
    first = bisect_left(by_x, x - width / 2, key=lambda thing: thing[0])
    last = bisect_right(by_x, x + width / 2, key=lambda thing: thing[0])
    sees = sorted(
        kind for _, at_y, kind in by_x[first:last] if y - height / 2 <= at_y <= y + height / 2
    )
    sharpness = 1.0
    if chance.random() < _BLURRED:
        sharpness = round(chance.uniform(0.3, 0.6), 3)
    return Photo(
        position=(x, y, z), width=width, height=height, sees=tuple(sees), sharpness=sharpness
    )
