"""What the gateway's process is told of real drones, and what becomes of those that are not ready."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from itertools import combinations
from math import dist
from pathlib import Path

import msgspec
import pytest

from pluto_fleet.drones.real_fleet import RealDrone, RealFleet, RequiredAction, real_fleet
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.files.stand_ins import CRTP, StandIns, as_stand_ins
from pluto_fleet.flight.config import FlightSetup
from pluto_fleet.flight.lives import aloft, may_hover
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Drone, Point
from pluto_fleet.shared.hooks.plain_data import trip_data
from tests.kit import apps

FLEET = FleetFile(
    airspace=Airspace(),
    drones=(
        DroneEntry(
            id="a", category="scout", home=(1.0, 1.0, 0.0), uri="radio://0/80/2M/E7E7E7E701"
        ),
        DroneEntry(
            id="b",
            category="scout",
            home=(2.0, 1.0, 0.0),
            navigation="tello:Tello",
            options={"ports": [1, 2]},
        ),
    ),
    options={"crazyflie": {"measure": {"pm10": "sps.pm10"}}},
)
MISSIONS = [
    apps.mission(
        "North",
        apps.trip("A", 1.0, action="measure", parameters={"quantity": "pm10"}),
        apps.trip("B", 2.0, action="measure", parameters={"quantity": "pm10"}),
        apps.trip("C", 3.0),
        apps.trip("D", 3.0, action="of my own"),
    )
]


def test_each_drone_is_flown_as_the_fleet_file_says() -> None:
    """By its own navigation or the fleet's, with its options."""
    a, b = real_fleet(FLEET, MISSIONS).drones
    assert a == RealDrone(
        id="a",
        navigation="crazyflie",
        uri="radio://0/80/2M/E7E7E7E701",
        options={"measure": {"pm10": "sps.pm10"}},
    )
    assert b == RealDrone(id="b", navigation="tello:Tello", uri=None, options={"ports": [1, 2]})


def test_what_the_plan_asks_for_is_told_once() -> None:
    """Only what hardware must do: an action of the app's own is the app's affair."""
    assert real_fleet(FLEET, MISSIONS).wanted == (
        RequiredAction(action="measure", parameters={"quantity": "pm10"}),
        RequiredAction(action="take_photo", parameters={}),
    )


def test_what_goes_on_asks_for_the_same_as_when_it_began() -> None:
    """After a Stop a plan is in the journal; in another round all trips are flown once more."""
    app = apps.app(apps.flow())
    first, *rest = [trip_data(app, trip) for trip in MISSIONS[0].trips]
    goes_on = {"ended": False, "done": [first], "todo": rest}
    over = {"ended": True, "done": [{"action": "pick_item"}], "todo": []}
    going_on = real_fleet(FLEET, (), records=[over, goes_on])
    assert going_on == real_fleet(FLEET, MISSIONS)


def test_a_real_fleet_is_read_as_it_was_written() -> None:
    """All of it goes through a file."""
    whole = real_fleet(FLEET, MISSIONS)
    told = json.dumps(msgspec.to_builtins(whole, enc_hook=dict))
    assert msgspec.convert(json.loads(told), RealFleet) == whole


def test_stand_ins_are_crazyflies_under_any_class_in_the_file() -> None:
    """So many as were asked for, reached where they are."""
    one = as_stand_ins(FLEET, StandIns(CRTP, 1))
    assert [drone.id for drone in one.drones] == ["a"]
    both = real_fleet(
        as_stand_ins(FLEET, StandIns(CRTP, 2)), (), {"a": "udp://x:1", "b": "udp://x:2"}
    )
    assert [(drone.navigation, drone.uri) for drone in both.drones] == [
        ("crazyflie", "udp://x:1"),
        ("crazyflie", "udp://x:2"),
    ]
    assert both.drones[1].options == both.drones[0].options  # nothing that was for a Tello
    assert [drone.id for drone in as_stand_ins(FLEET, StandIns(CRTP, 3)).drones] == [
        "a",
        "b",
        "cf1",
    ]


def test_no_two_stand_ins_stand_at_one_place() -> None:
    """Where the map has no more room, none flies."""
    small = replace(FLEET, airspace=Airspace(size=(3.0, 3.0)))
    homes = [one.home for one in as_stand_ins(small, StandIns(CRTP, 12)).drones]
    assert min(dist(*pair) for pair in combinations(homes, 2)) >= 0.7
    with pytest.raises(BadInput, match="--crtp-sim 50: this map has room for"):
        as_stand_ins(small, StandIns(CRTP, 50))


@dataclass(frozen=True)
class Heard:
    """The last word of a drone."""

    location: Point
    battery_level: float
    landed: bool
    silence: float = 0.0


def test_of_a_drone_that_is_silent_in_the_air_people_are_warned(tmp_path: Path) -> None:
    """A simulated one does no harm."""
    scout = apps.app(apps.flow()).categories[0]
    one, two = (
        Drone(
            id=id, category=scout, home=(1.0, 1.0, 0.0), telemetry=Heard((2.0, 3.0, z), 1.0, z == 0)
        )
        for id, z in (("a", 0.0), ("b", 1.2))
    )
    real = FlightSetup(
        app=apps.app(apps.flow()),
        journal=tmp_path / "j",
        missions=(),
        fleet=FLEET,
        speed=1.0,
        seed=0,
        faults=Faults(),
        sim=False,
    )
    assert aloft(real, (one, two)) == [two]
    assert aloft(replace(real, sim=True), (one, two)) == []
    said = "no word of a landing from b (last heard of at (2, 3)): do not stand where"
    assert may_hover([two]).startswith(said)
