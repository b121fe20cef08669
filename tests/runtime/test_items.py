"""Items: from pick to release a mission keeps its drone."""

from __future__ import annotations

from plutoc_runtime.actions import Action
from plutoc_runtime.errors import ActionFailed
from plutoc_runtime.simulation.faults import Faults
from plutoc_runtime.status import Status
from tests.runtime import apps

HOMES = ((0.5, 0.5, 0.0), (6.0, 0.5, 0.0))


def carrying() -> apps.Mission:
    trips = (apps.pick("A", 3.0), apps.trip("B", 6.0), apps.release("C", 9.0), apps.trip("D", 6.0))
    return apps.mission("m", *trips)


def test_one_drone_flies_from_the_pick_to_the_release() -> None:
    outcome = apps.fly(apps.app(apps.flow()), carrying(), on=apps.fleet(*HOMES))
    assert outcome.completed
    drones = [event["drone"] for event in apps.events(outcome, "trip.launched")]
    assert drones == ["cf1", "cf1", "cf1", "cf2"]


def test_a_drone_with_an_item_aboard_is_not_handed_to_another_mission() -> None:
    outcome = apps.fly(
        apps.app(apps.flow()), carrying(), apps.mission("other", apps.trip("X", 3.0))
    )
    assert outcome.completed
    order = [event["trip"] for event in apps.events(outcome, "trip.launched")]
    assert order.index("X") > order.index("C")


def test_a_failure_with_an_item_aboard_ends_the_mission_whatever_the_graph_says() -> None:
    async def fails(drone: object, trip: object, context: object) -> None:
        raise ActionFailed("the door is shut")

    knock = Action(name="knock", hook=fails)
    trips = (apps.pick("A", 3.0), apps.trip("B", 6.0, action="knock"), apps.release("C", 9.0))
    outcome = apps.fly(apps.app(apps.flow(attempts=5), actions=[knock]), apps.mission("m", *trips))
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "knock failed: the door is shut, with pills aboard"
    assert outcome.count("trip.launched") == 2


def test_a_failure_before_the_pick_is_retried() -> None:
    seed = next(
        seed
        for seed in range(50)
        if apps.fly(
            apps.app(apps.flow(attempts=3)),
            apps.mission("m", apps.pick("A", 3.0), apps.release("B", 9.0)),
            faults=Faults(action=0.3),
            seed=seed,
        ).count("trip.failed")
        == 1
    )
    outcome = apps.fly(
        apps.app(apps.flow(attempts=3)),
        apps.mission("m", apps.pick("A", 3.0), apps.release("B", 9.0)),
        faults=Faults(action=0.3),
        seed=seed,
    )
    failed_trip = apps.events(outcome, "trip.failed")[0]["trip"]
    assert outcome.completed == (failed_trip == "A")
