"""An area whose action is done on the way becomes few lines, from which all of it is covered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import ceil, dist
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.plan_check import impossible
from pluto_fleet.files.reading import parsed
from pluto_fleet.files.writing import missions_text
from pluto_fleet.shared.domain.airspace import Airspace, Corner, Polygon
from pluto_fleet.shared.domain.errors import BadInput
from tests.areas import ENOUGH, drawn, share_covered, strewn
from tests.kit.apps import changed
from tests.library.files.an_app import APP, SURVEY

OPEN = Airspace(size=(20.0, 12.0))
DIG = """
[[mission]]
name = "Strip"

  [[mission.area]]
  name = "Dig"
  polygon = [[1, 1], [9, 1], [9, 4], [1, 4]]
  action = "take_photo"
  spacing = "1 m"
  on_the_way = true
"""


def missions(text: str, airspace: Airspace = OPEN, app: App = SURVEY) -> list[Any]:
    return missions_of(parsed("m.toml", text), app, airspace)


def said(text: str, airspace: Airspace = OPEN, app: App = SURVEY) -> str:
    with pytest.raises(BadInput) as caught:
        missions(text, airspace, app)
    return str(caught.value)


def spots(trip: Any) -> Iterator[Corner]:
    """Yield the places at which photos of a trip are taken."""
    start = trip.source or trip.target
    parts = round(dist(start, trip.target) / trip.along["metres"]) if trip.along else 0
    for number in range(parts + 1):
        part = number / max(1, parts)
        x, y = (a + part * (b - a) for a, b in zip(start[:2], trip.target[:2], strict=True))
        yield x, y


def test_each_lane_is_a_line_back_and_forth() -> None:
    [mission] = missions(DIG)
    assert [(one.name, one.source, one.target) for one in mission.trips] == [
        ("Dig 1", (1.5, 1.5, 1.2), (8.5, 1.5, 1.2)),
        ("Dig 2", (8.5, 2.5, 1.2), (1.5, 2.5, 1.2)),
        ("Dig 3", (1.5, 3.5, 1.2), (8.5, 3.5, 1.2)),
    ]
    assert {one.action for one in mission.trips} == {"take_photo"}
    for trip in mission.trips:
        assert trip.along == {"action": "take_photo", "parameters": {}, "metres": 1.0}


def test_parameters_are_those_of_what_is_done_on_the_way(tmp_path: Path) -> None:
    text = DIG.replace('"take_photo"', '"measure"\nparameters = { quantity = "pm10" }')
    first = missions(text)[0].trips[0]
    assert first.along["parameters"] == first.parameters == {"quantity": "pm10"}


def test_the_spacing_is_what_leaves_photos_their_overlap() -> None:
    """Lanes lead along x, where a photo from 1.2 m shows 1.92 m, and 1.44 m along y."""
    text = DIG.replace('spacing = "1 m"', 'overlap = ["55 %", "25 %"]')
    trips = missions(text)[0].trips
    assert len(trips) == ceil(3 / (1.44 * 0.75))
    assert trips[0].along["metres"] == pytest.approx(8 / ceil(8 / (1.92 * 0.45)), abs=1e-3)
    turned = text.replace("[9, 1], [9, 4], [1, 4]", "[4, 1], [4, 9], [1, 9]")
    trips = missions(turned)[0].trips
    assert len(trips) == ceil(3 / (1.92 * 0.75))
    assert trips[0].along["metres"] == pytest.approx(8 / ceil(8 / (1.44 * 0.45)), abs=1e-3)


def test_another_camera_sees_less() -> None:
    text = DIG.replace('spacing = "1 m"', 'overlap = "50 %"\ncamera_view = ["60 deg", "45 deg"]')
    assert len(missions(text)[0].trips) == ceil(3 / (2 * 1.2 * 0.41421 * 0.5))


def test_lanes_are_missions_that_are_flown_side_by_side() -> None:
    """Also where they stop at each place."""
    text = DIG + "  side_by_side = true\n"
    found = missions(text)
    assert [(one.name, one.index) for one in found] == [
        ("Strip 1", 0),
        ("Strip 2", 1),
        ("Strip 3", 2),
    ]
    assert [[trip.name for trip in one.trips] for one in found] == [["Dig 1"], ["Dig 2"], ["Dig 3"]]
    stops = missions(text.replace("on_the_way = true", ""))
    assert [len(one.trips) for one in stops] == [8, 8, 8]
    assert {trip.along for one in stops for trip in one.trips} == {None}


def test_missions_side_by_side_have_names_of_their_own() -> None:
    text = f"{DIG}  side_by_side = true\n"
    other = '[[mission]]\nname = "Strip 2"\n[[mission.trip]]\naction = "measure"\ntarget = [1, 1]\n'
    assert 'there is another mission "Strip 2"' in said(other + text)
    beside = f'{text}  [[mission.trip]]\n  action = "measure"\n  target = [1, 1]\n'
    assert "its own may have nothing else" in said(beside)


def test_a_line_ends_at_what_is_closed() -> None:
    tent: Polygon = ((4.2, 2.2), (5.8, 2.2), (5.8, 2.8), (4.2, 2.8))
    [mission] = missions(DIG, replace(OPEN, no_fly=(tent,)))
    for trip in mission.trips:
        if trip.source:
            assert replace(OPEN, no_fly=(tent,)).route(trip.source, trip.target) == (trip.target,)
    assert len(mission.trips) > 4


def test_no_line_takes_more_than_a_third_of_a_battery() -> None:
    """480 s above the reserve take 160 m at 1 m/s; a third line of 8 m is in two parts at 5 m."""
    assert len(missions(DIG)[0].trips) == 3
    category = replace(SURVEY.categories[0], flight_time=18.75)
    [mission] = missions(DIG, app=changed(SURVEY, categories=(category,)))
    assert [len([*spots(one)]) for one in mission.trips] == [4, 4] * 3
    assert max(dist(one.source, one.target) for one in mission.trips) == pytest.approx(3.0)


@pytest.mark.parametrize("number", [*range(12), 154])
def test_areas_drawn_by_chance_are_covered(number: int) -> None:
    """Concave and thin ones, at the map's edge, with no-fly areas in them."""
    area = drawn(number)
    spacing = max(0.1, area.spacing)
    text = DIG.replace('"1 m"', f"{spacing}")
    text = text.replace("[[1, 1], [9, 1], [9, 4], [1, 4]]", f"{[[*one] for one in area.corners]}")
    points = strewn(area, number)
    try:
        [mission] = missions(text, area.airspace)
    except BadInput as error:
        assert "covers nothing" in str(error)
        return
    places = [spot for trip in mission.trips for spot in spots(trip)]
    assert share_covered(points, places, spacing) >= ENOUGH
    for trip in mission.trips:
        assert area.airspace.problem(trip.target) is None


def test_they_are_written_as_plain_trips_and_read_as_the_same() -> None:
    found = missions(DIG)
    text = missions_text(SURVEY, found)
    assert 'every = "1 m"' in text
    again = missions(text)
    assert [one.along for one in again[0].trips] == [one.along for one in found[0].trips]


def test_what_cannot_be_done_on_the_way_is_told() -> None:
    assert "only take_photo and measure can" in said(DIG.replace("take_photo", "release_item"))
    able: Any = SURVEY.fields[-1]
    app = changed(SURVEY, fields=(*SURVEY.fields[:-1], replace(able, actions=("measure",))))
    assert (
        "the app does not take_photo on the way: declare `action take_photo along` in it"
        in said(DIG, app=app)
    )
    assert "declare `action take_photo along` in it" in said(DIG, app=APP)
    assert "leaves too little between two places: on the way 0.1 m are the least" in said(
        DIG.replace('"1 m"', '"6 cm"').replace("9", "2").replace("4", "2")
    )
    along = 'along = { action = "measure", every = "1 m" }'
    assert "leave out along" in said(f"{DIG}  {along}\n")
    assert "leave out one" in said(f'{DIG}  overlap = "50 %"\n')


def test_a_promise_that_a_line_is_too_long_for_is_told() -> None:
    """Its drone comes back to where it took off, and has been far away meanwhile."""
    line = 'source = [20, 1]\n  target = [1, 1]\n  along = { action = "take_photo", every = "1 m" }'
    text = f"""
[[mission]]
deadline = "30 s"
  [[mission.trip]]
  action = "take_photo"
  {line}
"""
    drone = DroneEntry(id="cf1", category="scout", home=(1.0, 1.0, 0.0))
    team = FleetFile(airspace=OPEN, drones=(drone,))
    (told,) = impossible(missions(text), SURVEY, team)
    assert "due after 30 s, and takes" in told
    assert impossible(missions(text.replace("[20, 1]", "[5, 1]")), SURVEY, team) == []
