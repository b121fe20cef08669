"""In all that a fleet does, no two come too near to each other, and all comes to an end."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.kit.draws import draws
from tests.library.gateway.traffic.skies import ENDURING, Restless, Sky, is_home
from traffic import APART, flown, measured
from traffic import crossings as crossing

UNEVEN = replace(ENDURING, motion=replace(CRAZYFLIE, spread=0.3, action_spread=0.3))
"""Drones that fly like Crazyflies, but seldom take what was expected."""


def sky_of(chance: Random, category: Category = ENDURING) -> tuple[Sky, list[Point]]:
    """Return a fleet, most often in too small a place, and targets: some the same, some stacked."""
    side, ceiling = chance.choice([3.0, 5.0, 8.0, 20.0]), chance.choice([10.0, 3.0, 1.8, 1.4])
    no_fly = (((2.0, 2.0), (3.0, 2.0), (3.0, 5.0), (2.0, 5.0)),) if side >= 8 else ()
    airspace = Airspace(
        size=(side, side), ceiling=ceiling, no_fly=no_fly if chance.random() < 0.4 else ()
    )
    every = range(int(side / 0.6))
    spots = [(x * 0.6 + 0.3, y * 0.6 + 0.3) for x in every for y in every]
    spots = [(x, y) for x, y in spots if airspace.problem((x, y, 0.0)) is None]
    count = chance.choice([2, 3, 4, 5, 6, 8])
    homes = chance.sample(spots if chance.random() < 0.7 else spots[: count + 3], count)
    targets = []
    for _ in range(chance.choice([1, 2, 4, 10])):
        x, y = chance.choice(homes if chance.random() < 0.3 else spots)
        for _ in range(chance.choice([1, 1, 3])):
            targets.append((x, y, chance.choice([1.2, 1.2, 1.0, 0.8, min(ceiling, 1.7)])))
    sky = Sky(
        homes,
        airspace=airspace,
        max_airborne=chance.choice([None, None, 2, 1]),
        slack=max(chance.choice([0.0, 0.15]), category.motion.slack),
        category=category,
    )
    return sky, targets


@pytest.mark.parametrize("category", [ENDURING, UNEVEN], ids=["enduring", "uneven"])
@pytest.mark.parametrize("seed", draws(6, 40))
def test_every_flight_ends_and_none_comes_too_near(seed: int, category: Category) -> None:
    """Drones fail in flight, targets are the same, ceilings low, and few may be in the air."""
    chance = Random(seed)
    sky, targets = sky_of(chance, category)
    flights = Restless(sky, seed, targets, chance.choice([1, 3]), chance.choice([0.0, 0.3])).begin()
    assert all(sky.until(flight, 3000) for flight in flights)
    assert sky.nearest >= sky.apart - 1e-6
    assert sky.airborne <= (sky.options["max_airborne"] or len(sky.drones))
    sky.kernel.close()


@pytest.mark.parametrize("category", [ENDURING, UNEVEN], ids=["enduring", "uneven"])
@pytest.mark.parametrize("seed", draws(6, 20))
def test_a_stop_in_between_brings_all_down(seed: int, category: Category) -> None:
    """In the middle of anything; who is well and can get home is home, if that was asked for."""
    chance = Random(1000 + seed)
    sky, targets = sky_of(chance, category)
    Restless(sky, seed, targets, 3, 0.0).begin()
    sky.advance(chance.uniform(1, 60))
    how = chance.choice([Down.LAND, Down.HOME])
    down = sky.sends(sky.commander.bring_down(how))
    assert sky.until(down, 500)
    assert sky.nearest >= sky.apart - 1e-6
    assert all(sky.navigation.telemetry[drone.id].landed for drone in sky.drones)
    if how is Down.HOME:
        assert sum(is_home(sky, drone) for drone in sky.drones) >= len(sky.drones) - 1
    sky.kernel.close()


def test_trips_that_cross_keep_apart() -> None:
    """No two drones come nearer; without a distance some would."""
    assert measured(6, 10, 10.0).nearest >= APART - 1e-6
    assert any(flown(*crossing(seed, 10, 10.0), 10.0, 0.0).nearest < APART for seed in range(6))
