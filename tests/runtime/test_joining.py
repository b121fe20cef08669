"""Drones that join the fleet while missions are under way."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from pluto_fleet.gateway.settings import joining_data
from pluto_fleet.simulation.body import simulated
from pluto_fleet.trials.invariants import violations

from . import apps
from .living import Living, enterable, names

NEW: dict[str, Any] = {"id": "cf9", "category": "scout", "home": [2.0, 8.0]}


def one_drone() -> Any:
    return replace(apps.fleet(), drones=apps.fleet().drones[:1])


def long(name: str) -> apps.Mission:
    return apps.mission(name, *(apps.trip(str(n), 3 + n) for n in range(3)))


def join(living: Living, entry: dict[str, Any] = NEW) -> str:
    """Have a drone join, as a flight does: the gateway has it first."""
    life = living.life
    fleet = life.control.fleet_with(entry)
    joining = joining_data(simulated(living.app, fleet)[-1], None)
    assert living.gateway.join(joining) == ""
    return life.control.join(entry)


def test_a_drone_that_joins_flies_what_waits() -> None:
    living = Living(enterable(), long("a"), long("b"), on=one_drone())
    living.at(3.0, lambda: join(living))
    assert living.run() == ["COMPLETED", "COMPLETED"]
    assert {one["drone"] for one in living.named("trip.launched")} == {"cf1", "cf9"}
    assert names(living.named("drone.joined"), "drone") == ["cf9"]
    assert [drone.id for drone in living.life.drones] == ["cf1", "cf9"]
    assert violations(living.events, {}) == []


def test_a_drone_that_has_joined_is_there_in_every_later_life() -> None:
    living = Living(enterable(), long("a"), long("b"), on=one_drone())
    living.at(3.0, lambda: join(living))
    living.crash(9.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]
    assert [drone.id for drone in living.life.drones] == ["cf1", "cf9"]
    late = [one["drone"] for one in living.named("trip.completed") if one["t"] > 10]
    assert "cf9" in late
    assert violations(living.events, {}) == []
