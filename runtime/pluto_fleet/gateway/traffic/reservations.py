"""What part of the air a drone has for itself: the rest of its way, or the place where it hovers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from plutoc_runtime.domain.geometry import between

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point, Telemetry

DRIFT = 0.3
"""Metres that a drone may stray from where it hovers, before anybody looks."""
SINKS = 0.1
"""Metres below where it should hover, from which on a drone is taken to be on its way down."""

NEARLY = 0.1
"""Metres of height below which a drone that lands is as good as on the ground: it strays no more."""

Box = tuple[float, float, float, float, float, float]


class Reservation:
    """One drone's part of the air. What lies behind the drone is free: it is asked where it is."""

    __slots__ = ("at", "box", "drone", "fails", "moves", "points", "tail", "telemetry", "until")

    def __init__(self, drone: str, telemetry: Telemetry) -> None:
        self.drone, self.telemetry = drone, telemetry
        self.moves = self.fails = False
        self.points: tuple[Point, ...] = ()
        """Its way; where it hovers, that place alone."""
        self.at = 0
        """Which of the points it has left last."""
        self.tail: tuple[Point, ...] = ()
        """Where it may go beyond that, or has not come to a stop yet."""
        self.until = 0.0
        """For how long that may be so."""
        self.box: Box = (0.0,) * 6

    def moves_along(self, points: tuple[Point, ...], tail: tuple[Point, ...]) -> None:
        """It is about to fly this way, and may go on a little."""
        self.points, self.at, self.tail = points, 0, tail
        self.moves, self.fails = True, False
        self.box = box_of((*points, *tail) if tail else points)

    def rests(self, tail: tuple[Point, ...], until: float) -> None:
        """It hovers where it is now."""
        here = self.telemetry.location
        self.points, self.at, self.tail, self.until = (here,), 0, tail, until
        self.moves = self.fails = False
        self._widen()

    def sinks(self) -> None:
        """It does not do what it was told: wherever it is, it may come down from there."""
        self.points, self.at, self.tail = (self.telemetry.location,), 0, ()
        self.moves, self.fails = False, True
        self._widen()

    @property
    def touches_down(self) -> bool:
        """Whether it lands, and is about to stand."""
        return (
            self.moves
            and self.points[-1][2] <= 0.0
            and self.at >= len(self.points) - 2
            and self.telemetry.location[2] < NEARLY
        )

    def _widen(self) -> None:
        """Let the box hold all to where it may drift, or sink, before anybody looks."""
        x, y, z, *most = box_of((*self.points, *self.tail))
        x, y = x - DRIFT, y - DRIFT
        self.box = x, y, min(0.0, z), most[0] + DRIFT, most[1] + DRIFT, most[2] + DRIFT

    def shape(self, now: float) -> tuple[Point, ...]:
        """Return what it has now: the corners of a line."""
        here = self.telemetry.location
        if self.moves:
            return (here, *self.points[self.at + 1 :], *self.tail)
        if self.fails or here[2] < self.points[0][2] - SINKS:
            return here, (here[0], here[1], 0.0)
        return (here, *self.tail) if now < self.until else (here,)


def part_way(a: Point, b: Point, part: float) -> Point:
    """Return the place on a straight way that has this part of it behind."""
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])


def box_of(points: Sequence[Point]) -> Box:
    """Return the box around a line."""
    (x, y, z), *others = points
    most_x, most_y, most_z = x, y, z
    for px, py, pz in others:
        if px < x:
            x = px
        elif px > most_x:
            most_x = px
        if py < y:
            y = py
        elif py > most_y:
            most_y = py
        if pz < z:
            z = pz
        elif pz > most_z:
            most_z = pz
    return x, y, z, most_x, most_y, most_z


def nearest(a: tuple[Point, ...], b: tuple[Point, ...]) -> float:
    """Return how near two lines come to each other."""
    return min(
        between(p, q, r, s)
        for p, q in pairwise((a[0], *a) if len(a) == 1 else a)
        for r, s in pairwise((b[0], *b) if len(b) == 1 else b)
    )


def meets(a: tuple[Point, ...], b: tuple[Point, ...], limit: float) -> bool:
    """Say whether two lines come nearer to each other than that."""
    legs = [*pairwise(b)] if len(b) > 1 else [(b[0], b[0])]
    p = a[0]
    px, py, pz = p
    for q in a[1:] or a:
        qx, qy, qz = q
        low_x, high_x = (px - limit, qx + limit) if px < qx else (qx - limit, px + limit)
        low_y, high_y = (py - limit, qy + limit) if py < qy else (qy - limit, py + limit)
        low_z, high_z = (pz - limit, qz + limit) if pz < qz else (qz - limit, pz + limit)
        for r, s in legs:
            if (
                (r[0] >= high_x and s[0] >= high_x)
                or (r[0] <= low_x and s[0] <= low_x)
                or (r[1] >= high_y and s[1] >= high_y)
                or (r[1] <= low_y and s[1] <= low_y)
                or (r[2] >= high_z and s[2] >= high_z)
                or (r[2] <= low_z and s[2] <= low_z)
            ):
                continue
            if between(p, q, r, s) < limit:
                return True
        p, px, py, pz = q, qx, qy, qz
    return False
