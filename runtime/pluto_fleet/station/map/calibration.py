"""Laying a floor plan where it belongs, by two of its points and the length between them.

A picture has its pixels counted from its upper left corner, x to the right and y down; the map has its metres
counted from its lower left corner, y up. With the points p and q in pixels, d metres apart:

    scale = d / |q - p|                           metres a pixel
    size  = scale * (pixels wide, pixels high)
    turn  = angle(q' - p') - angle(Q - P)         clockwise; 0 if it is not known where q is on the map
    at    = P - rotated(scale * (p.x, high - p.y), turn)

where P and Q are the places on the map of p and q, p' and q' are p and q with y up, and `rotated` turns a vector
clockwise. A picture that is placed so has p at P, and all its lengths are right.
"""

from __future__ import annotations

from math import atan2, cos, degrees, dist, radians, sin
from typing import TYPE_CHECKING

from ...files.landmarks import Picture
from ...shared.domain.errors import BadInput

if TYPE_CHECKING:
    from ...shared.domain.airspace import Corner

NEAREST = 2.0
"""Pixels that two points must be apart: of nearer ones no length can be told."""


def calibration(
    file: str,
    pixels: tuple[float, float],
    first: Corner,
    second: Corner,
    metres: float,
    *,
    at: Corner | None = None,
    towards: Corner | None = None,
) -> Picture:
    """Return where a picture lies of which two points are so many metres apart.

    `pixels`: its width and height; `first`, `second`: the points, in pixels. `at`: where the first is on
    the map, in metres; None: the picture's lower left corner is the map's. `towards`: a place of the map on
    the ray from there through the second; None: the picture is not turned. Raises `BadInput`.
    """
    if not metres > 0.0:
        raise BadInput("the length between the two points must be more than 0 m")
    apart = dist(first, second)
    if apart < NEAREST:
        raise BadInput("the two points are too near to each other: choose two farther apart")
    scale, high = metres / apart, pixels[1]
    turn = 0.0
    if at is not None and towards is not None:
        in_picture = atan2(first[1] - second[1], second[0] - first[0])
        turn = degrees(in_picture - atan2(towards[1] - at[1], towards[0] - at[0]))
        turn = (turn + 180.0) % 360.0 - 180.0
    corner = (0.0, 0.0)
    if at is not None:
        x, y = turned((scale * first[0], scale * (high - first[1])), turn)
        corner = (at[0] - x, at[1] - y)
    return Picture(file=file, at=corner, size=(scale * pixels[0], scale * high), turn=turn)


def on_map(picture: Picture, pixels: tuple[float, float], pixel: Corner) -> Corner:
    """Return the place on the map of a pixel of a picture that lies there."""
    (wide, high), (width, height) = pixels, picture.size
    x, y = turned((pixel[0] * width / wide, (high - pixel[1]) * height / high), picture.turn)
    return picture.at[0] + x, picture.at[1] + y


def turned(vector: Corner, turn: float) -> Corner:
    """Turn a vector clockwise, by degrees."""
    angle, (x, y) = radians(turn), vector
    return x * cos(angle) + y * sin(angle), y * cos(angle) - x * sin(angle)
