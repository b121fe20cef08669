"""Why a mission waits for a drone, and which drone is ready: as allocation has it, in words."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Category, Item
from pluto_fleet.shared.time.kernel import FLEET
from pluto_fleet.station.wait_reasons import WaitReasons
from pluto_fleet.station.wire import Words
from tests.kit import apps
from tests.kit.living import Living, enterable

HOMES = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), (2.5, 0.5, 0.0))


def living(*missions: apps.Mission, low: float | None = None, **on: Any) -> Living:
    """Return a fleet of three that has just been asked how it is, with so much in its batteries."""
    fleet = Living(enterable(), *missions, on=apps.fleet(*HOMES, **on))
    for body in fleet.navigation.bodies.values() if low is not None else ():
        body.stand(body.home, low or 0.0)
    fleet.run(0.5)
    return fleet


def far(name: str, **more: Any) -> apps.Mission:
    return apps.mission(name, apps.trip("1", 19.0, 19.0, **more))


def looking(fleet: Living) -> WaitReasons:
    """Return the reasons at the beginning of a sample; the last drone has joined since the flight began."""
    at_first = replace(fleet.fleet, drones=fleet.fleet.drones[:-1])
    waiting = WaitReasons(fleet.app, at_first, lambda: 0.0)
    waiting.look(fleet.life.brain, fleet.fleet)
    return waiting


def said(fleet: Living) -> list[str]:
    """Return what is said of each that waits, in English."""
    return [one["text"] for one in reasons(fleet)]


def reasons(fleet: Living) -> list[Words]:
    waiting, where = looking(fleet), fleet.life.brain.whereabouts()
    missions = fleet.life.records.missions.items()
    found = [
        waiting.why(name, one["todo"])
        for name, one in missions
        if name in where and where[name]["drone"] is None
    ]
    return [one for one in found if one is not None]


def test_drones_that_are_free_but_too_low_are_not_what_a_mission_waits_for_without_a_word() -> None:
    """It says how many are too low, what it takes, and what the nearest to it has."""
    fleet = living(far("a"), far("b"), low=0.25)
    begin, end = "waits for a drone (3 free, but too low: it takes ", " %, the nearest has 25 %)"
    takes = [why.removeprefix(begin).removesuffix(end) for why in said(fleet)]
    assert len(takes) == 2 and all(25 < int(percent) < 100 for percent in takes)
    facts = [one["facts"] for one in reasons(fleet)]
    assert facts == [{"low": 3, "takes": int(percent) / 100, "has": 0.25} for percent in takes]


def test_when_a_drone_is_ready_that_is_too_low_is_when_it_flies() -> None:
    fleet = living(far("a"), far("b"), low=0.25)
    waiting, now = looking(fleet), fleet.life.kernel.time()
    for name, one in fleet.life.records.missions.items():
        waiting.why(name, one["todo"])
    assert waiting.takes is not None and 0.25 < waiting.takes < 1
    drones = fleet.life.brain.drones()
    found = [waiting.ready_in(id, drone, True) for id, drone in drones.items()]
    for id, drone in drones.items():
        assert waiting.ready_in(id, {**drone, "at": [9.0, 9.0, 0.0]}, True) is None
        assert waiting.ready_in(id, drone, False) is None
    fleet.run()
    ready = min(one for one in found if one is not None)
    assert fleet.times("trip.launched")[0] == pytest.approx(now + ready, abs=5.0)


def test_drones_that_can_never_fly_it_are_counted_apart_with_the_reason() -> None:
    heavy = Item(name="a sack", mass=0.5)
    mission = apps.mission("a", apps.trip("1", 4.0, action="pick_item", item=heavy))
    carrier = Category(name="carrier", payload=1.0)
    app = apps.changed(enterable(), categories=(apps.SCOUT, carrier))
    kinds = ["scout", "scout", "carrier"]
    fleet = Living(app, mission, on=apps.fleet(*HOMES, categories=kinds))
    fleet.at(0.2, lambda: fleet.life.control.retire("cf3"))
    fleet.navigation.bodies["cf3"].stand(HOMES[2], 0.05)  # it cannot be given: they wait
    fleet.run(0.5)
    (why,) = reasons(fleet)
    cannot = "2 cannot: scout carries at most 10 g, the item weighs 500 g"
    assert why["text"] == f"waits for a drone (1 retired; {cannot})"
    assert why["facts"] == {"retired": 1, "cannot": [cannot]}


def test_who_is_busy_lost_or_kept_on_the_ground_by_the_limit_is_said() -> None:
    missions = [apps.mission(name, apps.trip("1", 9.0)) for name in "abc"]
    full = living(*missions, max_airborne=1)
    assert said(full) == ["waits for a drone (2 free, but no more may fly at once; 1 flying)"] * 2
    assert {one["key"] for one in reasons(full)} == {"wait.drone-full"}
    fleet = living(*missions, apps.mission("d", apps.trip("1", 9.0)))
    fleet.life.control.retire("cf1")  # it is lost for all that, and counted once
    fleet.kernel.spawn(fleet.gateway.cut_motors("cf1"), FLEET, "the motors of one are cut")
    fleet.run(5.0)
    assert said(fleet) == ["waits for a drone (1 lost; 2 flying)"]
    assert [one["facts"] for one in reasons(fleet)] == [{"lost": 1, "flying": 2}]


def test_a_free_drone_with_little_more_than_its_reserve_or_too_little_for_all_is_not_ready() -> (
    None
):
    def why_low(fleet: Living) -> list[str]:
        waiting = looking(fleet)
        return [waiting.why_low(drone) for drone in fleet.life.brain.drones().values()]

    too_low = "its battery is too low for every trip that waits"
    assert why_low(living(far("a"), low=0.25)) == [too_low] * 3
    near = apps.mission("a", apps.trip("1", 1.0))
    little = "its battery has little more than its reserve"
    assert sorted(why_low(living(near, low=0.3))) == ["", little, little]  # one flies
    assert why_low(living(near)) == ["", "", ""]
