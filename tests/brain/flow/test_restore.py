"""What the events of a run say so that another can go on, and what waits until they are on record."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.model import Results
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.policies import nearest
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Verdict
from plutoc_blocks.clock.step import wait_for_time
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_repeater.step import repeat_mission
from plutoc_blocks.trip_launcher.step import launch_trip
from tests.brain.hand import charged, settled, trip
from tests.kit import apps

FREE = {"cf1": {"reached": True, "landed": True}}


def recorded(*trips: Any, **more: Any) -> tuple[Brain, list[Any]]:
    """Return a brain that is on record, and to which a mission was given; its action notes that it was called."""
    called: list[Any] = []
    spray = OwnAction(name="spray", hook=lambda drone, trip, context: called.append(trip.name))
    given: Any = apps.app(apps.flow(), actions=[spray]).given
    brain = charged(app=given, recorded=True, **more)
    brain.go_on({}, FREE, 0.0)
    brain.begin([{"name": "m", "trips": [*trips]}], 0.0)
    return brain, called


def test_an_action_of_the_apps_own_begins_when_all_before_it_is_on_record() -> None:
    """Messages of earlier rows may come late."""
    brain, called = recorded(trip(3.0, action="spray"), trip(4.0, action="spray"))
    said = 0
    for number in (1, 2):
        now = 10.0 * number
        (order,) = (order for order in settled(brain, now) if order["do"] == "fly")
        brain.tell({"done": order["id"]}, now)
        said += len(brain.events())
        brain.tell({"durable": said - 1}, now)
        settled(brain, now)
        assert len(called) == number - 1
        brain.tell({"durable": said}, now)
        brain.tell({"durable": 1}, now)
        brain.advance(now)
        assert len(called) == number
    brain.close()


def test_events_say_what_a_later_life_must_know() -> None:
    brain, _ = recorded(trip(3.0))
    (order,) = settled(brain, 1.0)
    brain.tell({"done": order["id"], "value": {"$number": "nan"}}, 9.0)
    facts = {str(event["event"]): event for event in brain.events()}
    plan: Any = facts["mission.created"]["plan"]
    assert (plan["index"], [one["name"] for one in plan["trips"]]) == (0, ["1"])
    assert facts["trip.completed"]["result"] == {"$number": "nan"}
    brain.close()


def test_a_mission_goes_on_where_its_record_says() -> None:
    """Its trips, its round, its attempts and its results."""
    brain, _ = recorded(trip(3.0), trip(4.0))
    (order,) = settled(brain, 1.0)
    brain.tell({"done": order["id"], "value": 7}, 9.0)
    record = brain.standing()
    brain.close()
    given: Any = apps.app(apps.flow()).given
    later = charged(app=given, recorded=True)
    later.restore(record, 20.0)
    later.go_on({"m": {}}, FREE, 20.0)
    (flight,) = (order for order in settled(later, 20.0) if order["do"] == "fly")
    assert flight["flight"] == "m/2/0/1"
    stands = later.standing()
    assert [one["name"] for one in stands["missions"]["m"]["done"]] == ["1"]
    assert (stands["missions"]["m"]["attempts"], stands["results"]) == (2, record["results"])
    assert [one["value"] for one in record["results"]] == [7]
    later.close()


async def held_on_the_drone(run: Run[apps.Mission]) -> Status:
    """Wait for the time of a round when a drone is allocated already."""
    status = run.status if run.at else create_mission(run, run.status)
    while True:
        run.at = None
        status = await allocate_drone(run, status, block="allocate", policy=nearest)
        status = await wait_for_time(run, status, block="wait", delay=None)
        status = await apps.watched(run, launch_trip(run, status))
        if status is Status.COMPLETED:
            status = repeat_mission(run, status, repeat=run.mission.repeat)
        if status is not Status.STANDBY:
            return status


def test_a_round_that_was_launched_before_a_stop_waits_for_no_time_again() -> None:
    """The Clock on its way would hold it until the time of the round after."""
    given: Any = apps.app(held_on_the_drone).given
    brain = charged(app=given, recorded=True)
    brain.go_on({}, FREE, 0.0)
    brain.begin([{"name": "m", "trips": [trip(3.0)], "fields": {"repeat": 1, "every": 100.0}}], 0.0)
    (first,) = settled(brain, 0.0)
    brain.tell({"done": first["id"]}, 9.0)
    assert [order for order in settled(brain, 99.0) if order["do"] == "fly"] == []
    (second,) = (order for order in settled(brain, 100.0) if order["do"] == "fly")
    record = brain.standing()
    brain.close()
    later = charged(app=given, recorded=True)
    later.restore(record, 110.0)
    later.go_on({"m": {}}, {}, 110.0)
    (attached,) = settled(later, 110.0)
    assert (attached["do"], attached["flight"]) == ("attach", second["flight"])
    later.tell({"done": attached["id"]}, 111.0)
    settled(later, 111.0)
    assert [event["status"] for event in later.events() if event["event"] == "mission.ended"] == [
        "COMPLETED"
    ]
    later.close()


@pytest.mark.parametrize(("judged", "seen"), [(0, [7]), (1, [])])
def test_an_evaluator_is_given_what_it_has_not_seen_before_the_stop(
    judged: int, seen: list[int]
) -> None:
    given: list[list[Any]] = []

    def judge(mission: Any, results: Results[Any, Any]) -> Verdict:
        given.append([one.value for one in results.new if one.trip.name == "1"])
        return Verdict()

    first, _ = recorded(trip(3.0), trip(4.0))
    (order,) = settled(first, 1.0)
    first.tell({"done": order["id"], "value": 7}, 9.0)
    record: Any = first.standing()
    first.close()
    record["missions"]["m"]["judged"] = judged
    app: Any = apps.app(apps.flow(evaluator=judge)).given
    later = charged(app=app, recorded=True)
    later.restore(record, 20.0)
    later.go_on({"m": {}}, FREE, 20.0)
    (flight,) = (order for order in settled(later, 20.0) if order["do"] == "fly")
    later.tell({"done": flight["id"], "value": 8}, 30.0)
    settled(later, 30.0)
    assert given == [seen]
    later.close()
