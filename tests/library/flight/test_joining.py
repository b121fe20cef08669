"""Drones that join the fleet while missions are under way."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.gateway.settings import joining_data
from pluto_fleet.jobs.controls import fleet_drones
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.trials.invariants import violations
from tests.kit import apps
from tests.kit.living import Living, enterable, names

NEW: dict[str, Any] = {"id": "cf9", "category": "scout", "home": [2.0, 8.0]}


def long(name: str) -> apps.Mission:
    return apps.mission(name, *(apps.trip(str(n), 3 + n) for n in range(3)))


def join(living: Living, entry: dict[str, Any] = NEW) -> str:
    """Have a drone join, as a flight does: the gateway has it first."""
    life = living.life
    fleet = life.control.fleet_with(entry)
    joining = joining_data(fleet_drones(living.app, fleet)[-1], None)
    assert living.gateway.join(joining) == ""
    return life.control.join(entry)


def test_a_drone_that_has_joined_is_there_in_every_later_life() -> None:
    living = Living(enterable(), long("a"), long("b"))
    living.at(3.0, lambda: join(living))
    living.crash(9.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]
    assert [drone.id for drone in living.life.drones] == ["cf1", "cf9"]
    assert "cf9" in names(living.named("trip.completed"), "drone")
    assert violations(living.events, {}) == []


def test_a_drone_that_cannot_join_is_told_why() -> None:
    living = Living(enterable(), long("a"))
    with pytest.raises(BadInput, match="the drones are just being asked where they are"):
        join(living)
    living.run(3.0)
    for wrong, why in (
        ({"id": "cf1"}, 'drone "cf1": there is another drone "cf1": names must differ'),
        ({"category": "whale"}, 'drone "cf9": category "whale" is none of: scout'),
        ({"home": [99.0, 1.0]}, 'drone "cf9": home [99.0, 1.0] is outside the map'),
        ({"home": [0.5, 0.52]}, 'drone "cf9": home is where drone "cf1" has its own'),
        ({"home": [2.0, 8.0, 1.0]}, 'drone "cf9": a drone that joins has its dock on the ground'),
        ({"home": [1.0]}, 'drone "cf9": home'),
        ({"wings": 2}, 'drone "cf9": unknown key "wings"'),
        ({"id": 7}, "drone 2: id 7"),
    ):
        with pytest.raises(BadInput) as refusal:
            join(living, {**NEW, **wrong})
        assert str(refusal.value).startswith(why), refusal.value
    assert living.run() == ["COMPLETED"]
    assert living.named("drone.joined") == []
