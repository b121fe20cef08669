"""What a person may tell a running app, and what becomes of its missions then."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Drone, Trip
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials.invariants import violations
from tests.kit import apps
from tests.kit.living import Living, enterable, names


def two_trips() -> apps.Mission:
    return apps.mission("a", apps.trip("1", 3), apps.trip("2", 5))


def test_a_paused_mission_flies_nothing_until_it_goes_on_and_loses_no_attempt() -> None:
    living = Living(enterable(), two_trips())
    living.at(3.0, lambda: living.life.control.pause("a"))
    living.at(100.0, lambda: living.life.control.go_on("a"))
    assert living.run() == ["COMPLETED"]
    launched = living.named("trip.launched")
    assert names(launched, "attempt") == [1, 1, 1]
    assert living.times("trip.launched")[1] >= 100.0
    assert living.done_by_drones == [("take_photo", ""), ("take_photo", "")]


def test_a_mission_that_is_paused_stays_so_when_the_app_dies() -> None:
    living = Living(enterable(), two_trips())
    living.at(3.0, lambda: living.life.control.pause("a"))
    living.crash(50.0)
    living.at(100.0, lambda: living.life.control.go_on())
    living.run(90.0)
    assert living.statuses == ["PAUSED"]
    assert living.run() == ["COMPLETED"]
    assert living.times("trip.launched")[-2] >= 100.0


@pytest.mark.parametrize("stopped", [False, True])
def test_a_delay_does_not_pass_while_its_mission_is_paused(stopped: bool) -> None:
    living = Living(enterable(clock=True), apps.mission("a", apps.trip("1", 3, delay=20.0)))
    living.at(5.0, lambda: living.life.control.pause("a"))
    if stopped:
        living.stop(10.0, rest=30.0)
    living.at(50.0, lambda: living.life.control.go_on("a"))
    assert living.run() == ["COMPLETED"]
    assert living.times("trip.launched") == [65.0]


def test_what_a_person_says_before_the_first_drone_is_remembered_by_a_later_life() -> None:
    alone = replace(apps.fleet(), drones=apps.fleet().drones[:1])
    others = apps.mission("a", apps.trip("1", 3))
    waits = apps.mission("b", apps.trip("1", 3), apps.trip("2", 4), apps.trip("3", 5))
    living = Living(enterable(), others, waits, on=alone)
    living.at(2.0, lambda: living.life.control.skip("b", "1"))
    living.at(2.0, lambda: living.life.control.prioritise("b", "3", 7))
    living.crash(3.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]
    assert names(living.named("mission.created"), "mission") == ["a", "b"]
    assert [trip["name"] for trip in living.life.recorder.standing.missions["b"]["gone"]] == ["1"]
    last = living.life.recorder.standing.missions["b"]["done"][-1]
    assert (last["name"], last["fields"]["priority"]) == ("3", 7)
    assert violations(living.events, {}) == []


def test_what_picks_or_releases_cannot_be_skipped_by_itself() -> None:
    living = Living(enterable(), apps.mission("a", apps.pick("p", 3), apps.release("r", 5)))
    living.run(1.0)
    with pytest.raises(BadInput, match="cancel the mission instead"):
        living.life.control.skip("a")


def test_a_mission_with_an_item_aboard_can_be_cancelled() -> None:
    living = Living(enterable(), apps.mission("a", apps.pick("p", 3), apps.release("r", 9)))
    living.at(14.0, lambda: living.life.control.cancel("a"))
    assert living.run() == ["CANCELLED"]
    assert living.done_by_drones == [("pick_item", "pills")]
    assert living.navigation.carrying("cf1") is None


@pytest.mark.parametrize("when", [3.0, 14.0, 20.0])
def test_a_paused_mission_goes_on_with_the_drone_that_has_its_item(when: float) -> None:
    """Before it has picked it, while it carries it, and in flight with it."""
    homes = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))
    delivery = apps.mission("a", apps.pick("p", 3), apps.release("r", 15))
    living = Living(enterable(), delivery, on=apps.fleet(*homes))
    living.at(when, lambda: living.life.control.pause("a"))
    living.at(90.0, lambda: living.life.control.go_on("a"))
    assert living.run() == ["COMPLETED"]
    assert len(set(names(living.named("trip.completed"), "drone"))) == 1
    assert violations(living.events, {}) == []


def test_what_does_not_fit_is_told_to_no_mission() -> None:
    living = Living(enterable(), two_trips())
    living.run(1.0)
    control = living.life.control
    with pytest.raises(BadInput, match='no mission "x" is under way; there are: "a"'):
        control.pause("x")
    with pytest.raises(BadInput, match='mission "a" is RUNNING'):
        control.go_on("a")
    with pytest.raises(BadInput, match="no mission is paused"):
        control.go_on()
    with pytest.raises(BadInput, match='mission "a" is RUNNING: it asks nothing'):
        control.decide("a", "done")
    with pytest.raises(BadInput, match='has no trip "7" to do; it has "1", "2"'):
        control.skip("a", "7")


async def _spray(drone: Drone, trip: Trip, context: Context) -> None:
    await context.sleep(10.0)


def test_an_action_that_is_safe_to_repeat_is_flown_again() -> None:
    spray = OwnAction(name="spray", repeat="safe", hook=_spray)
    mission = apps.mission("a", apps.trip("1", 3, action="spray"), apps.trip("2", 3))
    living = Living(enterable(actions=(spray,)), mission)
    living.crash(10.0)
    assert living.run() == ["COMPLETED"]
    assert names(living.named("trip.launched"), "trip") == ["1", "1", "2"]
    assert names(living.named("trip.launched"), "attempt") == [1, 1, 1]


def test_after_a_stop_nothing_else_is_done() -> None:
    living = Living(enterable(), two_trips())
    living.run(3.0)
    living.life.control.stop(Down.HOME)
    for command in (living.life.control.pause, living.life.control.cancel):
        with pytest.raises(BadInput, match="everything was stopped: resume the journal first"):
            command("a")
    assert living.kernel.run(living.life.control.stopped)
