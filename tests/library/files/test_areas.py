"""An area of a missions file becomes plain trips, from which all of it is covered."""

from __future__ import annotations

from itertools import pairwise
from math import dist
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files import areas
from pluto_fleet.files.missions import load_missions, missions_of
from pluto_fleet.files.reading import MadeOfArea, read
from pluto_fleet.files.writing import missions_text
from pluto_fleet.shared.domain.airspace import Airspace, Polygon
from pluto_fleet.shared.domain.errors import BadInput
from tests.areas import ENOUGH, drawn, judged
from tests.library.files.an_app import APP

BLOCK: Polygon = ((4.2, 2.2), (5.8, 2.2), (5.8, 3.8), (4.2, 3.8))
MAP = Airspace(size=(20.0, 12.0), no_fly=(BLOCK,), ceiling=4.0)
FIELD = """
polygon = [[1, 1], [9, 1], [9, 6], [1, 6]]
action = "take_photo"
spacing = "1 m"
"""


def mission(*parts: str) -> str:
    return '[[mission]]\nname = "M"\n' + "".join(parts)


def area(text: str = FIELD) -> str:
    return f"[[mission.area]]\n{text}"


def trips(folder: Path, text: str, airspace: Airspace = MAP) -> list[Any]:
    """Return the trips of the only mission of a file."""
    file = folder / "m.toml"
    file.write_text(text, encoding="utf-8")
    [found] = load_missions(file, APP, airspace)
    return list(found.trips)


def said(folder: Path, text: str, airspace: Airspace = MAP) -> str:
    """Return what is said of a file."""
    with pytest.raises(BadInput) as caught:
        trips(folder, text, airspace)
    return str(caught.value).replace(f"{folder}/", "")


@pytest.mark.parametrize("number", range(12))
def test_areas_drawn_by_chance_are_covered(number: int) -> None:
    """Concave and thin ones, at the map's edge, with no-fly areas in them."""
    found = judged(drawn(number), number)
    assert found.wrong == []
    assert found.covered >= ENOUGH


def test_a_field_is_swept_back_and_forth_along_its_longer_side(tmp_path: Path) -> None:
    """One trip a square, each next to the one before."""
    found = trips(tmp_path, mission(area()), Airspace())
    assert [trip.name for trip in found] == [f"area 1.{n}" for n in range(1, 41)]
    assert [trip.index for trip in found] == list(range(40))
    assert {trip.action for trip in found} == {"take_photo"}
    places = [trip.target for trip in found]
    assert places[:2] == [(1.5, 1.5, 1.2), (2.5, 1.5, 1.2)]
    assert places[7:9] == [(8.5, 1.5, 1.2), (8.5, 2.5, 1.2)]
    assert places[-1] == (1.5, 5.5, 1.2) or places[-1] == (8.5, 5.5, 1.2)
    assert {dist(a, b) for a, b in pairwise(places)} == {1.0}


def test_where_the_spacing_does_not_divide_a_side_the_places_are_spread_evenly(
    tmp_path: Path,
) -> None:
    text = FIELD.replace('"1 m"', '"1.6 m"').replace("[9, 1], [9, 6]", "[3, 1], [3, 6]")
    found = [trip.target for trip in trips(tmp_path, mission(area(text)), Airspace())]
    assert [x for x, *_ in found] == [1.5] * 4 + [2.5] * 4
    assert [y for _, y, _ in found[:4]] == [1.625, 2.875, 4.125, 5.375]


def test_its_trips_have_what_the_area_says(tmp_path: Path) -> None:
    """Parameters, fields, height and name are those of each."""
    text = """
name = "Field"
polygon = [[1, 1], ["300 cm", 1], [3, 2], [1, 2]]
action = "pollinate"
parameters = { dose = "40 mg" }
spacing = "1 m"
height = "150 cm"
delay = "30 s"
priority = 2
"""
    first, second = trips(tmp_path, mission(area(text)))
    assert [one.name for one in (first, second)] == ["Field 1", "Field 2"]
    assert (first.target, second.target) == ((1.5, 1.5, 1.5), (2.5, 1.5, 1.5))
    assert first.parameters["dose"] == pytest.approx(40e-6)
    assert first.parameters == second.parameters
    assert first.parameters is not second.parameters
    assert (second.delay, second.priority, second.item, second.source) == (30.0, 2, None, None)


def test_trips_come_first_and_then_the_areas_in_their_order(tmp_path: Path) -> None:
    """Wherever they stand in the mission; an area begins near to what was flown before it."""
    text = mission(
        area(FIELD + "height = 1\n"),
        '[[mission.trip]]\naction = "take_photo"\ntarget = [9, 7]\n',
        area(FIELD.replace("1 m", "5 m")),
        '[[mission.trip]]\naction = "take_photo"\ntarget = [9, 6.5]\n',
    )
    found = trips(tmp_path, text, Airspace())
    names = [trip.name for trip in found]
    assert names[:3] == ["1", "2", "area 1.1"]
    assert names[-2:] == ["area 2.1", "area 2.2"]
    assert found[2].target == (8.5, 5.5, 1.0)
    assert [trip.index for trip in found] == list(range(44))


def test_a_no_fly_area_in_it_is_flown_around(tmp_path: Path) -> None:
    """A place that may not be flown to is moved within its square; a square that is all forbidden has none."""
    found = [trip.target for trip in trips(tmp_path, mission(area()))]
    assert all(MAP.problem(place) is None for place in found)
    assert (4.2, 2.5, 1.2) in found
    away = Airspace(no_fly=(((4.0, 2.0), (6.0, 2.0), (6.0, 4.0), (4.0, 4.0)),))
    assert len(trips(tmp_path, mission(area()), away)) == 36


def test_what_it_has_become_is_known(tmp_path: Path) -> None:
    """How many trips, how long the way is, and how much may not be flown over."""
    file = tmp_path / "m.toml"
    file.write_text(mission(area(), area('name = "B"' + FIELD.replace("1 m", "9 m"))), "utf-8")
    document = read(file)
    [found] = missions_of(document, APP, MAP)
    first, second = document.areas
    assert first.trips == len(found.trips) - 1
    assert first.sentence == (
        'mission "M", area 1: 44 trips, 41.4 m from the first to the last; 6 % of it may not be flown over'
    )
    assert second.sentence.startswith('mission "M", area "B": 1 trip, 0 m from the first')
    assert document.is_made


U = "polygon = [[1, 1], [19, 1], [19, 11], [13, 11], [13, 4], [7, 4], [7, 11], [1, 11]]"
COMB = (
    "polygon = [[1, 1], [19, 1], [19, 11], [16, 11], [16, 4], [13, 4], [13, 11], [10, 11],"
    " [10, 4], [6, 4], [6, 11], [1, 11]]"
)


def made(folder: Path, polygon: str) -> MadeOfArea:
    """Return what has become of an area on a map without no-fly areas."""
    file = folder / "m.toml"
    text = f'{polygon}\naction = "take_photo"\nspacing = "1 m"\n'
    file.write_text(mission(area(text)), encoding="utf-8")
    document = read(file)
    missions_of(document, APP, Airspace(size=(20.0, 12.0)))
    [found] = document.areas
    return found


def test_an_area_like_a_u_is_flown_leg_by_leg_and_not_across_its_gap(tmp_path: Path) -> None:
    """Lane by lane, seven lanes would cross the six metres of the gap."""
    found = made(tmp_path, U)
    assert found.places == 138
    assert found.outside == 0.0
    assert found.metres < 150.0


def test_metres_that_are_not_over_an_area_are_told(tmp_path: Path) -> None:
    """Teeth stand apart: from the end of one to the next the way is shorter over what is between them."""
    assert "m of them not over the area" in made(tmp_path, COMB).sentence
    assert "not over" not in made(tmp_path, U).sentence


def test_they_are_written_as_plain_trips(tmp_path: Path) -> None:
    """And read as the same."""
    file = tmp_path / "m.toml"
    file.write_text(mission(area()), encoding="utf-8")
    missions = load_missions(file, APP, MAP)
    text = missions_text(APP, missions)
    assert "area]]" not in text
    assert [trip.target for trip in trips(tmp_path, text)] == [
        trip.target for trip in missions[0].trips
    ]


def test_the_areas_of_a_file_make_only_so_many_trips(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(areas, "MOST_IN_ALL", 50)
    told = said(tmp_path, mission(area(), area('name = "B"' + FIELD)))
    assert told.endswith(
        "with this area the file makes more than 50 trips, or has more than 10,000 areas: widen the spacing"
    )


def test_without_shapely_it_is_said_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(areas, "has", lambda _: False)
    told = said(tmp_path, mission(area()))
    assert told == (
        'm.toml:3: mission "M", area 1: an area needs shapely, the extra `areas` of pluto-fleet:'
        ' pip install "pluto-fleet[areas]", or "shapely>=2"'
    )
