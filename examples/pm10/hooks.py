"""Where must the dust be measured more closely? Along its steepest gradients (thesis 6.1.4)."""

from __future__ import annotations

from itertools import combinations
from math import dist
from typing import NamedTuple

from . import Mission, Point, Results, Trip, Verdict

QUANTITY = "pm10"

FINEST = 1 / 3.2
"""The part of a mission's reach from which on there is no need to look closer."""

FLAT = 9.6
"""µg/m³ over its reach: a gradient must be steeper."""

AT_ONCE, AT_MOST = 2, 4
"""Trips that one mission adds at a time, and altogether."""


class Sample(NamedTuple):
    """What was measured at a point."""

    point: Point
    value: float


class Gradient(NamedTuple):
    """How much the dust changes between two samples, a metre."""

    steepness: float
    low: Sample
    high: Sample

    @property
    def middle(self) -> Point:
        """Where one more sample tells most."""
        (ax, ay, az), (bx, by, bz) = self.low.point, self.high.point
        return (round((ax + bx) / 2, 2), round((ay + by) / 2, 2), round((az + bz) / 2, 2))


def follow_gradients(mission: Mission, results: Results) -> Verdict:
    """Add a trip in the middle of each of the steepest gradients that the mission has a share in.

    The gradients lie between the samples of all missions, so the map grows finer where the dust
    is, and stays coarse where there is none. Each mission adds a few trips and no more: the
    drones come home in the end, in any wind.
    """
    samples = [
        Sample(result.trip.target, result.value)
        for result in results.all
        if isinstance(result.value, float)
    ]
    own = {trip.target for trip in mission.completed_trips}
    fine = mission.reach * FINEST
    left = AT_MOST - sum(trip.added for trip in mission.completed_trips)
    chosen: list[Gradient] = []
    taken = {sample.point for sample in samples}
    for gradient in gradients(samples, mission.reach):
        if len(chosen) == min(AT_ONCE, left):
            break
        mine = gradient.low.point in own or gradient.high.point in own
        if mine and all(dist(gradient.middle, point) >= fine / 2 for point in taken):
            chosen.append(gradient)
            taken.add(gradient.middle)
    if not chosen:
        highest = max(samples, key=lambda sample: sample.value)
        return Verdict(log=(f"fine enough; highest so far: {highest.value:.0f} µg/m³",))
    return Verdict(
        add=tuple(sampling(gradient) for gradient in chosen),
        log=tuple(
            f"{name_of(gradient)}: {gradient.steepness:.1f} µg/m³ a metre" for gradient in chosen
        ),
    )


def gradients(samples: list[Sample], reach: float) -> list[Gradient]:
    """Return the gradients between samples within reach of each other, the steepest first, without flat ones."""
    found = []
    for one, other in combinations(samples, 2):
        metres = dist(one.point, other.point)
        if reach * FINEST <= metres <= reach:
            low, high = sorted((one, other), key=lambda sample: sample.value)
            found.append(Gradient((high.value - low.value) / metres, low, high))
    return sorted((one for one in found if one.steepness >= FLAT / reach), reverse=True)


def sampling(gradient: Gradient) -> Trip:
    """Return the trip that measures in the middle of a gradient."""
    return Trip(
        name=name_of(gradient),
        action="measure",
        target=gradient.middle,
        parameters={"quantity": QUANTITY},
    )


def name_of(gradient: Gradient) -> str:
    """Return what the trip to the middle of a gradient is called."""
    x, y, z = gradient.middle
    return f"gradient {x:g}/{y:g}/{z:g}"
