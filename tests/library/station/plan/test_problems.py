"""What is still to be done in a plan: where it stands, and what is said of it on a screen."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings

from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.plan_check import problems
from pluto_fleet.files.reading import MOST_SHOWN
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.text import text_of
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET, PLANS, Json, drawn, mission, said, trip

M, T = "mission-one", "trip-one"
PILLS = {"name": "pills", "mass": "4 g"}
WALL = ((8.0, 0.0), (9.0, 0.0), (9.0, 20.0), (8.0, 20.0))
WALLED = replace(FLEET, airspace=Airspace(no_fly=(WALL,)))


def of_trip(**given: object) -> list[tuple[str | None, str]]:
    """Return what is said of one trip: field and sentence."""
    found = said(drawn(mission(M, trip(T, **given))))
    assert all(one[:2] == (M, T) for one in found)
    return [one[2:] for one in found]


def of_mission(**given: object) -> list[tuple[str | None, str]]:
    found = said(drawn(mission(M, **given)))
    assert all(one[:2] == (M, None) for one in found)
    return [one[2:] for one in found]


def test_a_plan_without_missions_has_no_problem() -> None:
    """There is nothing to do in it yet, and nothing to fly."""
    plan = drawn()
    assert said(plan) == []
    assert plan.launchable() == ([], [])


@pytest.mark.parametrize(
    ("given", "field", "sentence"),
    [
        ({"name": ""}, "name", 'The name "" is empty'),
        ({"name": "x" * 201}, "name",
         f'The name "{"x" * 59}…" is longer than 200 characters'),
        ({"safe_time": "3 m"}, "safe_time",
         'safe_time "3 m" is a length, not a time: it takes ms, s, min, h'),
        ({"repeat": "often"}, "repeat",
         'repeat "often" is neither a whole number from 0 on nor true'),
        ({"at": "8"}, "at", 'at "8" is not a time of day: write it like "08:00"'),
        ({"evaluator": "find_bloom"}, "evaluator",
         'Unknown evaluator "find_bloom"; did you mean "find_blooms"?'),
        ({"deadline": "3 kg"}, "deadline",
         'Due "3 kg" is a mass, not a time: it takes ms, s, min, h; or a time of day, like "08:30"'),
        ({"opens": "soon", "deadline": "5 min"}, "opens",
         ('Begins at the soonest "soon" is not a time: write a number and a unit (ms, s, min, h);'
         ' or a time of day, like "08:30"')),
        ({"opens": "08:00", "deadline": "8:77"}, "deadline",
         'Due "8:77" is not a time of day: write it like "08:00"'),
        ({"opens": "08:00"}, "opens", "It needs an end as well: fill in by when it is due"),
        ({"opens": "9 min", "deadline": "8 min"}, "deadline",
         "There is no time between when it may begin and when it is due"),
        ({"trips": []}, None, "Has no trips yet: drag an action onto the floor plan"),
    ],
)  # fmt: skip
def test_a_mission_says_what_it_lacks(given: Json, field: str | None, sentence: str) -> None:
    """Beside the field that it is about."""
    labelled = sentence.replace("safe_time", "Safe_time").replace("repeat ", "Repeat ", 1)
    labelled = labelled.replace("at ", "At ", 1) if field == "at" else labelled
    assert of_mission(**given) == [(field, labelled)]


@pytest.mark.parametrize(
    ("given", "field", "sentence"),
    [
        ({"target": [2, 3, 99]}, "z",
         "The place (2, 3) at a height of 99 m is above the ceiling of 10 m"),
        ({"target": [2, 3, -1]}, "z",
         "The place (2, 3) at a height of -1 m is below the ground"),
        ({"target": None}, "target",
         "Has no place yet: drag it onto the floor plan, or type x and y"),
        ({"target": [2, 30]}, "target",
         "The place (2, 30) is outside the map: x goes from 0 to 20 m, y from 0 to 20 m"),
        ({"source": [2, 30]}, "source",
         ("The place where the flight begins (2, 30) is outside the map: "
          "x goes from 0 to 20 m, y from 0 to 20 m")),
        ({"action": "take_foto"}, "action",
         'Unknown action "take_foto"; did you mean "take_photo"?'),
        ({"delay": "soon"}, "delay",
         'Delay "soon" is not a time: write a number and a unit (ms, s, min, h)'),
        ({"priority": 1.5}, "priority", "Priority 1.5 is not a whole number"),
        ({"action": "pollinate"}, "parameters.dose", "pollinate needs the parameter dose"),
        ({"action": "pollinate", "parameters": {"dose": "much"}}, "parameters.dose",
         'dose "much" is not a mass: write a number and a unit (mg, g, kg)'),
        ({"parameters": {"zoom": 2}}, "parameters.zoom",
         'take_photo has no parameters, and "zoom" is given'),
        ({"item": PILLS}, "item", "take_photo takes no item: only pick_item and release_item do"),
        ({"action": "pick_item"}, "item", "pick_item needs an item: give its name and its mass"),
        ({"action": "pick_item", "item": {"name": "pills"}}, "item.mass",
         "The item has no mass yet: write it like 4 g"),
        ({"action": "pick_item", "item": {"mass": 0.004}}, "item.name",
         "The item has no name yet"),
        ({"action": "pick_item", "item": {"name": "", "mass": 0.004}}, "item.name",
         'The name "" is empty'),
        ({"action": "pick_item", "item": {"name": "pills", "mass": "4"}}, "item",
         'Picks "pills", which no trip after it releases'),
        ({"action": "release_item", "item": PILLS}, "item",
         'Releases "pills", which no trip before it has picked'),
    ],
)  # fmt: skip
def test_a_trip_says_what_it_lacks(given: Json, field: str, sentence: str) -> None:
    """Beside the field that it is about, and without a word of files."""
    assert of_trip(**given) == [(field, sentence)]


def test_two_of_one_name_are_told_at_the_second() -> None:
    """Missions of a plan, trips of a mission."""
    two = mission("mission-two", trip("trip-aaa", name="A"), trip("trip-bbb", name="A"), name=M)
    assert said(drawn(mission(M), two)) == [
        ("mission-two", None, "name", f'There is another mission "{M}": names must differ'),
        ("mission-two", "trip-bbb", "name", 'There is another trip "A": names must differ'),
    ]


def test_what_unflyable_trips_is_told_at_its_first_trip() -> None:
    """With the trips that belong to it."""
    heavy = {"name": "pills", "mass": "8 g"}
    pick, release = (
        trip(f"{one}-1", action=one, item=heavy) for one in ("pick_item", "release_item")
    )
    photo = trip("photo-001")
    reason = (
        "no drone of the fleet can do it: scout cannot pick_item; "
        "carrier carries at most 5 g, the item weighs 8 g"
    )
    plan = drawn(mission(M, photo, pick, release))
    chain = f"From here to trip 3 one drone must fly all: {reason}"
    assert said(plan) == [(M, "pick_item-1", None, chain)]
    assert start_refused(plan) == f'Mission "{M}", trips 2 to 3: {reason}'
    alone = drawn(mission(M, trip(T, target=[12, 1])), fleet=WALLED)
    [(*_, sentence)] = said(alone)
    assert sentence.startswith("No drone of the fleet can do it: scout finds no permitted way")


def test_a_mission_that_cannot_be_read_is_not_asked_whether_it_can_be_flown() -> None:
    """Its trips may stand anywhere; the others are asked."""
    unread = mission("mission-two", trip("trip-two", target=[12, 1], delay="soon"))
    found = said(drawn(mission(M, trip(T, target=[12, 1])), unread, fleet=WALLED))
    assert [(one[0], one[2]) for one in found] == [("mission-two", "delay"), (M, None)]


def test_start_says_what_is_still_to_be_done() -> None:
    """A line each with mission and trip, as far as a person reads it."""
    plan = drawn(mission(M, trip(T, target=None)), mission("mission-two", name=""))
    assert start_refused(plan) == (
        f'Mission "{M}", trip 1: has no place yet: drag it onto the floor plan, or type x and y\n'
        'Mission 2: the name "" is empty'
    )
    many = drawn(*(mission(f"mission-{i:02}", trips=[]) for i in range(12)))
    assert start_refused(many).split("\n")[10:] == ["… and 2 more problems"]


def start_refused(plan: Any) -> str:
    with pytest.raises(BadInput) as caught:
        plan.launchable()
    return str(caught.value)


@given(PLANS)
@settings(max_examples=200, derandomize=True, deadline=None)
def test_a_screen_and_a_file_find_the_same(tmp_path_factory: Any, missions: list[Json]) -> None:
    """Each problem that `check` finds in the file; whether it can be flown, if there is none."""
    plan = drawn(*missions)
    file = tmp_path_factory.mktemp("plan") / "m.toml"
    file.write_text(text_of(APP, plan_missions(plan)), encoding="utf-8")
    on_screen, in_file = [text for *_, text in said(plan)], checked_file(file) if missions else []
    assert bool(on_screen) == bool(in_file)
    assert readable(on_screen)[:MOST_SHOWN] == readable(in_file)[:MOST_SHOWN]


def readable(sentences: list[str]) -> list[str]:
    """Leave out what no drone can fly, and count the others: their words and places differ."""
    return ["" for one in sentences if "no drone of the fleet" not in one.lower()]


def plan_missions(plan: Any) -> list[Json]:
    missions: list[Json] = plan.data()["missions"]
    return missions


def checked_file(path: Path) -> list[str]:
    """Return what `check` says: of the file, and if there is nothing, of what no drone can fly."""
    try:
        read = load_missions(path, APP, FLEET.airspace)
    except BadInput as error:
        return str(error).split("\n")
    return problems(read, APP, FLEET, FLEET.airspace)
