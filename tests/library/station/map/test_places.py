"""What a point of the map is called."""

from __future__ import annotations

import pytest

from pluto_fleet.files.landmarks import Landmarks, NamedPlace, Zone
from pluto_fleet.station.places import name_of

WARD = Landmarks(
    places=(NamedPlace(name="Bed", at=(2.0, 2.0)), NamedPlace(name="Chair", at=(2.6, 2.0, 0.5))),
    zones=(
        Zone(name="House", corners=((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0))),
        Zone(name="Room", corners=((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))),
    ),
)


@pytest.mark.parametrize(
    ("point", "name"),
    [
        ((2.0, 2.0), "Bed"),
        ((1.5, 2.0, 3.0), "Bed"),
        ((2.4, 2.0), "Chair"),
        ((1.4, 2.0), "Room"),
        ((4.0, 4.0), "Room"),
        ((5.0, 4.0), "House"),
        ((11.0, 4.0), None),
    ],
)
def test_a_point_is_at_the_nearest_place_or_in_the_smallest_zone(
    point: tuple[float, ...], name: str | None
) -> None:
    """A place within half a metre comes first; an edge belongs to its zone."""
    assert name_of(WARD, point) == name


def test_where_nothing_has_a_name_no_point_has() -> None:
    assert name_of(Landmarks(), (1.0, 1.0)) is None
