"""Reservations: the space that a drone has for itself, its remaining route or where it hovers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist
from typing import TYPE_CHECKING

from .legs import between

if TYPE_CHECKING:
    from ...jobs.telemetry import Telemetry
    from ...shared.domain.model import Point

DRIFT = 0.3
"""Metres that a drone may be off its place, or its route, before it is noticed; at least its slack."""
SINKS = 0.1
"""Metres below its hovering place, from which on a drone is taken to be descending."""

NEARLY = 0.1
"""Metres of height below which a landing drone counts as being on the ground: it does not drift."""

Box = tuple[float, float, float, float, float, float]


class Reservation:
    """The space reserved for one drone. The part behind it is free, by its telemetry."""

    __slots__ = (
        *("_known", "_shape", "at", "box", "drone", "fails", "moves", "points"),
        *("shape_box", "shoots", "slack", "tail", "telemetry", "until"),
    )

    def __init__(self, drone: str, telemetry: Telemetry, slack: float = 0.0) -> None:
        """`slack`: metres within which a drone counts as being where it was told to be."""
        self.drone = drone
        self.telemetry = telemetry
        self.slack = slack
        self.moves = self.fails = False
        self.points: tuple[Point, ...] = ()
        """Its route; while it hovers, that point alone."""
        self.at = 0
        """The index of the point that it left last."""
        self.tail: tuple[Point, ...] = ()
        """Where it may go beyond that, or while it has not stopped yet."""
        self.shoots: tuple[Point, ...] = ()
        """Where it may still shoot to from the way before this one."""
        self.until = 0.0
        """Until when that, or that it has not stopped, may be so."""
        self.box: Box = (0.0,) * 6
        """The box around all that it may take up until it is told something else."""
        self.shape_box = self.box
        """The box around the shape that was asked for last."""
        self._shape: tuple[Point, ...] = ()
        self._known: tuple[float, int, tuple[Point, ...]] = -1.0, 0, ()
        """For when, from which point and for which route the shape was asked for last."""

    def moves_along(
        self,
        points: tuple[Point, ...],
        tail: tuple[Point, ...],
        shoots: tuple[Point, ...] = (),
        until: float = 0.0,
    ) -> None:
        """Reserve a route that it is about to fly, with its possible overshoot.

        `shoots`: where it may still shoot to, until a time.
        """
        self.points, self.at, self.tail = points, 0, tail
        self.shoots = shoots
        self.until = until
        self.moves, self.fails = True, False
        around = box_of((*points, *tail, *shoots) if tail or shoots else points)
        self.box = _widened(around, max(DRIFT, self.slack))

    def rests(self, tail: tuple[Point, ...], until: float) -> None:
        """Reserve the place where it hovers now."""
        here = self.place
        self.points, self.at, self.tail, self.until = (here,), 0, tail, until
        self.moves = self.fails = False
        self._widen()

    def sinks(self) -> None:
        """Reserve the space below it, and its leg with the space below: it has failed, and comes down or flies on.

        A silent drone flies to where it was told to by its last command, and hovers there.
        """
        told = self.points[1:] if self.fails else ()
        if self.moves:
            told = self.points[self.at + 1 : self.at + 2]
        self.points = (self.telemetry.location, *told)
        self.at = 0
        self.tail = ()
        self.moves = False
        self.fails = True
        self._widen()

    @property
    def place(self) -> Point:
        """Where it is by what it was told, if it is near that: by few centimetres no way may differ.

        After a take-off a drone is a hand's breadth too high for some seconds.
        """
        here = self.telemetry.location
        leg = self.points[self.at : self.at + 2] or self.points[-1:]
        if not self.slack or not leg or self.fails:
            return here
        told = nearest_on(leg[0], leg[-1], here)
        if dist(told, here) <= self.slack:
            return told
        return (here[0], here[1], told[2]) if abs(told[2] - here[2]) <= self.slack else here

    def touches_down(self, now: float) -> bool:
        """Return whether it is landing, and nearly on the ground."""
        return (
            self.moves
            and self.points[-1][2] <= 0.0
            and self.at >= len(self.points) - 2
            and self.shape(now)[0][2] < NEARLY
        )

    def _widen(self) -> None:
        """Extend the box to where it may drift or sink before it is noticed."""
        x, y, z, *most = _widened(box_of((*self.points, *self.tail)), max(DRIFT, self.slack))
        self.box = x, y, min(0.0, z), most[0], most[1], most[2]

    def shape(self, now: float) -> tuple[Point, ...]:
        """Return the reserved line, as its corners."""
        then, at, points = self._known
        if then != now or at != self.at or points is not self.points:
            self._shape, self._known = self._seen(now), (now, self.at, self.points)
            self.shape_box = box_of(self._shape)
        return self._shape

    def _seen(self, now: float) -> tuple[Point, ...]:
        here = self.place
        if self.moves:
            shoots = self.shoots if now < self.until else ()
            return (here, *self.points[self.at + 1 :], *self.tail, *shoots)
        if self.fails:
            told = self.points[1:]
            return here, _below(here), *(here for _ in told), *told, *map(_below, told)
        if self.telemetry.location[2] < self.points[0][2] - SINKS:
            return here, _below(here)
        return (here, *self.tail) if now < self.until else (here,)


def _below(point: Point) -> Point:
    return point[0], point[1], 0.0


def _widened(box: Box, by: float) -> Box:
    x, y, z, *most = box
    return x - by, y - by, z - by, most[0] + by, most[1] + by, most[2] + by


def part_way(a: Point, b: Point, part: float) -> Point:
    """Return the place on a straight way that has this part of it behind."""
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])


def nearest_on(start: Point, end: Point, place: Point) -> Point:
    """Return the point of a straight leg that is nearest to a place."""
    if start == end:
        return start
    toward = [b - a for a, b in zip(start, end, strict=True)]
    along = sum(w * (p - a) for w, p, a in zip(toward, place, start, strict=True))
    part = along / sum(w * w for w in toward)
    return part_way(start, end, min(1.0, max(0.0, part)))


def ahead(shape: tuple[Point, ...], metres: float) -> tuple[Point, ...]:
    """Return the point to which a drone may overshoot on its route."""
    if len(shape) < 2 or not metres:
        return ()
    here, there = shape[:2]
    far = dist(here, there)
    return (part_way(here, there, min(1.0, metres / far) if far else 0.0),)


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


def are_near(a: Box, b: Box, limit: float) -> bool:
    """Return whether two boxes come nearer to each other than a distance, along every axis."""
    return (
        a[0] < b[3] + limit
        and b[0] < a[3] + limit
        and a[1] < b[4] + limit
        and b[1] < a[4] + limit
        and a[2] < b[5] + limit
        and b[2] < a[5] + limit
    )


def legs_of(line: tuple[Point, ...]) -> list[tuple[Point, Point]]:
    """Return the legs of a line; of a place, one from there to there."""
    return [*pairwise(line)] if len(line) > 1 else [(line[0], line[0])]


def nearest(a: tuple[Point, ...], b: tuple[Point, ...]) -> float:
    """Return the distance between two lines."""
    return min(between(p, q, r, s) for p, q in legs_of(a) for r, s in legs_of(b))


def meets(a: tuple[Point, ...], b: tuple[Point, ...], limit: float) -> bool:
    """Return whether two lines come nearer to each other than a distance."""
    legs = legs_of(b)
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
