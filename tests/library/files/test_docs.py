"""What docs/files.md shows is what the files hold."""

from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path

from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.plan_check import problems
from pluto_fleet.files.reading import ELSEWHERE
from pluto_fleet.shared.domain.airspace import Airspace
from tests.library.files.an_app import APP, SURVEY
from tests.paths import ROOT

PAGE = (ROOT / "docs" / "files.md").read_text(encoding="utf-8")


def test_the_examples_are_a_plan_that_loads(tmp_path: Path) -> None:
    """The missions file, and the fleet file with its world, a carrier added."""
    parts = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    missions, (fleet, options, motion, world, on_earth) = parts[0], parts[-5:]
    carrier = '[[drone]]\nid = "cf3"\ncategory = "carrier"\nhome = [1.5, 0.5]\n'
    (tmp_path / "m.toml").write_text(missions, encoding="utf-8")
    (tmp_path / "f.toml").write_text(fleet + carrier + options + motion + world, encoding="utf-8")
    team = load_fleet(tmp_path / "f.toml", APP)
    flown = load_missions(tmp_path / "m.toml", APP, team.airspace)
    assert len(flown[0].trips) == 4
    assert team.world is not None
    left_out = {field.name for field in fields(team) if not getattr(team, field.name)}
    assert left_out == {
        "localization_options",  # goes with another localization
        "wind",  # is for multicopters outdoors
        "began",
    }
    assert problems(flown, APP, team, team.airspace) == []
    (tmp_path / "f.toml").write_text(on_earth + carrier, encoding="utf-8")
    assert load_fleet(tmp_path / "f.toml", APP).plane is not None


def test_the_example_of_promises_is_read(tmp_path: Path) -> None:
    """With a trip for each mission, and the one that is not shown."""
    promises = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)[1]
    trip = '\n[[mission.trip]]\naction = "take_photo"\ntarget = [1, 1]\n'
    parts = [*promises.split("\n\n"), '[[mission]]\nname = "Ward 1"']
    (tmp_path / "m.toml").write_text("".join(part + trip for part in parts), encoding="utf-8")
    assert [one.promises for one in load_missions(tmp_path / "m.toml", APP, Airspace())] == [
        {"opens": "08:00", "deadline": "08:30"},
        {"after": ["Ward 1", "Ward 2"], "deadline": 1200.0},
        {},
    ]


def test_the_examples_of_areas_and_lists_are_read(tmp_path: Path) -> None:
    """With the list that is shown beside its mission."""
    _, _, area, on_the_way, each, *_ = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    [rows] = re.findall(r"```\n(nr,.*?)```", PAGE, re.DOTALL)
    (tmp_path / "m.toml").write_text(area, encoding="utf-8")
    [field] = load_missions(tmp_path / "m.toml", APP, Airspace())
    assert [trip.name for trip in field.trips] == [f"Beds {n}" for n in range(1, 41)]
    assert field.trips[0].target[2] == 1.5
    (tmp_path / "m.toml").write_text(on_the_way, encoding="utf-8")
    strips = load_missions(tmp_path / "m.toml", SURVEY, Airspace())
    assert [one.name for one in strips] == [f"Strip {n}" for n in range(1, 6)]
    (tmp_path / "m.toml").write_text(each, encoding="utf-8")
    (tmp_path / "beds.csv").write_text(rows, encoding="utf-8")
    first, second = load_missions(tmp_path / "m.toml", APP, Airspace())
    assert (first.name, first.trips[0].name, first.trips[0].delay) == ("Bed 1", "tomatoes", 0.0)
    assert (second.trips[0].name, second.trips[0].delay) == ("peas, early", 90.0)


def test_the_page_has_every_further_field() -> None:
    """In the order in which messages know them."""
    rows = re.findall(r"^\| (mission|trip) \| `(\w+)`", PAGE, re.MULTILINE)
    assert rows == [(on, name) for on, names in ELSEWHERE.items() for name in names]
