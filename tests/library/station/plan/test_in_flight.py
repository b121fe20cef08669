"""A mission that flies is drawn otherwise: what becomes of its flight, and how the plan follows it."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.journal.standing import Record
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.hooks.plain_data import mission_data
from pluto_fleet.station.plan.in_flight import DrawnChange, drawn_change
from pluto_fleet.station.plan.plan import MissionPlan
from tests.kit.told import Told
from tests.library.files.an_app import APP
from tests.library.station.plan.drawing import Json, drawn, mission, trip

NAME = "mission-one"
KEYS = ["trip-aaaa", "trip-bbbb", "trip-cccc", "trip-dddd"]


def flies(done: int = 1) -> tuple[MissionPlan, Json, Record]:
    """Return a plan with a mission that flies, that mission, and its record: so many trips have flown, one flies."""
    plan = drawn(mission(NAME, *(trip(key, target=[i, 3]) for i, key in enumerate(KEYS, 2))))
    (one,), keys = plan.launchable()
    plan.launched(keys)
    records = Told()
    data = mission_data(APP, one)
    told: dict[str, Any] = {"t": 1.0, "mission": NAME, "drone": "cf1", "round": 0, "attempt": 1}
    records.take({**told, "event": "mission.created", "plan": data})
    for number in range(1, done + 2):
        records.take({**told, "event": "trip.launched", "trip": str(number)})
        if number <= done:
            records.take({**told, "event": "trip.completed", "trip": str(number), "did": {}})
    return plan, trips_of(plan), records.missions[NAME]


def trips_of(plan: MissionPlan) -> Any:
    missions: Any = plan.data()["missions"]
    return missions[0]


def change(plan: MissionPlan, record: Record, *trips: Json) -> DrawnChange:
    """Return what a page changes that draws these trips; the plan takes it."""
    fixed = plan.launched_mission(NAME)
    assert fixed is not None
    found = drawn_change(APP, fixed, plan.drawn_in_flight([mission(NAME, *trips)])[NAME], record)
    plan.take(plan.merged(None, {NAME: found.trips}))
    return found


def test_trips_are_known_by_their_numbers_until_those_are_others() -> None:
    """And a new one gets a number that none has had."""
    plan, fixed, record = flies()
    one, two, three, four = fixed["trips"]
    found = change(plan, record, one, two, four, {"key": "trip-new1", **trip(target=[9, 9])}, three)
    assert found.is_one
    assert [table["name"] for table in found.tables] == ["4", "5", "3"]
    drawn_names = [one.get("name") for one in trips_of(plan)["trips"]]
    assert drawn_names == [None, None, "4", "5", "3"]


def test_what_has_flown_comes_first_wherever_it_was_drawn() -> None:
    plan, fixed, record = flies()
    one, two, three, four = fixed["trips"]
    change(plan, record, four, two, one, three)
    assert [one["key"] for one in trips_of(plan)["trips"]] == [KEYS[i] for i in (0, 1, 3, 2)]


@pytest.mark.parametrize(("number", "what"), [(0, "has been flown"), (1, "has taken off")])
def test_what_has_flown_can_neither_be_changed_nor_taken_out(number: int, what: str) -> None:
    plan, fixed, record = flies()
    trips = fixed["trips"]
    for given in (
        trips[:number] + trips[number + 1 :],
        [{**one, "target": [7, 7]} if one is trips[number] else one for one in trips],
    ):
        with pytest.raises(BadInput, match=f'trip "{number + 1}" {what} meanwhile'):
            change(plan, record, *given)


def test_what_the_apps_own_code_has_made_of_a_trip_stays() -> None:
    """As long as the page leaves that trip as it was; so does a trip that it has added."""
    plan, fixed, record = flies()
    one, two, three, four = fixed["trips"]
    record["todo"][1]["target"] = [8.0, 8.0, 1.2]
    record["todo"].append({**record["todo"][2], "name": "second look", "added": True})
    found = change(plan, record, one, two, three, {**four, "target": [4, 4]})
    assert [table["target"] for table in found.tables] == [[8.0, 8.0, 1.2], [4, 4], [5.0, 3.0, 1.2]]
    assert [table["name"] for table in found.tables][-1] == "second look"


def test_a_trip_that_was_skipped_stays_so_and_stays_drawn() -> None:
    plan, fixed, record = flies()
    record["gone"].append(record["todo"].pop(1))
    one, two, three, four = fixed["trips"]
    found = change(plan, record, one, two, three, {**four, "target": [4, 4]})
    assert [table["name"] for table in found.tables] == ["4"]
    assert len(trips_of(plan)["trips"]) == 4


def test_the_plan_follows_what_was_changed_elsewhere() -> None:
    """Trips that stay keep their keys; and what it has already is no change."""
    plan, fixed, record = flies()
    plan.follow(NAME, record)
    before = plan.revision
    three, four = record["todo"][1:]
    new = {**three, "name": "new", "target": [9.0, 9.0, 1.0]}
    record.update(
        replanned=True, todo=[record["todo"][0], {**four, "target": [1.0, 1.0, 1.0]}, new]
    )
    plan.follow(NAME, record)
    trips = trips_of(plan)["trips"]
    assert [one["key"] for one in trips[:3]] == [KEYS[0], KEYS[1], KEYS[3]]
    assert [one["target"][:2] for one in trips[2:]] == [[1.0, 1.0], [9.0, 9.0]]
    assert [one.get("name") for one in trips] == [None, None, "4", "new"]
    assert fixed["trips"][0] == trips[0]
    plan.follow(NAME, record)
    assert plan.revision == before + 1


def test_a_page_that_draws_nothing_else_changes_nothing() -> None:
    plan, fixed, _ = flies()
    assert plan.drawn_in_flight([fixed]) == {}
    assert plan.drawn_in_flight([]) == {}
    plan.unlock()
    assert plan.drawn_in_flight([{**fixed, "trips": []}]) == {}
