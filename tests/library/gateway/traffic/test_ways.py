"""How near two ways come to each other, and which other ways there are."""

from __future__ import annotations

from math import dist

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.gateway.traffic.legs import between
from pluto_fleet.gateway.traffic.reservations import box_of, meets, nearest
from pluto_fleet.gateway.traffic.ways import Section, sections
from pluto_fleet.shared.domain.airspace import Airspace

metres = st.one_of(st.floats(-3, 3), st.integers(-2, 2).map(float))
points = st.tuples(metres, metres, metres)
ways = st.lists(points, min_size=1, max_size=4).map(tuple)


def part_of(a: tuple[float, ...], b: tuple[float, ...], part: float) -> list[float]:
    return [x + part * (y - x) for x, y in zip(a, b, strict=True)]


@settings(max_examples=150)
@given(points, points, points, points)
def test_legs_are_as_near_as_their_nearest_points(
    a: tuple[float, float, float],
    b: tuple[float, float, float],
    c: tuple[float, float, float],
    d: tuple[float, float, float],
) -> None:
    """No two points of them are nearer, and some are hardly farther."""
    found = between(a, b, c, d)
    steps = [i / 12 for i in range(13)]
    looked = min(dist(part_of(a, b, i), part_of(c, d, j)) for i in steps for j in steps)
    assert found <= looked + 1e-9
    assert looked - found <= (dist(a, b) + dist(c, d)) / 24 + 1e-9
    assert between(c, d, a, b) == pytest.approx(found, abs=1e-6)


@settings(max_examples=150)
@given(ways, ways, st.floats(0.1, 2))
def test_ways_meet_where_they_are_nearer_than_that(
    one: tuple[tuple[float, float, float], ...],
    other: tuple[tuple[float, float, float], ...],
    limit: float,
) -> None:
    """The quick answer is the exact one."""
    exact = nearest(one, other)
    if abs(exact - limit) > 1e-9:
        assert meets(one, other, limit) == (exact < limit)
    x, y, z, most_x, most_y, most_z = box_of(one)
    assert all(x <= p[0] <= most_x and y <= p[1] <= most_y and z <= p[2] <= most_z for p in one)


def test_other_heights_are_below_the_ceiling_and_not_below_where_drones_fly_anyway() -> None:
    """The smallest detour first; where a drone rests stays where it is."""
    section = Section("cf1", ((1, 1, 0), (1, 1, 1.2), (5, 1, 1.2), (5, 1, 0)), True, True)
    found = list(sections(section, 0.5, Airspace(ceiling=2.3)))
    heights = [[point[2] for point in way.points[1:-1]] for way in found]
    assert heights == [
        pytest.approx(each)
        for each in ([1.2, 1.2], [1.2, 1.7, 1.2], [1.7, 1.7], [1.2, 2.2, 1.2], [2.2, 2.2])
    ]
    assert found[1].points[2] == (3, 1, 1.7)
    assert {(way.points[0], way.points[-1]) for way in found} == {((1, 1, 0), (5, 1, 0))}
    high = Section("cf1", ((1, 1, 1.7), (5, 1, 1.7)), False, False)
    ways = [way.points for way in sections(high, 0.5, Airspace(ceiling=2.3))]
    assert ways[1] == ((1, 1, 1.7), (3, 1, 2.2), (5, 1, 1.7))
    assert ways[2] == ((1, 1, 1.7), (1, 1, 2.2), (5, 1, 2.2), (5, 1, 1.7))
    assert ways[4] == ((1, 1, 1.7), (1, 1, 1.2), (5, 1, 1.2), (5, 1, 1.7))
    assert len(ways) == 5


def test_a_long_way_may_go_higher() -> None:
    """As high as a twentieth of its length."""
    section = Section("cf1", ((0, 0, 1.2), (60, 0, 1.2)), False, False)
    heights = [way.points[1][2] for way in sections(section, 0.5, Airspace())]
    assert max(heights) == pytest.approx(4.2)
    up = Section("cf1", ((0, 0, 0), (0, 0, 1.2)), True, False)
    assert list(sections(up, 0.5, Airspace())) == [up]
