"""Straight legs: how near two come to each other, and what one leads through."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from ...shared.domain.airspace import enters
from ...shared.domain.text import place

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Point


def between(a: Point, b: Point, c: Point, d: Point) -> float:
    """Return how near the straight leg from a to b comes to the one from c to d, in space.

    Where both are nearest to each other, each is at an end, or the line between is square to it.
    """
    ax, ay, az = a
    cx, cy, cz = c
    ux, uy, uz = b[0] - ax, b[1] - ay, b[2] - az
    vx, vy, vz = d[0] - cx, d[1] - cy, d[2] - cz
    rx, ry, rz = ax - cx, ay - cy, az - cz
    uu, vv = ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz
    ur, vr = ux * rx + uy * ry + uz * rz, vx * rx + vy * ry + vz * rz
    s = t = 0.0
    if uu <= _POINT:
        if vv > _POINT:
            t = min(1.0, max(0.0, vr / vv))
    elif vv <= _POINT:
        s = min(1.0, max(0.0, -ur / uu))
    else:
        uv = ux * vx + uy * vy + uz * vz
        square = uu * vv - uv * uv
        if square > 1e-12 * uu * vv:  # else they are parallel: one place is as good as another
            s = min(1.0, max(0.0, (uv * vr - ur * vv) / square))
        t = (uv * s + vr) / vv
        if t < 0.0:
            t, s = 0.0, min(1.0, max(0.0, -ur / uu))
        elif t > 1.0:
            t, s = 1.0, min(1.0, max(0.0, (uv - ur) / uu))
    dx, dy, dz = rx + s * ux - t * vx, ry + s * uy - t * vy, rz + s * uz - t * vz
    return sqrt(dx * dx + dy * dy + dz * dz)


_POINT = 1e-18
"""Square metres: a leg shorter than this has no direction."""


def leg_problem(airspace: Airspace, start: Point, end: Point) -> str | None:
    """Return why no drone may fly straight from one permitted point to another, or None."""
    for count, area in enumerate(airspace.areas, 1):
        if enters(start[:2], end[:2], area):
            way = f"the straight way from {place(start)} to {place(end)}"
            return f"{way} leads through no-fly area {count}"
    return None
