"""Ways around no-fly areas, the places of an area, and what a point is called, as pages ask for them."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.landmarks import Landmarks, NamedPlace, Zone
from pluto_fleet.files.missions import load_missions
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.drawn import DrawnWays, name_of
from tests.library.files.an_app import APP, SURVEY

LIFT = ((4.0, 0.0), (6.0, 0.0), (6.0, 6.0), (4.0, 6.0))
MAP = Airspace(size=(10.0, 8.0), no_fly=(LIFT,))


def test_a_way_leads_around_what_is_closed() -> None:
    """As it will be flown; there is none into it."""
    pairs = [[[1, 1], [1, 5]], [[1, 1, 1], [9, 1, 1]], [[1, 1], [5, 1]]]
    straight, around, none = asyncio.run(DrawnWays(APP, MAP).ways(pairs))["ways"]
    assert straight == [[1.0, 1.0, 1.2], [1.0, 5.0, 1.2]]
    route = MAP.route((1.0, 1.0, 1.0), (9.0, 1.0, 1.0))
    assert route is not None and around is not None
    assert around == [[1.0, 1.0, 1.0], *([round(n, 3) for n in point] for point in route)]
    assert len(around) == 4
    assert none is None


def test_an_area_is_swept_as_that_of_a_file(tmp_path: Path) -> None:
    """With the same places in the same order."""
    corners = [[1, 1], [9, 1], [9, 7], [1, 7]]
    (tmp_path / "m.toml").write_text(
        f'[[mission]]\n[[mission.trip]]\naction = "measure"\ntarget = [9, 7]\n[[mission.area]]\n'
        f'polygon = {corners}\nspacing = "2 m"\nheight = 2\naction = "measure"\n'
    )
    [of_file] = load_missions(tmp_path / "m.toml", APP, MAP)
    area: dict[str, Any] = {"polygon": corners, "spacing": "2 m", "height": 2, "before": [9, 7]}
    swept = asyncio.run(DrawnWays(APP, MAP).sweep(area))
    assert [one["target"] for one in swept["trips"]] == [[*t.target] for t in of_file.trips[1:]]
    assert {one["source"] for one in swept["trips"]} == {None}
    assert swept["places"] == len(swept["trips"])
    assert swept["seconds"] is None  # it was not said what is done there
    assert swept["forbidden"] == pytest.approx(10 / 48)
    assert swept["metres"] > 20


def test_an_area_is_swept_along_lines() -> None:
    """With fewer trips, for as many photos, in less time."""
    area: dict[str, Any] = {"polygon": [[1, 1], [3, 1], [3, 7], [1, 7]], "spacing": "1 m"}
    area["action"] = "take_photo"
    stops = asyncio.run(DrawnWays(SURVEY, MAP).sweep({**area}))
    lines = asyncio.run(DrawnWays(SURVEY, MAP).sweep({**area, "on_the_way": True}))
    assert [len(one["trips"]) for one in (stops, lines)] == [12, 2]
    assert lines["trips"][0] == {"target": [1.5, 6.5, 1.2], "source": [1.5, 1.5, 1.2], "every": 1.0}
    assert stops["places"] == lines["places"] == 12
    assert stops["metres"] == lines["metres"] == 11.0
    assert lines["seconds"] == 11.0 + 2 * 1.0
    assert stops["seconds"] == 11.0 + 12 * 1.0


def test_it_is_told_how_much_of_the_way_is_not_over_an_area() -> None:
    """From one tooth of a comb to the next the way is shorter over what is between them."""
    comb = [[1, 1], [9, 1], [9, 7], [7, 7], [7, 3], [5, 3], [5, 7], [3, 7], [3, 3], [1, 3]]
    open_map = DrawnWays(APP, Airspace(size=(10.0, 8.0)))
    swept = asyncio.run(open_map.sweep({"polygon": comb, "spacing": "1 m"}))
    assert 0.5 < swept["outside"] < swept["metres"]


def test_an_area_that_is_closed_cannot_be_swept() -> None:
    with pytest.raises(BadInput, match="nothing that may be flown over"):
        asyncio.run(DrawnWays(APP, MAP).sweep({"polygon": [[4, 1], [6, 1], [6, 3]], "spacing": 1}))


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
