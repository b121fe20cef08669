"""What follows from the events of a journal, for a life that goes on from there."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.journal.fold import Records

PLAN: dict[str, Any] = {"index": 0, "fields": {}, "trips": [{"name": "A", "action": "measure"}]}
CREATED = {"event": "mission.created", "plan": PLAN}


def folded(*events: dict[str, Any]) -> Records:
    records = Records()
    for time, event in enumerate(events):
        records.take({"t": float(time), "mission": "m", **event})
    return records


def test_a_drone_that_was_retired_and_is_brought_back_is_retired_no_more() -> None:
    drone = {"drone": "cf1"}
    gone = {"event": "drone.retired", **drone}, {"event": "drone.retired", **drone}
    assert folded(*gone).retired == ["cf1"]
    records = folded(*gone, {"event": "drone.brought_back", **drone})
    assert (records.retired, records.lost, records.mended) == ([], {}, [])


@pytest.mark.parametrize(
    ("event", "status", "heard"),
    [
        ({"event": "mission.modified", "status": "STANDBY", "reason": ""}, "STANDBY", True),
        ({"event": "mission.modified", "status": "FAILED", "reason": "rain"}, "FAILED", False),
        ({"event": "mission.judged", "reason": "blurred"}, "FAILED", False),
    ],
)
def test_what_a_hook_makes_of_a_mission_is_remembered(
    event: dict[str, Any], status: str, heard: bool
) -> None:
    """One that is to fly on has heard of its last flight; one that failed has yet to go on."""
    flight = {"trip": "A", "drone": "cf1", "round": 0, "attempt": 1}
    mission = folded(CREATED, {"event": "trip.launched", **flight}, event).missions["m"]
    assert (mission["status"], mission["reason"]) == (status, event["reason"])
    assert mission["flight"]["heard"] is heard


def test_a_mission_that_was_late_stays_so_when_it_restarts() -> None:
    assert folded(CREATED, {"event": "mission.late"}, CREATED).missions["m"]["late"]


def test_a_trip_that_is_skipped_behind_another_is_the_one_that_is_gone() -> None:
    trips = [{**PLAN["trips"][0], "name": name} for name in "ABC"]
    created = {**CREATED, "plan": {**PLAN, "trips": trips}}
    record = folded(created, {"event": "trip.skipped", "trip": "B"}).missions["m"]
    left, gone = ([one["name"] for one in record[key]] for key in ("todo", "gone"))
    assert (left, gone) == (["A", "C"], ["B"])
