"""What a missions file may hold, and what is said of one that cannot be flown."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.reading import read
from pluto_fleet.shared.alone.files import LARGEST
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


def trip(rest: str) -> str:
    return f'[[mission]]\nname = "M"\n[[mission.trip]]\n{rest}'


def trip_problems(path: Path, rest: str) -> list[str]:
    """Return what is said of one trip, without file, line, mission and trip."""
    said = problems(path, trip(rest))
    return [line.partition('mission "M", trip 1')[2].lstrip(":, ") for line in said]


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


def test_all_problems_of_a_file_are_told_in_one_go_with_their_lines(tmp_path: Path) -> None:
    """One line a problem, in the order of the file, each with mission and trip."""
    text = FULL.replace('"take_photo"', '"take_foto"').replace('"3 min"', '"3 m"')
    text = text.replace("[6.0, 3.0]", "[8.5, 3.0]").replace("[1, 1]", "[1]")
    assert problems(tmp_path, text) == [
        (
            'missions.toml:4: mission "North field": safe_time "3 m" is a length, not a time: '
            "it takes ms, s, min, h"
        ),
        (
            'missions.toml:11: mission "North field", trip "A": unknown action "take_foto"; '
            'did you mean "take_photo"?'
        ),
        'missions.toml:30: mission "North field", trip 4: target (8.5, 3) is inside no-fly area 1',
        (
            'missions.toml:38: mission "South field", trip 1: target […] is not a list of '
            "2 or 3 numbers"
        ),
    ]


def test_a_field_without_a_block_that_needs_it_does_not_exist(tmp_path: Path) -> None:
    """The message says why, and what there is instead."""
    said = problems(tmp_path, trip(f"{PHOTO}delay = 3"), PLAIN)
    assert said == [
        (
            'missions.toml:6: mission "M", trip 1: unknown key "delay": this app\'s graph has no '
            "block that needs it; a trip of this app has: name, action, target, source, "
            "parameters, item"
        )
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", ["missions.toml: has no [[mission]]: nothing to fly"]),
        ("mission = []", ["missions.toml: has no [[mission]]: nothing to fly"]),
        (
            '[mission]\nname = "M"',
            ["missions.toml:1: mission is not a list of tables: write [[mission]], with two brackets"],
        ),
        (
            "[[missions]]",
            [
                ('missions.toml:1: unknown key "missions"; did you mean "mission"? '
                "a missions file has: mission"),
                "missions.toml: has no [[mission]]: nothing to fly",
            ],
        ),
        ('[[mission]]\nname = "M"', ['missions.toml:1: mission "M": has no [[mission.trip]]']),
        ("a = ", [("missions.toml:1: is not valid TOML: invalid value, at the end of the file, in `a =`; "
                   "write a value behind a =")]),
        ("\na = 1 2", [("missions.toml:2: is not valid TOML: expected newline or end of document "
                       'after a statement, column 7, in `a = 1 2`; write a = "1 2"')]),
        ("a = " + "[" * 5000, ["missions.toml: is nested too deep"]),
    ],
)  # fmt: skip
def test_a_file_that_holds_no_plan_is_refused(tmp_path: Path, text: str, said: list[str]) -> None:
    """Each with what to do about it."""
    assert problems(tmp_path, text) == said


def test_a_mission_without_a_name_is_called_by_its_number(tmp_path: Path) -> None:
    nameless = f"[[mission]]\n[[mission.trip]]\n{PHOTO}"
    assert [mission.name for mission in load(tmp_path, nameless * 2)] == ["1", "2"]


def test_names_must_differ(tmp_path: Path) -> None:
    """Missions in a file, trips in a mission; a trip without a name is called by its number."""
    text = trip(f'name = "2"\n{PHOTO}[[mission.trip]]\n{PHOTO}') + trip(PHOTO)
    assert problems(tmp_path, text) == [
        (
            'missions.toml:7: mission "M", trip 2: there is another trip "2", in line 4: '
            "names must differ"
        ),
        (
            'missions.toml:11: mission "M": there is another mission "M", in line 2: '
            "names must differ"
        ),
    ]


@pytest.mark.parametrize(
    ("rest", "said"),
    [
        ('action = "take_photo"', "has no target"),
        ("target = [1, 1]", "has no action"),
        ('action = "fly"\ntarget = [1, 1]',
         ('unknown action "fly"; this app has: measure, take_photo, pick_item, release_item, '
         "pollinate")),
        (f"{PHOTO}delay = true",
         "delay true is not a time: write a number, or a text with a unit (ms, s, min, h)"),
        (f"{PHOTO}delay = nan", "delay nan is not a finite number"),
        (f"{PHOTO}delay = -1", "delay -1 is less than 0: it may be 0, or 0.001 s to 1,000,000,000 s"),
        (f"{PHOTO}delay = 1e300", "delay 1e+300 is too large"),
        (f"{PHOTO}priority = 1.5", "priority 1.5 is not a whole number"),
        (f"{PHOTO}priority = true", "priority true is not a whole number"),
        (f"{PHOTO}priority = 0x{'f' * 9000}", "priority this number is too large"),
        (f'{PHOTO}name = ""', 'name "" is empty'),
        (f'{PHOTO}name = "a\\u001b[2J"',
         'name "a\\x1b[2J" holds a character that cannot be shown'),
        (f"{PHOTO}dealy = 3",
         ('unknown key "dealy"; did you mean "delay"? a trip of this app has: name, action, '
         "target, source, parameters, item, delay, priority")),
        ('action = "take_photo"\ntarget = [1, inf]',
         "target […] has an element that is not a finite number"),
        ('action = "take_photo"\ntarget = [1, "2 s"]',
         "target […] has an element that is a time, not a length: it takes mm, cm, m, km"),
        ('action = "take_photo"\ntarget = [30, 1]',
         "target (30, 1) is outside the map: x goes from 0 to 20 m, y from 0 to 12 m"),
        ('action = "take_photo"\ntarget = [1, 1, 11]',
         "target (1, 1) at a height of 11 m is above the ceiling of 10 m"),
        (f'{PHOTO}parameters = {{ zoom = 2 }}',
         'take_photo has no parameters, and "zoom" is given'),
        (f"{PHOTO}parameters = 3", "parameters is not a table: write [parameters]"),
        (f'{PHOTO}item = {{ name = "x", mass = "1 g" }}',
         "take_photo takes no item: only pick_item and release_item do"),
        ('action = "pollinate"\ntarget = [1, 1]', "pollinate needs the parameter dose"),
        ('action = "pollinate"\ntarget = [1, 1]\nparameters = { dose = 1, dos = 2 }',
         'unknown parameter "dos"; did you mean "dose"?'),
        ('action = "pollinate"\ntarget = [1, 1]\nparameters = { dose = "3 s" }',
         'dose "3 s" is a time, not a mass: it takes mg, g, kg'),
        ('action = "pollinate"\ntarget = [1, 1]\nparameters = { dose = 1, gently = 1 }',
         "gently 1 is neither true nor false"),
        ('action = "pick_item"\ntarget = [1, 1]',
         'pick_item needs an item, such as item = { name = "pills", mass = "4 g" }'),
        ('action = "pick_item"\ntarget = [1, 1]\nitem = { name = "x" }', "item: has no mass"),
        ('action = "pick_item"\ntarget = [1, 1]\nitem = { name = "x", mass = "1 g" }',
         'picks "x", which no trip after it releases'),
        ('action = "release_item"\ntarget = [1, 1]\nitem = { name = "x", mass = "1 g" }',
         'releases "x", which no trip before it has picked'),
    ],
)  # fmt: skip
def test_a_trip_that_cannot_be_flown_is_refused(tmp_path: Path, rest: str, said: str) -> None:
    """The message names the key and what is wrong with its value."""
    assert trip_problems(tmp_path, rest) == [said]


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("repeat = -1", "repeat -1 is neither a whole number from 0 on nor true"),
        ("repeat = false", "repeat false is neither a whole number from 0 on nor true"),
        ('at = "25:00"', 'at "25:00" is not a time of day: write it like "08:00"'),
        ("at = 8", 'at 8 is not a time of day: write it like "08:00"'),
        ('evaluator = "find_bloom"', 'unknown evaluator "find_bloom"; did you mean "find_blooms"?'),
        ('gap = "3 s"', ('unknown key "gap"; a mission of this app has: name, trip, area, deadline, '
         "window, after, safe_time, repeat, at, evaluator")),
        ('deadline = "soon"', ('deadline "soon" is not a time: write a number and a unit (ms, s, min, h);'
         ' or a time of day, like "08:30"')),
        ('deadline = "25:00"', 'deadline "25:00" is not a time of day: write it like "08:00"'),
        ("deadline = -1", 'deadline -1 is less than 0 s: it may be 0 s to 1,000,000,000 s'),
        ('window = "08:00"', 'window "08:00" is not a list of two times, like ["08:00", "08:30"]'),
        ('window = ["08:00", 3, 4]', 'window […] is not a list of two times, like ["08:00", "08:30"]'),
        ('window = ["08:00", "25:00"]', 'window […] has an element that is not a time of day: write it like "08:00"'),
        ('window = ["20 s", "10 s"]', 'window […] has no time between its two'),
        ('window = ["20 s", "20 s"]', 'window […] has no time between its two'),
        ('window = ["8:00", "08:00:00"]', 'window […] has no time between its two'),
        ("window = [08:00:00, 08:00:00]", 'window […] has no time between its two'),
        ("deadline = 2026-05-01", 'deadline 2026-05-01 is not a time: write a number, or a text with a unit (ms, s, min, h); or a time of day, like "08:30"'),
        ("after = [1]", 'after […] is not a list of missions, like ["Mission 1"]'),
        ("after = 3", 'after 3 is not a list of missions, like ["Mission 1"]'),
        ('after = "N"', 'comes after "N", and there is no such mission'),
        ('after = ["M"]', 'comes after itself: it can never begin'),
    ],
)  # fmt: skip
def test_a_missions_fields_are_checked(tmp_path: Path, key: str, said: str) -> None:
    """Each by its own type."""
    text = f'[[mission]]\nname = "M"\n{key}\n[[mission.trip]]\n{PHOTO}'
    assert problems(tmp_path, text) == [f'missions.toml:3: mission "M": {said}']


def carried(*steps: str) -> str:
    """Write a mission that picks (+name) and releases (-name) items."""
    text = '[[mission]]\nname = "M"\n'
    for step in steps:
        action = "pick_item" if step[0] == "+" else "release_item"
        text += f'[[mission.trip]]\naction = "{action}"\ntarget = [1, 1]\n'
        text += f'item = {{ name = "{step[1]}", mass = "{len(step)} g" }}\n'
    return text


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (("+a", "+b", "-b"), ['6', '10: picks "b", but "a" is still aboard since trip 1']),
        (("+a", "-b"), ['10: releases "b", but trip 1 picked "a"']),
        (("+a", "-a "), ['10: "a" has another mass here than in trip 1']),
        (("+a", "-a", "-a"), ['14: releases "a", which no trip before it has picked']),
        (("+a", "-a", "+a"), ['14: picks "a", which no trip after it releases']),
    ],
)  # fmt: skip
def test_what_is_picked_must_be_released(
    tmp_path: Path, steps: tuple[str, ...], said: list[str]
) -> None:
    """One item at a time, and the same one."""
    found = problems(tmp_path, carried(*steps))
    short = [f"{line.split(':')[1]}: {line.rsplit(': ', 1)[1]}" for line in found]
    assert short == said[-1:]


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    """Missing, a folder, too large, not text: each says what it is."""
    latin = tmp_path / "latin.toml"
    latin.write_bytes(b"a = 1\nb = '\xe9'\n")
    large = tmp_path / "large.toml"
    large.write_text("#" * (LARGEST + 1))
    for path, said in (
        (tmp_path / "none.toml", ": there is no such file"),
        (tmp_path, ": is a folder, not a file"),
        (large, ": is larger than 1024 KiB: this is not a plan file"),
        (latin, ":2: is not UTF-8 text"),
        (Path("a\0b"), ": is not a file name"),
    ):
        with pytest.raises(BadInput) as caught:
            read(path)
        assert str(caught.value) == f"{path}{said}"


def test_a_thousand_problems_are_cut_short(tmp_path: Path) -> None:
    """The first fifty are told, and how many there are besides."""
    said = problems(tmp_path, trip(PHOTO + "".join(f"k{i} = 1\n" for i in range(1000))))
    assert len(said) == 51
    assert said[-1] == "… and 950 more problems"


LINES = st.sampled_from([*FULL.split("\n"), "x = 1", "[[mission]]", "target = 3", "item = 1"])


@given(st.lists(LINES, max_size=25))
def test_any_mixture_of_lines_is_loaded_or_refused(lines: list[str]) -> None:
    """Nothing that a file may hold ends in anything but missions or `BadInput`."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            missions = load(Path(folder), "\n".join(lines))
        except BadInput as error:
            assert str(error)
        else:
            assert all(mission.trips for mission in missions)
