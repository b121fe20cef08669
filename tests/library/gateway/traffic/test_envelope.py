"""Where drones are never sent: neither there, nor past it."""

from __future__ import annotations

from itertools import pairwise
from math import dist

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.gateway.traffic.legs import leg_problem
from pluto_fleet.gateway.traffic.way_back import way_back, way_from
from pluto_fleet.gateway.traffic.ways import Ground
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.traffic.skies import Sky

WALL = Airspace(size=(10, 10), ceiling=2.0, no_fly=(((4, 2), (6, 2), (6, 8), (4, 8)),))

STEPS = [i / 4 for i in range(41)]
PERMITTED = [(x, y) for x in STEPS for y in STEPS if WALL.problem((x, y, 1.0)) is None]


@pytest.mark.parametrize("apart", [0.5, 0.0])
def test_no_way_leads_through_a_no_fly_area(apart: float) -> None:
    """Though both its ends are permitted: it goes around it."""
    sky = Sky([(2, 5)], airspace=WALL, apart=apart)
    sky.puts((2, 5, 1.2))
    job = sky.kernel.spawn(sky.fly("cf1", (8, 5, 1.2)), FLEET + 1, "job")
    while not job.is_set:
        sky.advance(0.25)
        assert WALL.problem(sky.at("cf1")) is None
        assert sky.kernel.now < 60
    assert (job.result(), sky.at("cf1")) == (None, (8, 5, 1.2))


def test_no_way_down_leads_through_a_no_fly_area() -> None:
    """A landing place beyond one is come to around it."""
    sky = Sky([(3.9, 5), (8, 5)], airspace=WALL)
    sky.put("cf2", (3.9, 5, 1.2))
    drones = {one.id: one for one in sky.drones}
    ground = Ground(drones, sky.navigation.telemetry, WALL, 0.5, sky.at)
    ways = list(ground.ways_down("cf2"))
    assert any(way.points[-1][0] > 6 for way in ways)
    legs = [leg for way in ways for leg in pairwise(way.points)]
    assert [leg for leg in legs if leg_problem(WALL, *leg) is not None] == []


@pytest.mark.parametrize(
    "place", [(5.9, 5, 1.2), (10.3, 5, 1.2), (9, -0.2, 1.2), (8, 5, 2.3), (5, 7.5, 1.0)]
)
@pytest.mark.parametrize("apart", [0.5, 0.0])
def test_who_has_drifted_out_flies_back_in(apart: float, place: tuple[float, float, float]) -> None:
    """By the shortest way, and then on; it may land there, too."""
    for what in ("job", "land"):
        sky = Sky([(9, 9)], airspace=WALL, apart=apart)
        sky.puts(place)
        if what == "job":
            job = sky.kernel.spawn(sky.fly("cf1", (8, 9, 1.2)), FLEET + 1, what)
            assert sky.until(job, 60)
            assert job.result() is None
        else:
            down = sky.kernel.spawn(sky.commander.land("cf1"), FLEET + 1, what)
            assert sky.until(down, 60)
        assert WALL.problem(sky.at("cf1")) is None


@given(st.tuples(st.floats(-2, 12), st.floats(-2, 12), st.floats(-1, 4)))
def test_the_way_back_is_short_and_leads_to_where_it_may_be(
    point: tuple[float, float, float],
) -> None:
    """No permitted point is much nearer."""
    back = way_back(WALL, point)
    assert WALL.problem(back) is None
    if WALL.problem(point) is None:
        assert dist(back, point) < 1e-6
    height = min(max(point[2], 0.0), 2.0)
    nearest = min(dist((x, y, height), point) for x, y in PERMITTED)
    assert dist(back, point) <= nearest + 1e-5


def test_targets_are_refused_and_never_made_to_fit() -> None:
    for target in ((1, 1, 2.5), (11, 1, 1.2), (5, 5, 1.2)):
        with pytest.raises(FlightFailed):
            way_from(WALL, "cf1", (1, 1, 1.2), target)
