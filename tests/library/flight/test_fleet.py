"""What may be changed of a fleet while it flies: priorities, drones, more missions."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import AfterTrip
from pluto_fleet.shared.domain.status import DroneStatus
from pluto_fleet.shared.time.kernel import Future
from pluto_fleet.shared.time.told import Stuck
from tests.kit import apps
from tests.kit.living import Living, enterable, names

HOMES = ((1.0, 0.5, 0.0), (2.0, 0.5, 0.0))
ONE_DRONE, TWO_DRONES = apps.fleet(HOMES[0]), apps.fleet(*HOMES)


def missions(*called: str) -> list[apps.Mission]:
    return [apps.mission(name, apps.trip("1", 3)) for name in called]


def standing(living: Living) -> list[DroneStatus]:
    return [drone.status for drone in living.life.drones]


def test_a_trip_to_come_keeps_the_priority_that_it_was_given_though_the_app_dies() -> None:
    two = apps.mission("b", apps.trip("1", 3), apps.trip("2", 3))
    living = Living(enterable(), *missions("a"), two, *missions("c"), on=ONE_DRONE)
    living.at(2.0, lambda: living.life.control.prioritise("b", "1", 3))
    living.at(2.0, lambda: living.life.control.prioritise("b", "2", 3))
    living.crash(3.0)
    assert living.run() == ["COMPLETED"] * 3
    launched = living.named("trip.launched")
    assert names(launched, "mission")[-3:] == ["b", "b", "c"]


def test_a_retired_drone_stays_so_when_the_app_dies() -> None:
    living = Living(enterable(), *missions("a", "b", "c"), on=TWO_DRONES)
    living.at(2.0, lambda: living.life.control.retire("cf1"))
    living.crash(3.0)
    assert living.run() == ["COMPLETED"] * 3
    assert names(living.named("trip.launched"), "drone").count("cf1") == 1
    assert standing(living)[0] is DroneStatus.OFFLINE


def test_a_retired_drone_that_stands_in_the_field_comes_home() -> None:
    field = apps.fleet(*HOMES, after=AfterTrip.STAY)
    living = Living(enterable(), *missions("a"), on=field)
    living.run()
    who = next(drone for drone in living.life.drones if drone.trips)
    living.life.control.retire(who.id)
    with pytest.raises(Stuck):  # it is at home, and nothing is left to do
        living.kernel.run(Future[None](), 200.0)
    who = next(drone for drone in living.life.drones if drone.id == who.id)
    assert who.status is DroneStatus.OFFLINE
    assert who.distance(who.home) < 0.1


def test_missions_can_be_added_while_others_fly_and_a_later_life_knows_them() -> None:
    living = Living(enterable(), *missions("a"), on=TWO_DRONES)
    living.at(2.0, lambda: living.life.add(missions("b")))
    living.crash(4.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]
    assert [mission.name for mission in living.life.missions] == ["a", "b"]


def test_nothing_is_added_before_it_is_known_where_the_drones_are() -> None:
    living = Living(enterable(), *missions("a"))
    with pytest.raises(BadInput, match="try again in a moment"):
        living.life.add(missions("b"))
    living.run()


def test_a_command_that_was_carried_out_is_known_by_its_name_in_a_later_life() -> None:
    living = Living(enterable(), *missions("a"))
    living.at(2.0, lambda: living.life.control.remember("x1", "skip"))
    living.crash(3.0)
    living.run()
    assert living.life.recorder.standing.commands == ["x1"]
