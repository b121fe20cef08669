"""Trips that have not flown are changed while their mission is under way."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from pluto_fleet.shared.domain.errors import BadInput, Failure
from pluto_fleet.trials.invariants import violations
from tests.kit import apps
from tests.kit.living import Living, enterable, names

Trip = Mapping[str, object]


def trip(name: str, x: float, **more: object) -> Trip:
    return {"name": name, "action": "take_photo", "target": [x, 1.0, 1.0], **more}


def three_trips() -> apps.Mission:
    return apps.mission("a", apps.trip("1", 3), apps.trip("2", 5), apps.trip("3", 7))


def change(living: Living, *trips: Trip, replaces: list[str] | None = None) -> str:
    return living.life.control.change_trips("a", trips, replaces)


def test_what_has_not_flown_is_flown_as_it_was_changed() -> None:
    """Another place, another order, a new trip, and one that is gone; what flies is not touched."""
    living = Living(enterable(), three_trips())
    living.at(3.0, lambda: change(living, trip("3", 4), trip("new", 6), replaces=["2", "3"]))
    assert living.run() == ["COMPLETED"]
    assert names(living.named("trip.completed"), "trip") == ["1", "3", "new"]
    done = living.life.recorder.standing.missions["a"]["done"]
    assert [one["target"][0] for one in done] == [3.0, 4.0, 6.0]
    assert living.named("trip.interrupted") == []
    assert violations(living.events, {}) == []


def test_a_change_goes_on_after_the_app_dies() -> None:
    """Whether it was made in flight, or before the first drone was there."""
    waits = apps.mission("b", apps.trip("1", 3), apps.trip("2", 4))
    living = Living(enterable(), three_trips(), waits)
    living.at(3.0, lambda: change(living, trip("3", 4)))
    living.at(
        3.0, lambda: living.life.control.change_trips("b", [trip("2", 8), trip("1", 3)], None)
    )
    living.crash(4.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]
    done = [(one["mission"], one["trip"]) for one in living.named("trip.completed")]
    assert sorted(done) == [("a", "1"), ("a", "3"), ("b", "1"), ("b", "2")]
    assert done.index(("b", "2")) < done.index(("b", "1"))
    assert living.life.recorder.standing.missions["b"]["done"][0]["target"][0] == 8.0
    assert violations(living.events, {}) == []


@pytest.mark.parametrize("crashes", [False, True])
def test_a_delay_that_runs_becomes_another(crashes: bool) -> None:
    mission = apps.mission("a", apps.trip("1", 3, delay=20.0))
    living = Living(enterable(clock=True), mission)
    living.at(5.0, lambda: change(living, trip("1", 3, delay="60 s")))
    if crashes:
        living.crash(8.0)
    assert living.run() == ["COMPLETED"]
    assert living.times("trip.launched") == [65.0]


def test_a_trip_that_has_failed_waits_behind_others_and_keeps_its_attempts() -> None:
    living = Living(enterable(attempts=3), three_trips())
    living.at(3.0, lambda: living.navigation.strike("cf1", Failure.LINK))
    living.at(9.0, lambda: change(living, trip("3", 7), trip("1", 3), replaces=["1", "2", "3"]))
    assert living.run() == ["COMPLETED"]
    launched = [(one["trip"], one["attempt"]) for one in living.named("trip.launched")]
    assert launched == [("1", 1), ("3", 1), ("1", 2)]
    assert violations(living.events, {}) == []


def test_what_has_taken_off_or_was_flown_meanwhile_is_told_by_its_name() -> None:
    living = Living(enterable(), three_trips())
    living.run(3.0)
    for replaces, trips, why in (
        (["1", "2", "3"], [], 'mission "a": trip "1" has taken off meanwhile: look at it again'),
        (["3", "2"], [], 'mission "a": it was changed: look at it again'),
        (None, [trip("1", 4)], 'mission "a": trip "1" has taken off meanwhile, and cannot be'),
    ):
        with pytest.raises(BadInput) as refusal:
            change(living, *trips, replaces=replaces)
        assert str(refusal.value).startswith(why)
    assert living.named("mission.replanned") == []


def test_what_cannot_be_flown_is_refused_in_words_and_changes_nothing() -> None:
    living = Living(enterable(), three_trips())
    living.run(3.0)
    item = {"name": "vial", "mass": "4 g"}
    for wrong, why in (
        (trip("4", 300), 'mission "a", trip "4": target [300, 1.0, 1.0] is outside the map'),
        ({**trip("4", 4), "action": "pick_item", "item": item}, "which no trip after it releases"),
        ({**trip("4", 4), "action": "release_item", "item": item}, "nothing is aboard"),
        ({**trip("4", 4), "action": "sing"}, "sing"),
        ({**trip("4", 4), "hue": 1}, "hue"),
        ({"name": 3}, "name"),
        ("4", "list of tables"),
    ):
        with pytest.raises(BadInput) as refusal:
            living.life.control.change_trips("a", [trip("2", 5), wrong], None)
        assert why in str(refusal.value), refusal.value
    assert living.run() == ["COMPLETED"]
    assert living.named("mission.replanned") == []


def test_a_mission_without_a_trip_left_and_one_that_has_ended_cannot_be_changed() -> None:
    waits = apps.mission("b", apps.trip("1", 3))
    living = Living(enterable(), apps.mission("a", apps.trip("1", 3)), waits)
    living.run(3.0)
    with pytest.raises(BadInput, match=r'mission "b" would have no trip left: cancel it instead'):
        living.life.control.change_trips("b", [], None)
    living.life.control.change_trips("a", [], None)  # what flies is its last trip then
    living.life.control.cancel("b")
    with pytest.raises(BadInput, match=r'no mission "b" is under way'):
        living.life.control.change_trips("b", [trip("1", 3)], None)
    assert living.run() == ["COMPLETED", "CANCELLED"]


def test_an_item_aboard_is_not_sent_farther_than_the_battery_reaches() -> None:
    living = Living(enterable(), apps.mission("a", apps.pick("p", 3), apps.release("r", 5)))
    living.run(3.0)
    living.navigation.bodies["cf1"].restore(
        {**living.navigation.bodies["cf1"].data, "charge": [0.25, 3.0, -1 / 420]}
    )
    item = living.life.recorder.standing.missions["a"]["todo"][-1]["item"]
    with pytest.raises(BadInput, match=r"cf1 has 25 % in its battery, and needs \d+ % for what it"):
        change(living, {**trip("r", 18), "action": "release_item", "item": item})
