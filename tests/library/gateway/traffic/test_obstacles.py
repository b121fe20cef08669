"""A drone that is said to be on a way still, without a look at it, is on it still."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import dist

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pluto_fleet.gateway.traffic.reservations import Reservation, meets
from pluto_fleet.gateway.traffic.wait_queue import Obstacle
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import CLIMB_SPEED

LIMIT = 0.5
QUICK = Category(name="quick", speed=2.0)

metres = st.floats(0, 6)
points = st.tuples(metres, metres, st.floats(0.5, 3))
ways = st.lists(points, min_size=2, max_size=4).map(tuple)


@dataclass
class Flown:
    """The telemetry of a drone that flies exactly as fast as it may."""

    location: Point
    battery_level: float = 1.0
    landed: bool = False
    silence: float = 0.0


def moments(way: tuple[Point, ...]) -> list[tuple[float, int, Point]]:
    """Return when a drone is where on its way, in small steps, and how many points it has left."""
    now, found = 0.0, []
    for left, (a, b) in enumerate(pairwise(way)):
        upright = (left == 0 and a[2] == 0) or b[2] == 0
        lasts = dist(a, b) / (CLIMB_SPEED if upright else QUICK.speed)
        for step in range(20):
            x, y, z = (p + step / 20 * (q - p) for p, q in zip(a, b, strict=True))
            found.append((now + step / 20 * lasts, left, (x, y, z)))
        now += lasts
    return [*found, (now, len(way) - 2, way[-1])]


def grounded(way: tuple[Point, ...], stands: bool, lands: bool) -> tuple[Point, ...]:
    """Return a way that begins below its first point, or ends below its last."""
    first, last = (*way[0][:2], 0.0), (*way[-1][:2], 0.0)
    return (*((first,) if stands else ()), *way, *((last,) if lands else ()))


@settings(max_examples=150)
@given(ways, st.booleans(), st.booleans(), ways, st.integers(0, 60))
def test_a_drone_is_on_a_way_for_as_long_as_it_is_said_to_be(
    flown: tuple[Point, ...], stands: bool, lands: bool, wanted: tuple[Point, ...], seen: int
) -> None:
    flown = grounded(flown, stands, lands)
    telemetry = Flown(flown[0])
    claim = Reservation("one", telemetry)
    claim.moves_along(flown, ())
    obstacle = Obstacle(claim, QUICK, False)
    found = moments(flown)
    at = seen % len(found)
    now, claim.at, telemetry.location = found[at]
    assume(meets(wanted, claim.shape(now), LIMIT))
    obstacle.seen(wanted, LIMIT, now)
    for later, claim.at, telemetry.location in found[at:]:
        if obstacle.is_sure(later):
            assert meets(wanted, claim.shape(later), LIMIT)


def test_who_crosses_a_way_at_its_end_needs_no_look_before() -> None:
    telemetry = Flown((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.moves_along(((0.0, 0.0, 1.0), (10.0, 0.0, 1.0)), ())
    obstacle = Obstacle(claim, QUICK, False)
    obstacle.seen(((9.0, -1.0, 1.0), (9.0, 1.0, 1.0)), LIMIT, 0.0)
    assert obstacle.is_sure(4.0)
    assert not obstacle.is_sure(9.5 / QUICK.speed)


@pytest.mark.parametrize("what", ["goes", "rests", "sinks"])
def test_who_is_told_something_else_is_looked_at_again(what: str) -> None:
    telemetry = Flown((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.rests((), 0.0)
    obstacle = Obstacle(claim, QUICK, False)
    obstacle.seen(((0.0, 0.0, 1.0), (1.0, 0.0, 1.0)), LIMIT, 3.0)
    assert obstacle.is_sure(3.1)
    if what == "goes":
        claim.moves_along(((0.0, 0.0, 1.0), (0.0, 5.0, 1.0)), ())
    elif what == "rests":
        claim.rests((), 0.0)
    else:
        claim.sinks()
    assert not obstacle.is_sure(3.1)


def test_who_has_not_come_to_a_stop_is_looked_at_when_it_has() -> None:
    telemetry = Flown((0.0, 0.0, 1.0))
    claim = Reservation("one", telemetry)
    claim.rests(((0.6, 0.0, 1.0),), 2.0)
    obstacle = Obstacle(claim, QUICK, True)
    obstacle.seen(((0.0, 0.0, 1.0), (1.0, 0.0, 1.0)), LIMIT, 0.0)
    assert obstacle.is_sure(1.9)
    assert not obstacle.is_sure(2.0)
