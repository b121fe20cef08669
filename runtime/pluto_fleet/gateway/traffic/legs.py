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


def leaves(a: Point, b: Point, c: Point, d: Point, limit: float) -> float:
    """Return after which part of a leg from a to b, which comes near the one from c to d, it is clear of it.

    What is near a leg is a cylinder with a sphere around each end: the last of them counts.
    """
    if between(a, b, c, d) >= limit:
        return 0.0
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    uu, far = ux * ux + uy * uy + uz * uz, limit * limit
    if uu <= _POINT:
        return 1.0
    last = 0.0
    for x, y, z in (c, d):
        rx, ry, rz = a[0] - x, a[1] - y, a[2] - z
        ur = ux * rx + uy * ry + uz * rz
        root = ur * ur - uu * (rx * rx + ry * ry + rz * rz - far)
        if root > 0.0:
            last = max(last, (sqrt(root) - ur) / uu)
    vx, vy, vz = d[0] - c[0], d[1] - c[1], d[2] - c[2]
    vv = vx * vx + vy * vy + vz * vz
    if vv > _POINT:
        rx, ry, rz = a[0] - c[0], a[1] - c[1], a[2] - c[2]
        uv, rv = ux * vx + uy * vy + uz * vz, rx * vx + ry * vy + rz * vz
        across = uu - uv * uv / vv  # the same, without what is along that leg
        ur = ux * rx + uy * ry + uz * rz - uv * rv / vv
        root = ur * ur - across * (rx * rx + ry * ry + rz * rz - rv * rv / vv - far)
        if across > 1e-12 * uu and root > 0.0:
            part = (sqrt(root) - ur) / across
            if 0.0 <= rv + part * uv <= vv:
                last = max(last, part)
    return min(1.0, last)


_POINT = 1e-18
"""Square metres: a leg shorter than this has no direction."""


def leg_problem(airspace: Airspace, start: Point, end: Point) -> str | None:
    """Return why no drone may fly straight from one permitted point to another, or None."""
    for count, area in enumerate(airspace.areas, 1):
        if enters(start[:2], end[:2], area):
            way = f"the straight way from {place(start)} to {place(end)}"
            return f"{way} leads through no-fly area {count}"
    return None
