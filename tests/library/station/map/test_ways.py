"""Ways around no-fly areas, and the places of an area, as pages ask for them."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.missions import load_missions
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.ways import MOST_WAYS, DrawnWays
from tests.library.files.an_app import APP

LIFT = ((4.0, 0.0), (6.0, 0.0), (6.0, 6.0), (4.0, 6.0))
MAP = Airspace(size=(10.0, 8.0), no_fly=(LIFT,))


def test_a_way_leads_around_what_is_closed() -> None:
    """As it will be flown; there is none into it."""
    pairs = [[[1, 1], [1, 5]], [[1, 1, 1], [9, 1, 1]], [[1, 1], [5, 1]]]
    straight, around, none = asyncio.run(DrawnWays(MAP).ways(pairs))["ways"]
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
    swept = asyncio.run(DrawnWays(MAP).sweep(area))
    assert swept["targets"] == [[*trip.target] for trip in of_file.trips[1:]]
    assert swept["forbidden"] == pytest.approx(10 / 48)
    assert swept["metres"] > 20


def test_an_area_that_is_closed_cannot_be_swept() -> None:
    with pytest.raises(BadInput, match="nothing that may be flown over"):
        asyncio.run(DrawnWays(MAP).sweep({"polygon": [[4, 1], [6, 1], [6, 3]], "spacing": 1}))
    with pytest.raises(BadInput):
        asyncio.run(DrawnWays(MAP).ways([[]] * (MOST_WAYS + 1)))
