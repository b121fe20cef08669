"""What simulated sensors see."""

from __future__ import annotations

from collections import Counter
from statistics import mean, pstdev

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pluto_fleet.shared.alone.world import World, invented
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import Feature, Source, WorldData

MAP = Airspace(size=(20.0, 10.0))
DUST = Source(quantity="pm10", at=(5.0, 5.0), peak=80.0, radius=2.0)
BLOOM = Feature(kind="bloom", at=(5.0, 5.0), radius=0.3)
PEST = Feature(kind="pest", at=(5.5, 5.2))


def test_far_from_everything_there_is_the_background() -> None:
    """Temperature and dust have one; what was not described is nought."""
    world = World(1, MAP, WorldData())
    assert world.measure("temperature", (1, 1, 1), 0) == pytest.approx(21, abs=0.2)
    assert world.measure("pm10", (1, 1, 1), 0) == pytest.approx(20, abs=0.2)
    assert world.measure("gas", (1, 1, 1), 0) == 0


def test_a_source_is_highest_in_its_middle() -> None:
    """It adds its peak there, and e^-½ of it a radius away; other quantities do not notice."""
    world = World(1, MAP, WorldData(sources=(DUST,)))
    assert world.measure("pm10", (5, 5, 1), 0) == pytest.approx(100, rel=0.01)
    assert world.measure("pm10", (7, 5, 1), 0) == pytest.approx(20 + 80 * 0.6065, rel=0.01)
    assert world.measure("temperature", (5, 5, 1), 0) == pytest.approx(21, abs=0.2)


def test_a_measurement_depends_on_nothing_that_went_before() -> None:
    """The same question has the same answer, in any order; another time, another error."""
    one, other = World(7, MAP), World(7, MAP)
    expected = one.measure("pm10", (5, 5, 1), 3)
    other.photo((1, 1, 1), 0)
    other.measure("pm10", (4, 5, 1), 3)
    assert other.measure("pm10", (5, 5, 1), 3) == expected
    assert len({one.measure("pm10", (5, 5, 1), time) for time in range(20)}) > 10
    assert World(8, MAP, WorldData()).measure("pm10", (5, 5, 1), 3) != World(
        9, MAP, WorldData()
    ).measure("pm10", (5, 5, 1), 3)


def test_a_photo_shows_what_is_under_it() -> None:
    """One word for each thing in the footprint, sorted; nothing beyond it."""
    away = Feature(kind="bloom", at=(9.0, 9.0))
    world = World(1, MAP, WorldData(features=(PEST, away, BLOOM, BLOOM)))
    assert world.photo((5.2, 5.1, 2), 0).sees == ("bloom", "bloom", "pest")
    assert world.photo((1, 1, 1), 0).sees == ()


def test_the_ground_on_a_photo_grows_with_height() -> None:
    """1.6 m across and 1.2 m along for each metre of height."""
    photo = World(1, MAP).photo((5, 5, 2), 0)
    assert (photo.width, photo.height) == (3.2, 2.4)
    assert World(1, MAP).photo((5, 5, 0), 0).width == 0


@given(st.floats(0, 20), st.floats(0, 10), st.floats(0.5, 10), st.integers(0, 99))
def test_a_photo_sees_exactly_its_footprint(x: float, y: float, z: float, seed: int) -> None:
    """However many things there are, those seen are those inside."""
    world = World(seed, MAP)
    photo = world.photo((x, y, z), 1.5)
    left, bottom = photo.position[0] - photo.width / 2, photo.position[1] - photo.height / 2
    right = left + photo.width
    top = bottom + photo.height
    for feature in world.features:  # sums of floats do not say what lies exactly on an edge
        assume(min(abs(feature.at[0] - left), abs(feature.at[0] - right)) > 1e-9)
        assume(min(abs(feature.at[1] - bottom), abs(feature.at[1] - top)) > 1e-9)
    expected = sorted(
        feature.kind
        for feature in world.features
        if left <= feature.at[0] <= right and bottom <= feature.at[1] <= top
    )
    assert list(photo.sees) == expected


def test_drones_are_a_little_off_and_some_photos_blurred() -> None:
    """The camera is 5 cm off, one photo in ten is not sharp, and numbers end at millimetres."""
    world = World(3, MAP)
    photos = [world.photo((5, 5, 1), time) for time in range(2000)]
    for axis in (0, 1):
        values = [photo.position[axis] for photo in photos]
        assert mean(values) == pytest.approx(5, abs=0.01)
        assert pstdev(values) == pytest.approx(0.05, rel=0.1)
        assert all(value == round(value, 3) for value in values)
    blurred = [photo.sharpness for photo in photos if photo.sharpness < 1]
    assert len(blurred) == pytest.approx(200, rel=0.3)
    assert all(0.3 <= sharpness <= 0.6 for sharpness in blurred)


def test_a_world_is_made_up_where_none_is_described() -> None:
    """About one thing for each 4 m², two places with dust, one warm place, all on the map."""
    data = invented(5, MAP)
    assert len(data.features) == 50
    assert {feature.kind for feature in data.features} == {"bloom", "pest", "disease"}
    assert Counter(source.quantity for source in data.sources) == {"pm10": 2, "temperature": 1}
    places = [feature.at for feature in data.features] + [source.at for source in data.sources]
    assert all(0 <= x <= 20 and 0 <= y <= 10 for x, y in places)
    assert World(5, MAP).features == sorted(data.features, key=lambda feature: feature.at)
    assert invented(6, MAP) != data
