"""Ten drones come down as soon as the slowest would alone, and never too near to each other."""

from __future__ import annotations

from math import dist
from random import Random

import pytest

from pluto_fleet.jobs.reports import Down
from plutoc_runtime.domain.airspace import Airspace
from plutoc_runtime.domain.model import Point
from tests.gateway.traffic.skies import Sky, is_home

TEN = 10
CASES = 10


def apart_from(chance: Random, side: float, height: float | None) -> list[Point]:
    """Return ten places, nowhere nearer than half a metre."""
    found: list[Point] = []
    while len(found) < TEN:
        z = chance.uniform(0.5, 2.5) if height is None else height
        place = (chance.uniform(0, side), chance.uniform(0, side), z)
        if all(dist(place, other) >= 0.5 for other in found):
            found.append(place)
    return found


def comes_down(homes: list[Point], places: list[Point], side: float, how: Down) -> Sky:
    """Bring down drones that hover at these places."""
    sky = Sky([home[:2] for home in homes], airspace=Airspace(size=(side, side)))
    sky.puts(*places)
    sky.look()
    assert sky.until(sky.gateway.bring_down(how), 300)
    return sky


@pytest.mark.parametrize("how", [Down.HOME, Down.LAND])
@pytest.mark.parametrize("side", [20.0, 6.0])
@pytest.mark.parametrize("seed", range(CASES))
def test_all_are_down_when_the_slowest_is(seed: int, side: float, how: Down) -> None:
    """Within two seconds of what it takes alone; half of the cases at one and the same height."""
    chance = Random(seed)
    homes = apart_from(chance, side, 0.0)
    places = apart_from(chance, side, 1.2 if seed % 2 else None)
    alone = [
        comes_down([home], [place], side, how).kernel.now
        for home, place in zip(homes, places, strict=True)
    ]
    sky = comes_down(homes, places, side, how)
    assert sky.kernel.now <= max(alone) + 2
    assert sky.nearest >= sky.apart - 1e-6
    if how is Down.HOME:
        assert all(is_home(sky, drone) for drone in sky.drones)
