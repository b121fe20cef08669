"""The map: where a drone may be, and the shortest way there."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise, product
from math import atan2, cos, dist, hypot, nan, pi, sin

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from pluto_fleet.shared.domain.airspace import MARGIN, Airspace, enters, permitted_way, tidy
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Point

Polygon = tuple[tuple[float, float], ...]

WALL: Polygon = ((8, 2), (9, 2), (9, 5), (8, 5))
# open to the right: a drone in the middle must come out there
CUP: Polygon = ((5, 5), (12, 5), (12, 6), (6, 6), (6, 9), (12, 9), (12, 10), (5, 10))

coordinate = st.floats(0, 20).map(lambda value: round(value, 3))
height = st.floats(0, 10).map(lambda value: round(value, 3))
places = st.tuples(coordinate, coordinate, height)


@st.composite
def stars(draw: st.DrawFn) -> Polygon:
    """A polygon without crossings, mostly concave, either way around."""
    x, y = draw(st.floats(3, 17)), draw(st.floats(3, 17))
    number = draw(st.integers(3, 9))
    turn = draw(st.floats(0, 2 * pi))
    radii = [draw(st.floats(0.3, 4)) for _ in range(number)]
    corners = [
        (x + r * cos(turn + 2 * pi * i / number), y + r * sin(turn + 2 * pi * i / number))
        for i, r in enumerate(radii)
    ]
    return tuple(corners if draw(st.booleans()) else corners[::-1])


maps = st.lists(stars(), min_size=1, max_size=4).map(lambda areas: Airspace(no_fly=tuple(areas)))


def well_inside(x: float, y: float, polygon: Polygon) -> bool:
    """Whether the polygon winds around the point, which is not near its outline; another way."""
    turned = 0.0
    for (ax, ay), (bx, by) in pairwise((*polygon, polygon[0])):
        long = hypot(bx - ax, by - ay)
        along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / long**2 if long else 0.0
        along = min(1.0, max(0.0, along))
        if hypot(x - ax - along * (bx - ax), y - ay - along * (by - ay)) < 1e-4:
            return False
        step = atan2(by - y, bx - x) - atan2(ay - y, ax - x)
        turned += (step + pi) % (2 * pi) - pi
    return abs(turned) > 1


def length(start: Point, way: Sequence[Point]) -> float:
    """Return the metres of a way, from its start on."""
    return sum(dist(a, b) for a, b in pairwise((start, *way)))


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ((25, 3, 1), "(25, 3) is outside the map: x goes from 0 to 20 m, y from 0 to 12 m"),
        ((3, -0.1, 1), "(3, -0.1) is outside the map: x goes from 0 to 20 m, y from 0 to 12 m"),
        ((nan, 3, 1), "(nan, 3) is outside the map: x goes from 0 to 20 m, y from 0 to 12 m"),
        ((3, 3, 4.5), "(3, 3) at a height of 4.5 m is above the ceiling of 4 m"),
        ((3, 3, -1), "(3, 3) at a height of -1 m is below the ground"),
        ((8.5, 3, 1), "(8.5, 3) is inside no-fly area 2"),
        ((8, 3, 1), None),
        ((0, 0, 0), None),
        ((20, 12, 4), None),
    ],
)
def test_a_place_is_refused_in_words(point: Point, message: str | None) -> None:
    """A place is refused with what is wrong with it; edges belong to what is permitted."""
    triangle = ((1.0, 8.0), (2.0, 8.0), (1.5, 9.0))
    assert Airspace(size=(20, 12), ceiling=4, no_fly=(triangle, WALL)).problem(point) == message


def test_touching_is_not_entering() -> None:
    """A leg along an edge, or through a corner, is straight."""
    airspace = Airspace(no_fly=(WALL,))
    assert airspace.route((8, 0, 1), (8, 7, 1)) == ((8, 7, 1),)
    assert airspace.route((7, 1, 1), (9, 3, 1)) is not None
    assert airspace.route((6, 4, 1), (10, 6, 1)) == ((10, 6, 1),)  # through the corner (8, 5)


def test_a_wall_is_walked_around_at_its_shorter_side() -> None:
    """The way turns a margin off the corners, and its height changes evenly."""
    way = Airspace(no_fly=(WALL,)).route((6, 3, 1), (11, 3, 2))
    assert way is not None
    first, second, end = way
    assert first[:2] == pytest.approx((8 - MARGIN, 2 - MARGIN))
    assert second[:2] == pytest.approx((9 + MARGIN, 2 - MARGIN))
    assert end == (11, 3, 2)
    there = hypot(1.9, 1.1)
    assert first[2] == pytest.approx(1 + there / (2 * there + 1.2))


def test_a_drone_leaves_a_concave_area_by_its_mouth() -> None:
    """From inside a cup the way goes out and around."""
    way = Airspace(no_fly=(CUP,)).route((8, 7, 1), (2, 7, 1))
    assert way is not None
    assert way[0][0] == pytest.approx(12 + MARGIN)
    assert len(way) == 4


def test_there_may_be_no_way() -> None:
    """A map cut in two, or a gap that is narrower than the margin, gives none."""
    assert (
        Airspace(no_fly=(((8, 0), (9, 0), (9, 20), (8, 20)),)).route((1, 1, 1), (15, 1, 1)) is None
    )
    lower, upper = ((8.0, 0), (9.0, 0), (9.0, 9), (8.0, 9)), (
        (8.0, 9.05),
        (9, 9.05),
        (9, 20),
        (8, 20),
    )
    assert Airspace(no_fly=(lower, upper)).route((1, 1, 1), (15, 1, 1)) is None


def test_a_drone_for_which_there_is_no_way_is_told_so() -> None:
    cut_in_two = Airspace(no_fly=(((8, 0), (9, 0), (9, 20), (8, 20)),))
    with pytest.raises(
        FlightFailed, match=r"there is no permitted way from cf1 to \(15, 1\)"
    ) as no:
        permitted_way(cut_in_two, "cf1", (1, 1, 1), (15, 1, 1))
    assert no.value.failure is Failure.REFUSED


def test_a_needle_is_not_given_a_wide_berth() -> None:
    """Around a very sharp corner the way stays near it."""
    needle = ((0.0, 10.0), (10.0, 9.999), (10.0, 10.001))
    spike = ((10.0, 5.0), (10.01, 15.0), (9.99, 15.0))
    for area, start, end in (
        (needle, (9.0, 9.0, 1.0), (9.0, 11.0, 1.0)),
        (spike, (9.0, 6.0, 1.0), (11.0, 6.0, 1.0)),
    ):
        way = Airspace(no_fly=(area,)).route(start, end)
        assert way is not None
        assert length(start, way) < 5


def test_areas_without_an_inside_forbid_nothing() -> None:
    """A point, a line and a repeated corner are not in the way."""
    odd = (((5.0, 5.0),), ((5.0, 0.0), (5.0, 20.0)), ((6.0, 0.0), (6.0, 9.0), (6.0, 3.0)), ())
    assert Airspace(no_fly=odd).route((1, 5, 1), (15, 5, 1)) == ((15, 5, 1),)
    closed = (WALL[0], *WALL, WALL[0])
    assert Airspace(no_fly=(closed,)).route((6, 3, 1), (11, 3, 2)) == Airspace(
        no_fly=(WALL,)
    ).route((6, 3, 1), (11, 3, 2))


@given(maps, places, places)
@example(Airspace(no_fly=(CUP,)), (8, 7, 0), (5, 7, 9))
@example(Airspace(no_fly=(WALL, CUP)), (7, 8, 1), (19, 7, 1))
def test_a_way_enters_nothing(airspace: Airspace, start: Point, end: Point) -> None:
    """No way goes through an area, off the map or above the ceiling; it ends where it should."""
    assume(airspace.problem(start) is None and airspace.problem(end) is None)
    way = airspace.route(start, end)
    if way is None:
        return
    assert way[-1] == end
    for a, b in pairwise((start, *way)):
        steps = max(2, int(dist(a, b) * 20))
        for i in range(steps + 1):
            x, y, z = (p + (q - p) * i / steps for p, q in zip(a, b, strict=True))
            assert -1e-6 <= x <= 20 + 1e-6 and -1e-6 <= y <= 20 + 1e-6 and -1e-6 <= z <= 10 + 1e-6
            assert not any(well_inside(x, y, area) for area in airspace.no_fly)


@given(st.lists(st.tuples(st.floats(4, 15), st.floats(4, 15)), min_size=1, max_size=4))
def test_a_way_is_the_shortest(corners: list[tuple[float, float]]) -> None:
    """Among squares the way is no longer than any over one or two of their pushed-out corners."""
    squares = tuple(((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)) for x, y in corners)
    airspace = Airspace(no_fly=squares)
    start, end = (1.0, 8.0, 1.0), (19.0, 9.0, 1.0)
    way = airspace.route(start, end)
    turns = [
        (x + dx, y + dy, 1.0)
        for x, y in corners
        for dx in (-MARGIN, 1 + MARGIN)
        for dy in (-MARGIN, 1 + MARGIN)
    ]

    def free(*points: Point) -> bool:
        return not any(
            enters(a[:2], b[:2], square)
            for a, b in pairwise(points)
            for square in map(tidy, squares)
        )

    for other in product(turns, repeat=2):
        if free(start, *other, end):
            assert way is not None
            assert length(start, way) <= length(start, (*other, end)) + 1e-6
