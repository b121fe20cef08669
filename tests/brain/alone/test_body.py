"""The one body of simulated drones: how long it takes where it is sent on while it moves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest

from pluto_fleet.shared.alone.drones import Body
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.motion import CRAZYFLIE


@dataclass
class Clock:
    """Time that is set by hand."""

    now: float = 0.0


def sent_on(after: float, metres: float) -> float:
    """Return the seconds of a leg along the way of a drone that was told to hover so long before."""
    clock = Clock()
    exact = Category(name="scout", speed=1.0, motion=replace(CRAZYFLIE, spread=0.0))
    body = Body("cf1", (1.0, 1.0, 0.0), exact, World(0, Airspace()), clock)
    clock.now = body.follow([(1.0, 1.0, 1.2)])
    arrives = body.follow([(1.0, 1.0, 1.2), (9.0, 1.0, 1.2)])
    clock.now += (arrives - clock.now) / 2
    body.halt()
    clock.now += after
    x, y, z = body.location
    return body.follow([(x, y, z), (x + metres, y, z)]) - clock.now


def test_one_that_is_sent_on_need_not_start_from_rest() -> None:
    """Also a moment after it was told to hover, as happens where the brain is another process."""
    at_once = sent_on(0.0, 3.0)
    assert at_once == pytest.approx(sent_on(0.1, 3.0))
    assert at_once < sent_on(0.1, -3.0)  # it has to turn around
    assert sent_on(0.1, -3.0) < sent_on(5.0, 3.0)
