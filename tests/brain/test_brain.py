"""A brain driven by hand: what is told and ordered, without drones and without a clock."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.brain import Brain
from tests.brain.hand import charged, settled, trip
from tests.kit import apps


def kinds(brain: Brain) -> list[object]:
    """Return what has happened, by its names."""
    return [event["event"] for event in brain.events()]


def test_the_simplest_flight() -> None:
    """Ten lines: a mission begins, its trip is ordered, done, and the drone is told to come home."""
    brain = charged()
    brain.begin([{"trips": [trip()]}], 0.0)
    (order,) = settled(brain, 0.0)
    assert (order["do"], order["drone"], order["flight"]) == ("fly", "cf1", "1/1/0/1")
    brain.tell({"telemetry": {"cf1": {"at": [3.0, 0.5, 1.2], "landed": False}}}, 9.0)
    brain.tell({"done": order["id"], "value": None}, 9.0)
    (home,) = settled(brain, 9.0)
    brain.tell({"telemetry": {"cf1": {"at": [1.0, 0.5, 0.0], "landed": True}}}, 14.0)
    brain.tell({"done": home["id"]}, 14.0)
    assert (home["do"], brain.over, brain.due) == ("home", 9.0, None)
    assert kinds(brain) == [
        "mission.created",
        "trip.allocated",
        "trip.launched",
        "trip.completed",
        "drone.returning",
        "mission.ended",
        "drone.free",
    ]
    brain.close()


def test_an_order_says_all_that_is_needed_to_carry_it_out() -> None:
    """Numbers, texts, lists and mappings."""
    brain = charged()
    item = {"name": "pills", "mass": 0.004}
    picks = trip(action="pick_item", source=[2.0, 1.0, 1.2], item=item)
    brain.begin([{"trips": [picks, trip(4.0, action="release_item", item=item)]}], 0.0)
    (order,) = settled(brain, 0.0)
    assert order == {
        "id": 1,
        "do": "fly",
        "drone": "cf1",
        "flight": "1/1/0/1",
        "stops": ((2.0, 1.0, 1.2), (3.0, 0.5, 1.2)),
        "seconds": order["seconds"],
        "action": "pick_item",
        "parameters": {},
        "item": item,
        "beside": False,
    }
    brain.close()


def test_several_messages_of_one_instant_are_all_known_before_drones_are_given() -> None:
    """The drone that stands first in the fleet serves the mission that waits longest."""
    brain = charged(2, apps.app(apps.flow()), after_trip="stay")
    brain.begin([{"trips": [trip(3.0 + number)]} for number in range(4)], 0.0)
    first, second = settled(brain, 0.0)
    assert [one["flight"] for one in (first, second)] == ["1/1/0/1", "2/1/0/1"]
    places = {"cf1": {"at": [3.0, 0.5, 0.0]}, "cf2": {"at": [4.0, 0.5, 0.0]}}
    brain.tell({"done": second["id"], "telemetry": places}, 9.0)
    brain.tell({"done": first["id"]}, 9.0)
    assert brain.orders() == []
    assert brain.due == 9.0  # both drones are free: now they are given
    orders = settled(brain, 9.0)
    assert [(one["flight"], one["drone"]) for one in orders] == [
        ("3/1/0/1", "cf2"),  # the nearest, for who waits longest
        ("4/1/0/1", "cf1"),
    ]
    brain.close()


def test_due_is_when_something_happens_by_itself() -> None:
    """A limit on a flight, here; nothing at all once it has ended and no task waits."""
    brain = charged(1, apps.app(apps.flow(watch=apps.timed)))
    assert brain.due is None
    brain.begin([{"trips": [trip()], "fields": {"safe_time": 20.0}}], 1.0)
    assert brain.due == 1.0
    (order,) = settled(brain, 1.0)
    assert brain.due == 21.0
    assert settled(brain, 20.0) == []
    assert [one["do"] for one in settled(brain, 21.0)] == ["break_off", "recover"]
    brain.tell({"done": order["id"]}, 22.0)  # too late
    assert kinds(brain)[-3:] == ["trip.failed", "drone.recovering", "mission.ended"]
    brain.close()


@pytest.mark.parametrize(("home", "status"), [(True, "FREE"), (False, "LOST")])
def test_it_is_over_when_missions_have_ended_and_drones_are_down(home: bool, status: str) -> None:
    """What `over` says is when the last mission ended; a drone that is lost is waited for no longer."""
    brain = charged()
    brain.begin([{"name": "a", "trips": [trip()]}], 0.0)
    (order,) = settled(brain, 0.0)
    brain.tell({"failed": order["id"], "failure": "LINK", "reason": "cf1 lost its link"}, 5.0)
    assert brain.over is None
    (recovery,) = settled(brain, 5.0)
    assert recovery["do"] == "recover"
    brain.tell({"done": recovery["id"], "value": home}, 35.0)
    assert brain.over == 5.0
    standing = brain.standing()
    assert standing["missions"]["a"]["status"] == "FAILED"
    assert standing["missions"]["a"]["reason"] == "cf1 lost its link"
    assert standing["drones"]["cf1"]["status"] == status
    brain.close()


@pytest.mark.parametrize("fails", [False, True])
def test_a_drone_that_never_reaches_its_dock_is_lost_after_a_few_flights_home(fails: bool) -> None:
    """It would fly until its battery is empty: a person must see what stands in its dock."""
    brain = charged()
    brain.begin([{"trips": [trip()]}], 0.0)
    (order,) = settled(brain, 0.0)
    brain.tell({"telemetry": {"cf1": {"battery": 0.1, "landed": False}}}, 5.0)
    brain.tell({"done": order["id"]}, 5.0)
    done: list[object] = []
    while (orders := settled(brain, 5.0)) and len(done) < 20:
        (order,) = orders
        done.append(order["do"])
        failed = fails and order["do"] == "home"
        brain.tell({"telemetry": {"cf1": {"at": [1.5, 0.5, 0.0], "landed": True}}}, 5.0)
        answer = {"failed": order["id"], "failure": "REFUSED", "reason": "its dock is taken"}
        brain.tell(answer if failed else {"done": order["id"], "value": True}, 5.0)
    assert done == (["home", "recover"] * 3 if fails else ["home"] * 3)
    (drone,) = brain.drones().values()
    assert drone["status"] == "LOST"
    assert drone["unready"] == "it flew home 3 times, and landed 0.5 m from its dock"
    assert brain.over == 5.0
    brain.close()


@pytest.mark.parametrize(
    ("reason", "value", "why"),
    [
        ("it fell", False, "it fell"),
        ("", False, "it could not be brought home"),
        ("x" * 600, False, "x" * 499 + "…"),
        ("it fell", "it lies on its back", "it lies on its back"),
    ],
)
def test_why_a_drone_is_lost(reason: str, value: object, why: str) -> None:
    """What it says itself, or why its flight failed."""
    brain = charged()
    brain.begin([{"trips": [trip()]}], 0.0)
    (order,) = settled(brain, 0.0)
    brain.tell({"failed": order["id"], "failure": "CRASH", "reason": reason}, 5.0)
    (recovery,) = settled(brain, 5.0)
    brain.tell({"done": recovery["id"], "value": value}, 6.0)
    (drone,) = brain.drones().values()
    assert (drone["status"], drone["unready"]) == ("LOST", why)
    assert [e["reason"] for e in brain.events() if e["event"] == "drone.lost"] == [why]
    brain.close()


def test_missions_may_begin_while_others_fly() -> None:
    """They are numbered on, and it is not over before they have ended."""
    brain = charged(2)
    brain.begin([{"trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    brain.begin([{"trips": [trip()]}, {"trips": [trip()]}], 3.0)
    (order,) = settled(brain, 3.0)
    assert order["flight"] == "2/1/0/1"
    assert list(brain.standing()["missions"]) == ["1", "2", "3"]
    assert brain.standing()["waiting"] == "2 busy"
    brain.close()


def test_a_silent_brain_keeps_no_events() -> None:
    """For those who only want to know how it ends."""
    brain = charged(silent=True)
    brain.begin([{"trips": [trip()]}], 0.0)
    assert len(settled(brain, 0.0)) == 1
    assert brain.events() == []
    brain.close()


def test_a_deadline_that_passes_while_the_app_is_down_is_missed_once() -> None:
    promised = {"name": "1", "trips": [trip()], "promises": {"deadline": 5.0}}
    first = charged(recorded=True)
    first.begin([promised], 0.0)
    later = charged(recorded=True)
    later.restore(first.standing(), 9.0)
    assert [event["event"] for event in later.events()] == ["mission.late"]
    rows = {key: row for table, key, row in later.rows() if table == "mission"}
    assert rows["1",]["late"]
    last = charged(recorded=True)
    last.restore(later.standing(), 12.0)
    assert last.events() == []
