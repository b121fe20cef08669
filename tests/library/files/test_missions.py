"""What a missions file may hold, and what is said of one that cannot be flown."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import pytest

from pluto_fleet.files.missions import load_missions
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Item, Mission
from pluto_fleet.shared.domain.status import Status
from tests.library.files.an_app import APP, PLAIN, FieldMission

SIZE = (20.0, 12.0)
AIRSPACE = Airspace(size=SIZE, no_fly=(((8.0, 0.0), (9.0, 0.0), (9.0, 5.0), (8.0, 5.0)),))


def load(path: Path, text: str, app: Any = APP) -> list[Mission[Any]]:
    file = path / "missions.toml"
    file.write_text(text, encoding="utf-8")
    return load_missions(file, app, AIRSPACE)


def problems(path: Path, text: str, app: Any = APP) -> list[str]:
    """Return what is said of a file, without its folder."""
    with pytest.raises(BadInput) as caught:
        load(path, text, app)
    return [line.removeprefix(f"{path}/") for line in str(caught.value).split("\n")]


MISSION = '[[mission]]\nname = "M"\n'


def trip(rest: str) -> str:
    return f"{MISSION}[[mission.trip]]\n{rest}"


PHOTO = 'action = "take_photo"\ntarget = [1, 1]\n'

FULL = """
[[mission]]
name = "North field"
safe_time = "3 min"
repeat = 2
at = "08:30"
evaluator = "find_blooms"

  [[mission.trip]]
  name = "A"
  action = "take_photo"
  target = [2.0, 1.5]
  delay = "30 s"
  priority = 1

  [[mission.trip]]
  action = "pollinate"
  parameters = { dose = "40 mg", share = "20 %" }
  target = [4, 1.5, "80 cm"]

  [[mission.trip]]
  action = "pick_item"
  item = { name = "pills", mass = "4 g" }
  source = [0.5, 0.5]
  target = [4.0, 3.0]

  [[mission.trip]]
  action = "release_item"
  item = { name = "pills", mass = 0.004 }
  target = [6.0, 3.0]

[[mission]]
name = "South field"
repeat = true
at = 17:15:30
[[mission.trip]]
action = "measure"
target = [1, 1]
"""


def test_a_file_becomes_missions_with_the_apps_own_fields(tmp_path: Path) -> None:
    """Units become SI, heights and parameters get their defaults, trips their numbers."""
    north, south = cast("list[FieldMission]", load(tmp_path, "\ufeff" + FULL))
    assert type(north) is APP.mission
    assert (north.name, north.index, north.status) == ("North field", 0, Status.UNEXECUTED)
    assert (north.safe_time, north.repeat, north.at) == (180.0, 2, 30600.0)
    assert north.evaluator == "find_blooms"
    a, two, pick, release = north.trips
    assert type(a) is APP.trip
    assert (a.name, a.target, a.delay, a.priority) == ("A", (2.0, 1.5, 1.2), 30.0, 1)
    assert (two.name, two.target, two.index) == ("2", (4.0, 1.5, 0.8), 1)
    assert two.parameters == {
        "dose": 4e-05,
        "gently": True,
        "strokes": 3,
        "share": 0.2,
        "note": "",
        "force": 1.0,
    }
    assert pick.source == (0.5, 0.5, 1.2)
    assert pick.item == release.item == Item(name="pills", mass=0.004)
    assert type(south) is APP.mission
    assert (south.index, south.repeat, south.at) == (1, True, 62130.0)
    assert south.trips[0].parameters == {"quantity": "temperature"}


def test_a_field_without_a_block_that_needs_it_does_not_exist(tmp_path: Path) -> None:
    """The message says why, and what there is instead."""
    said = problems(tmp_path, trip(f"{PHOTO}delay = 3"), PLAIN)
    assert said == [
        (
            'missions.toml:6: mission "M", trip 1: unknown key "delay": this app\'s graph has no '
            "block that needs it; there may be: action, target, name, source, "
            "parameters, item"
        )
    ]


def test_a_thousand_problems_are_cut_short(tmp_path: Path) -> None:
    """The first fifty are told, and how many there are besides."""
    said = problems(tmp_path, trip(PHOTO + "".join(f"k{i} = 1\n" for i in range(1000))))
    assert len(said) == 51
    assert said[-1] == "… and 950 more problems"
