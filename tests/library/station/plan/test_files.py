"""From a plan to a missions file and back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.fleet import DroneEntry, default_fleet
from pluto_fleet.files.landmarks import Landmarks, NamedPlace
from pluto_fleet.files.missions import load_missions
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.station.plan.plan import MissionPlan
from tests.kit.apps import changed
from tests.library.files.an_app import APP, SURVEY
from tests.library.files.test_missions import FULL
from tests.library.station.plan.drawing import (
    FLEET,
    a_plan,
    drawn,
    mission,
    said,
    trip,
)

FILE = (
    FULL.lstrip()
    .replace('"80 cm"]', "0.8]")
    .replace("17:15:30", '"17:15:30"')
    .replace(
        '\n[[mission.trip]]\naction = "measure"\n',
        '\n\n  [[mission.trip]]\n  action = "measure"\n  ',
    )
)
"""The same as a plan writes it: JSON has no times of day, and pages no heights in words."""


LINES = replace(FLEET, drones=(DroneEntry(id="cf1", category="scout", home=(1.0, 1.0, 0.0)),))
"""A fleet for lines."""


def imported(text: str) -> MissionPlan:
    plan = a_plan()
    plan.import_toml(text, plan.revision)
    return plan


def facts(missions: list[Mission[Any]]) -> list[object]:
    """Return all that missions are made of, to be compared."""
    of_mission = ("name", "index", *(f.name for f in APP.fields if f.on.value == "mission"))
    of_trip = ("name", "index", "action", "target", "source", "parameters", "item", "delay")
    return [
        (
            [getattr(one, name) for name in of_mission],
            [[getattr(trip, name) for name in (*of_trip, "priority")] for trip in one.trips],
        )
        for one in missions
    ]


def test_a_file_comes_back_as_its_writer_wrote_it() -> None:
    """With its quantities, its order, and places as one draws them."""
    assert imported(FULL).export_toml() == FILE
    unnamed = FILE.replace('name = "South field"\n', "").replace("04 }", "040 }")
    assert imported(unnamed).export_toml() == FILE.replace("South field", "2")


def test_the_whole_of_a_file_is_taken(tmp_path: Path) -> None:
    """Each mission that a file's reader finds, with everything in it."""
    file = tmp_path / "m.toml"
    file.write_text(FULL, encoding="utf-8")
    assert facts(imported(FULL).launchable()[0]) == facts(load_missions(file, APP, FLEET.airspace))


def test_an_area_is_taken_as_plain_trips() -> None:
    """And handed out so; missions beside it stay as they were typed."""
    area = """
  [[mission.area]]
  polygon = [[1, 1], [5, 1], [5, 3], [1, 3]]
  action = "take_photo"
  spacing = "2 m"
  delay = "1 min"
"""
    plan = imported(f'{FILE}\n[[mission]]\nname = "Field"\n{area}')
    text = plan.export_toml()
    assert text.startswith(FILE)
    assert text.removeprefix(FILE).count("[[mission.trip]]") == 2
    assert 'name = "area 1.2"' in text
    assert "area]]" not in text
    assert facts(imported(text).launchable()[0]) == facts(plan.launchable()[0])
    assert plan.launchable()[0][-1].trips[0].delay == 60.0


def test_an_area_that_is_photographed_on_the_way_is_taken_as_lines() -> None:
    """They fly as those of a file do, and are handed out so."""
    text = """
[[mission]]
name = "Strip"
  [[mission.area]]
  polygon = [[1, 1], [5, 1], [5, 3], [1, 3]]
  action = "take_photo"
  spacing = "1 m"
  on_the_way = true
  side_by_side = true
"""
    plan = MissionPlan(SURVEY, LINES, None)
    plan.import_toml(text, plan.revision)
    flown, _ = plan.launchable()
    assert [one.name for one in flown] == ["Strip 1", "Strip 2"]
    [line] = flown[0].trips
    assert (line.source, line.target) == ((1.5, 1.5, 1.2), (4.5, 1.5, 1.2))
    assert line.along == {"action": "take_photo", "parameters": {}, "metres": 1.0}
    again = MissionPlan(SURVEY, LINES, None)
    again.import_toml(plan.export_toml(), again.revision)
    [same] = again.launchable()[0][0].trips
    assert (same.source, same.target, same.along) == (line.source, line.target, line.along)


def test_a_line_that_no_battery_is_enough_for_is_told() -> None:
    """By the way to its beginning, along it, and home."""
    weak = replace(SURVEY.categories[0], flight_time=40.0)
    plan = MissionPlan(changed(SURVEY, categories=(weak,)), LINES, None)
    text = """
[[mission]]
  [[mission.trip]]
  action = "take_photo"
  source = [2, 1]
  target = [19, 1]
  along = { action = "take_photo", every = "1 m" }
"""
    plan.import_toml(text, plan.revision)
    with pytest.raises(BadInput, match="of a full battery from its home"):
        plan.launchable()
    plan.import_toml(text.replace("19", "9"), plan.revision)
    assert len(plan.launchable()[0]) == 1


def test_a_list_beside_a_file_is_taken_as_plain_missions(tmp_path: Path) -> None:
    """One that a page sends has none beside it."""
    (tmp_path / "beds.csv").write_text("nr,x\n1,2\n2,3\n", encoding="utf-8")
    text = """
[[mission]]
name = "Bed {nr}"
each = "beds.csv"
  [[mission.trip]]
  action = "measure"
  target = ["{x}", 1]
"""
    plan = a_plan()
    plan.import_toml(text, plan.revision, "m.toml", tmp_path)
    assert [mission.name for mission in plan.launchable()[0]] == ["Bed 1", "Bed 2"]
    text_now = plan.export_toml()
    assert "each" not in text_now and "delay" not in text_now  # what was left out stays the default
    with pytest.raises(BadInput, match="lies beside a missions file, and this one is in no folder"):
        plan.import_toml(text, plan.revision)


def test_what_is_done_on_the_way_and_what_is_followed_come_back_as_they_were(
    tmp_path: Path,
) -> None:
    """And the next station takes them from where they are kept."""
    text = """
[[mission]]
name = "Watch"

  [[mission.trip]]
  action = "take_photo"
  source = [1.0, 1.5]
  target = [9.0, 1.5]
  along = { action = "take_photo", every = "2 m" }

  [[mission.trip]]
  action = "take_photo"
  target = { track = "t7", reach = "1 m" }
"""
    keep = tmp_path / "plan.json"
    fleet = default_fleet(SURVEY)
    plan = a_plan(keep, fleet, app=SURVEY)
    plan.import_toml(text, plan.revision)
    data: Any = plan.data()
    assert data["problems"] == []
    sweep, chase = data["missions"][0]["trips"]
    assert sweep["along"] == {"action": "take_photo", "every": "2 m"}
    assert (chase["target"], chase["track"], chase["reach"]) == (None, "t7", "1 m")
    for again in (plan, a_plan(keep, fleet, app=SURVEY)):
        assert again.export_toml() == text.lstrip()
    [mission] = plan.launchable()[0]
    assert (mission.trips[0].along["metres"], mission.trips[1].track) == (2.0, "t7")


def test_what_is_wrong_on_the_way_is_said_of_that_field() -> None:
    plan = a_plan(fleet=default_fleet(SURVEY), app=SURVEY)
    wrong = [trip("trip-none", along={"action": "dance"}), trip("trip-once", along="take_photo")]
    plan.replace(plan.revision, [mission("mission-one", *wrong)])
    assert [(one[1], one[2]) for one in said(plan)] == [
        ("trip-none", "along"),
        ("trip-once", "along"),
    ]
    [dance, once] = [one[3] for one in said(plan)]
    assert dance.startswith("On the way") and "needs every" in once
    with pytest.raises(BadInput, match="along has an unknown key"):
        plan.replace(plan.revision, [mission("mission-one", trip(along={"often": 1}))])


def test_a_file_may_name_places_of_the_map() -> None:
    """As it is drawn when the file comes; what was taken in has the places themselves."""
    text = FILE.replace("target = [1, 1]", 'target = "Desk"')
    plan = a_plan()
    plan.landmarks = Landmarks(places=(NamedPlace(name="Desk", at=(1.0, 1.0)),))
    plan.import_toml(text, plan.revision)
    assert plan.export_toml() == FILE.replace("[1, 1]", "[1.0, 1.0]")


def test_hostile_texts_stay_texts(tmp_path: Path) -> None:
    """Nothing in a text can end it, and every character comes back."""
    hostile = '"]\n[[mission]]\n\x7f\x00\\u0041\U0001f681 \u2028 {{ }} <script>'
    parameters = {"dose": 1, "note": hostile, "a.b": 1}
    text = drawn(
        mission("mission-one", trip(action="pollinate", parameters=parameters))
    ).export_toml()
    assert '"a.b" = 1' in text
    file = tmp_path / "m.toml"
    file.write_bytes(text.replace(', "a.b" = 1', "").encode())
    [read] = load_missions(file, APP, FLEET.airspace)
    assert read.trips[0].parameters["note"] == hostile


def test_a_file_replaces_what_was_drawn_but_not_what_flies() -> None:
    """With keys that nothing has."""
    plan = drawn(mission("mission-one"), mission("mission-two"))
    plan.launched(["mission-two"])
    plan.import_toml(FILE, plan.revision)
    missions: Any = plan.data()["missions"]
    assert [one["name"] for one in missions] == ["mission-two", "North field", "South field"]
    plan.import_toml(FILE, plan.revision)
    again: Any = plan.data()["missions"]
    old, new = ({one["key"] for one in some[1:]} for some in (missions, again))
    assert not old & new


def test_what_was_handed_out_in_flight_may_come_back_in_flight() -> None:
    """The missions that fly are not there twice."""
    plan = imported(FILE)
    missions: Any = plan.data()["missions"]
    plan.launched([missions[0]["key"]])
    plan.import_toml(plan.export_toml(), plan.revision)
    assert plan.export_toml() == FILE
    assert plan.launchable()[0][0].name == "South field"
