"""Commands to a brain: what each does, and why it is refused."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.errors import BadInput, MissionFailed
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.run import declared
from tests.brain.hand import charged, settled, trip


def flying() -> Brain:
    """Return a brain of one drone: mission a flies, and b waits."""
    brain = charged()
    missions = [{"name": name, "trips": [trip(3.0), trip(4.0), trip(5.0)]} for name in "ab"]
    brain.begin(missions, 0.0)
    settled(brain, 0.0)
    return brain


def todo(brain: Brain, mission: str) -> list[str]:
    return [one["name"] for one in brain.standing()["missions"][mission]["todo"]]


@pytest.mark.parametrize(
    ("request_", "why"),
    [
        ({"command": "sing"}, "there is no command 'sing'"),
        ({}, "there is no command None"),
        ({"command": "leave"}, "the command leave needs 'mission'"),
        ({"command": "leave", "mission": "z"}, "mission z is not under way"),
        (
            {"command": "skip", "mission": "a", "trip": "1"},
            "trip 1 may be flying: pause its mission",
        ),
        ({"command": "skip", "mission": "a", "trip": "9"}, "mission a has no trip 9 to do"),
        ({"command": "retire", "drone": "cf9"}, "no drone cf9 is in the fleet"),
        (
            {"command": "join", "drone": "cf1", "home": [1, 1]},
            "the fleet can have no second drone cf1",
        ),
        (
            {"command": "join", "drone": "cf9", "category": "whale", "home": [1, 1]},
            "the fleet can have no category whale",
        ),
        (
            {"command": "probe", "mission": "a"},
            "mission a has no flight",
        ),
    ],
)
def test_a_command_that_cannot_be_done_is_refused_with_the_reason(
    request_: dict[str, Any], why: str
) -> None:
    brain = flying()
    with pytest.raises(BadInput, match=why):
        brain.command(request_, 1.0)
    brain.close()


def test_a_trip_to_come_is_skipped_or_replaced() -> None:
    brain = flying()
    brain.command({"command": "skip", "mission": "a", "trip": "2"}, 1.0)
    assert todo(brain, "a") == ["1", "3"]
    new = [{**trip(6.0), "name": "x"}, trip(7.0)]
    brain.command({"command": "change-trips", "mission": "a", "trips": new}, 1.0)
    assert todo(brain, "a") == ["1", "x", "3"]
    brain.close()


def test_a_mission_is_cancelled_with_a_status_and_a_reason_and_is_over_then() -> None:
    brain = flying()
    cancel = {"command": "cancel", "mission": "a"}
    brain.command({**cancel, "reason": "rain"}, 1.0)
    assert [order["do"] for order in settled(brain, 1.0)] == ["break_off", "recover"]
    stands = brain.standing()["missions"]["a"]
    assert (stands["status"], stands["reason"], stands["ended"]) == ("CANCELLED", "rain", True)
    with pytest.raises(BadInput, match="mission a is not under way"):
        brain.command(cancel, 2.0)
    brain.command({**cancel, "mission": "b", "status": "HELD"}, 2.0)
    assert brain.standing()["missions"]["b"]["status"] == "HELD"
    brain.close()


def test_a_paused_mission_has_left_its_graph_and_keeps_no_drone() -> None:
    brain = flying()
    assert brain.living == 2
    brain.command({"command": "leave", "mission": "a"}, 1.0)
    orders = settled(brain, 1.0)
    assert [order["do"] for order in orders] == ["break_off", "recover"]
    assert brain.living == 1
    where = brain.whereabouts()
    assert (where["a"]["lives"], where["a"]["drone"], where["a"]["flies"]) == (False, None, False)
    assert where["b"]["lives"]
    brain.close()


def test_a_retired_drone_is_given_to_no_mission_until_it_is_back() -> None:
    brain = charged(2)
    brain.command({"command": "retire", "drone": "cf1"}, 0.0)
    assert brain.drones()["cf1"]["status"] == "OFFLINE"
    brain.begin([{"trips": [trip(3.0)]}, {"trips": [trip(3.0)]}], 1.0)
    assert [order["drone"] for order in settled(brain, 1.0)] == ["cf2"]
    brain.command({"command": "bring-back", "drone": "cf1"}, 2.0)
    assert [order["drone"] for order in settled(brain, 2.0)] == ["cf1"]
    brain.close()


def test_a_drone_that_was_not_ready_is_told_that_a_person_has_looked_after_it() -> None:
    brain = charged(recorded=True)
    report = {"reached": True, "landed": True, "problems": ["it lies on its back"]}
    brain.go_on({}, {"cf1": report}, 0.0)
    assert [order["do"] for order in settled(brain, 0.0)] == ["recover"]
    assert brain.drones()["cf1"]["unready"] == "it lies on its back"
    brain.command({"command": "bring-back", "drone": "cf1"}, 5.0)
    assert [order["do"] for order in settled(brain, 5.0)] == ["mended"]
    brain.close()


@pytest.mark.parametrize(
    ("report", "orders", "status"),
    [
        ({}, [], "FREE"),
        ({"landed": False}, ["recover"], "RECOVERING"),
        ({"reached": False}, ["recover"], "RECOVERING"),
        ({"carrying": "pills"}, ["recover"], "RECOVERING"),
        ({"problems": ["its battery has 3.4 V"]}, ["recover"], "RECOVERING"),
    ],
)
def test_a_drone_is_free_only_where_it_is_well_and_empty_on_the_ground(
    report: dict[str, object], orders: list[str], status: str
) -> None:
    brain = charged(recorded=True)
    brain.go_on({}, {"cf1": report}, 0.0)
    assert [order["do"] for order in settled(brain, 0.0)] == orders
    assert brain.drones()["cf1"]["status"] == status
    brain.close()


def test_a_lost_drone_stays_lost_and_one_in_the_air_comes_down_first() -> None:
    for landed, orders in ((True, []), (False, ["recover"])):
        brain = charged(recorded=True)
        lost = {"reason": "it crashed", "at": None}
        brain.restore({"drones": {"cf1": {"lost": lost}}}, 0.0)
        brain.go_on({}, {"cf1": {"landed": landed}}, 0.0)
        given = settled(brain, 0.0)
        assert [order["do"] for order in given] == orders
        for order in given:
            brain.tell({"done": order["id"], "value": True}, 1.0)
        drone = brain.drones()["cf1"]
        assert (drone["status"], drone["unready"]) == ("LOST", "it crashed")
        brain.close()


def test_a_higher_priority_is_given_to_one_trip_alone() -> None:
    brain = charged()
    brain.begin([{"name": name, "trips": [trip(3.0)]} for name in "abc"], 0.0)
    (order,) = settled(brain, 0.0)
    request = {"command": "prioritise", "mission": "c", "trip": "1", "priority": 5}
    brain.command(request, 1.0)
    brain.tell({"done": order["id"], "telemetry": {"cf1": {"landed": True}}}, 9.0)
    assert [order["flight"] for order in settled(brain, 9.0)] == ["c/1/0/1"]
    brain.close()


def test_a_block_returns_only_what_it_declares() -> None:
    """Of any package: the graph's checks rely on it."""
    assert declared("zoo", Status.FAILED, (Status.STANDBY, Status.FAILED)) is Status.FAILED
    for returned, statuses, says in (
        (Status.RUNNING, (Status.FAILED,), "block zoo gave RUNNING, and it declares FAILED"),
        (
            None,
            (Status.FAILED, Status.STANDBY),
            "gave a NoneType, and it declares FAILED or STANDBY",
        ),
        (Status.RUNNING, (), "gave RUNNING, and it declares no status"),
    ):
        with pytest.raises(MissionFailed, match=says):
            declared("zoo", returned, statuses)
