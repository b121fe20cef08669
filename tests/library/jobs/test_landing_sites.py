"""Where a drone can land when not where it is."""

from __future__ import annotations

from math import dist, hypot

from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.jobs.landing_sites import free_spot, free_spots
from pluto_fleet.shared.domain.airspace import Airspace

MAP = Airspace(size=(8.0, 6.0), no_fly=(((2, 2), (5, 2), (5, 4), (2, 4)), ((6, 0), (8, 0), (8, 1))))
places = st.tuples(st.floats(0, 8), st.floats(0, 6), st.floats(0, 3))


@given(places, st.lists(places, max_size=6))
def test_it_is_permitted_and_apart_from_all_others(
    point: tuple[float, float, float], taken: list[tuple[float, float, float]]
) -> None:
    """And no nearer place is much nearer."""
    x, y, z = free_spot(MAP, point, taken, 0.5)
    assert z == 0
    assert MAP.problem((x, y, 0.0)) is None
    assert all(hypot(x - other[0], y - other[1]) >= 0.5 for other in taken)
    free = [
        (i / 5, j / 5)
        for i in range(41)
        for j in range(31)
        if MAP.problem((i / 5, j / 5, 0.0)) is None
        and all(dist((i / 5, j / 5), other[:2]) >= 0.5 for other in taken)
    ]
    assert dist((x, y), point[:2]) <= min(dist(place, point[:2]) for place in free) + 0.6


def test_a_map_that_is_full_leaves_no_choice() -> None:
    """Down is better than nowhere."""
    crowd = [(i / 2, j / 2, 0.0) for i in range(17) for j in range(13)]
    assert free_spot(MAP, (3.0, 3.0, 1.0), crowd, 2.0) == (3.0, 3.0, 0.0)


def test_on_a_map_of_kilometres_only_what_is_near_is_looked_at() -> None:
    """A drone that must come down does not wait until all of it was."""
    strip = Airspace(size=(5.0, 10_000.0))
    found = list(free_spots(strip, (2.0, 5000.0, 3.0), [(2.0, 5000.0, 0.0)], 10.0))
    assert found
    assert all(hypot(x - 2.0, y - 5000.0) <= 30.1 for x, y, _ in found)
