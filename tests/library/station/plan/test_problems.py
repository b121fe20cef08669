"""What is still to be done in a plan: where it stands, what is said of it on a screen, and when that is known."""

from __future__ import annotations

import asyncio
import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.plan_check import problems
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.plan import MOST_SHOWN, MissionPlan
from pluto_fleet.station.plan.text import text_of
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import FLEET, Json, a_plan, drawn, mission, said, trip

M, T = "mission-one", "trip-one"
SESSION = Path(__file__).parent.parent / "server" / "sessions" / "plan_problems.txt"
UNFINISHED = [
    json.loads(body.replace("$now", "0"))["missions"]
    for body in re.findall(r"^> PUT /api/plan (.*)$", SESSION.read_text("utf-8"), re.MULTILINE)
]
"""Plans with a problem each, or two."""
WALL = ((8.0, 0.0), (9.0, 0.0), (9.0, 20.0), (8.0, 20.0))
WALLED = replace(FLEET, airspace=Airspace(no_fly=(WALL,)))


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
        'Mission 2: the name "" is no name: a text of 1 to 200 characters that can be shown, no'
        " blank around"
    )
    many = drawn(*(mission(f"mission-{i:02}", trips=[]) for i in range(12)))
    assert start_refused(many).split("\n")[10:] == ["… and 2 more problems"]


def start_refused(plan: Any) -> str:
    with pytest.raises(BadInput) as caught:
        plan.launchable()
    return str(caught.value)


@pytest.mark.parametrize("missions", UNFINISHED, ids=range(len(UNFINISHED)))
def test_a_screen_and_a_file_find_the_same(tmp_path: Path, missions: list[Json]) -> None:
    """As many problems as `check` finds in the file, whose words and places differ."""
    plan = drawn(*missions)
    shapes: Any = plan.data()["missions"]
    file = tmp_path / "m.toml"
    file.write_text(text_of(APP, shapes), encoding="utf-8")
    assert len(said(plan)) == len(checked_file(file))


def checked_file(path: Path) -> list[str]:
    """Return what `check` says: of the file, and if there is nothing, of what no drone can fly."""
    try:
        read = load_missions(path, APP, FLEET.airspace)
    except BadInput as error:
        return str(error).split("\n")
    return problems(read, APP, FLEET, FLEET.airspace)


# Whether the fleet can fly what is drawn is found out beside the loop, and never forgotten

FAR = trip(target=[12, 1])


def told(plan: MissionPlan) -> int:
    """Return how many problems a page would see now."""
    problems: Any = plan.data()["problems"]
    return len(problems)


def test_what_has_changed_is_asked_again() -> None:
    """By itself, and not because others have changed."""
    plan = drawn(mission("mission-one", FAR), mission("mission-two"), fleet=WALLED)
    assert [one[0] for one in said(plan)] == ["mission-one"]
    near = mission("mission-one", trip(target=[2, 1]))
    plan.replace(plan.revision, [near, mission("mission-two", trip("trip-two", target=[13, 1]))])
    assert told(plan) == 0
    assert [one[0] for one in said(plan)] == ["mission-two"]
    plan.replace(plan.revision, [mission("mission-one", FAR)])
    assert [one[0] for one in said(plan)] == ["mission-one"]


def test_drawing_meanwhile_is_waited_for() -> None:
    """The answer is about the newest plan."""

    async def both(plan: MissionPlan) -> None:
        asking = asyncio.ensure_future(plan.examined())
        await asyncio.sleep(0)
        plan.replace(plan.revision, [mission("mission-two", FAR)])
        await asking

    plan = drawn(mission("mission-one", FAR), fleet=WALLED)
    asyncio.run(both(plan))
    assert told(plan) == 1


def test_the_thousandth_problem_is_left_out() -> None:
    """So no page is sent more."""
    plan = a_plan()
    trips = [trip(f"trip-{i:05}", target=None) for i in range(MOST_SHOWN + 1)]
    plan.replace(plan.revision, [mission("mission-one", *trips)])
    assert len(said(plan)) == MOST_SHOWN
