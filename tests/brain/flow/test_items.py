"""Items: from pick to release a mission keeps its drone."""

from __future__ import annotations

from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from tests.kit import apps

HOMES = ((0.5, 0.5, 0.0), (6.0, 0.5, 0.0))


def carrying() -> apps.Mission:
    trips = (apps.pick("A", 3.0), apps.trip("B", 6.0), apps.release("C", 9.0), apps.trip("D", 6.0))
    return apps.mission("m", *trips)


def test_one_drone_flies_from_the_pick_to_the_release() -> None:
    outcome = apps.flown(carrying(), on=apps.fleet(*HOMES))
    assert outcome.completed
    drones = [event["drone"] for event in apps.events(outcome, "trip.launched")]
    assert drones == ["cf1", "cf1", "cf1", "cf2"]


def test_a_drone_with_an_item_aboard_is_not_handed_to_another_mission() -> None:
    outcome = apps.flown(carrying(), apps.mission("other", apps.trip("X", 3.0)))
    assert outcome.completed
    order = [event["trip"] for event in apps.events(outcome, "trip.launched")]
    assert order.index("X") > order.index("C")


def test_a_failure_with_an_item_aboard_ends_the_mission_against_the_graph() -> None:
    async def fails(drone: object, trip: object, context: object) -> None:
        raise ActionFailed("the door is shut")

    knock = OwnAction(name="knock", hook=fails)
    trips = (apps.pick("A", 3.0), apps.trip("B", 6.0, action="knock"), apps.release("C", 9.0))
    outcome = apps.fly(apps.app(apps.flow(attempts=5), actions=[knock]), apps.mission("m", *trips))
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "knock failed: the door is shut, with pills aboard"
    assert outcome.count("trip.launched") == 2


def test_what_is_aboard_when_a_mission_ends_is_taken_off_before_the_drone_is_free() -> None:
    def breaks(mission: apps.Mission, context: object) -> None:
        if mission.name == "m" and mission.completed_trips:
            raise ValueError("no")

    def two() -> tuple[apps.Trip, apps.Trip]:
        return apps.pick("A", 3.0), apps.release("B", 9.0)

    outcome = apps.flown(apps.mission("m", *two()), apps.mission("n", *two()), prepare=breaks)
    assert [mission.status for mission in outcome.missions] == [Status.FAILED, Status.COMPLETED]
    free, *_ = apps.times(outcome, "drone.free")
    assert apps.times(outcome, "trip.launched")[1] >= free > apps.times(outcome, "mission.ended")[0]
