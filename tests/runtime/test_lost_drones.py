"""Drones that are lost, not ready or slow to charge: who waits for them, and how they come back."""

from __future__ import annotations

from dataclasses import replace

import pytest

from plutoc_runtime.cli.events import line_of
from plutoc_runtime.errors import Failure
from plutoc_runtime.gateway.pilots import Pilots
from plutoc_runtime.kernel import FLEET
from plutoc_runtime.model import Drone
from plutoc_runtime.signals import Signal
from plutoc_runtime.standing import Standing
from plutoc_runtime.status import DroneStatus
from tests.runtime import apps
from tests.runtime.living import Living, enterable, names

HOMES = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))


def living(*names: str, homes: int = 2, attempts: int = 5) -> Living:
    """Return a fleet with a trip for each of these missions; what failed is flown again."""
    missions = [apps.mission(name, apps.trip("1", 4.0)) for name in names]
    return Living(enterable(attempts=attempts), *missions, on=apps.fleet(*HOMES[:homes]))


def drone(living: Living, id: str = "cf1") -> Drone:
    """Return a drone as the latest life sees it."""
    return next(one for one in living.life.session.drones if one.id == id)


def passes(living: Living, until: float) -> None:
    """Let time pass until then."""
    kernel = living.kernel
    kernel.run(kernel.spawn(kernel.sleep(until - kernel.now), FLEET, "time passes"))


def crashes(living: Living, when: float) -> None:
    """Let cf1 crash at a time."""
    living.at(when, lambda: living.navigation.strike("cf1", Failure.CRASH))


def test_a_lost_drone_flies_again_when_somebody_has_looked_after_it() -> None:
    """It is RECOVERING until it says that it is well; before, nobody gets it."""
    fleet = living(*"abcdefgh")
    said: list[object] = []
    crashes(fleet, 5.0)
    fleet.at(30.0, lambda: said.append(drone(fleet).status))
    fleet.at(40.0, lambda: said.append(fleet.life.control.bring_back("cf1")))
    assert fleet.run() == ["COMPLETED"] * 8
    assert said == [DroneStatus.LOST, "cf1 is asked whether it is well"]
    assert fleet.times("drone.recovering")[-1] == 40.0
    flights = [event for event in fleet.named("trip.launched") if event["drone"] == "cf1"]
    times = [float(str(event["t"])) for event in flights]
    assert len(times) > 1
    assert not [time for time in times if 5.0 < time < 40.0]
    (back,) = fleet.named("drone.brought_back")
    assert "cf1 was lost, and a person has looked after it" in str(line_of(back))


def test_one_that_is_as_lost_as_before_stays_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody had looked after it: it is asked, and it is LOST again, with the reason."""

    async def roll_call(drone: str) -> Standing:
        return replace(fleet.navigation.bodies[drone].standing, problems=("it lies on its back",))

    fleet = living(*"ab")
    monkeypatch.setattr(fleet.navigation, "mended", lambda _: None)
    fleet.at(20.0, lambda: vars(fleet.navigation).update(roll_call=roll_call))
    crashes(fleet, 5.0)
    fleet.at(40.0, lambda: fleet.life.control.bring_back("cf1"))
    assert fleet.run() == ["COMPLETED"] * 2
    assert drone(fleet).status is DroneStatus.LOST
    assert len(fleet.named("drone.lost")) == 2
    (event,) = fleet.named("drone.not_ready")
    assert event["reason"] == "it lies on its back"


def test_what_a_person_has_said_of_a_lost_drone_outlives_the_app() -> None:
    """The app dies before its gateway has heard of it: the next life says so again."""
    fleet = living(*"abc")
    heard: list[str] = []

    async def never(_: str) -> bool:
        await Signal[None]()
        return False

    navigation = fleet.gateway.navigation
    crashes(fleet, 5.0)
    fleet.at(14.0, lambda: vars(navigation).update(mended=heard.append, recover=never))
    fleet.at(15.0, lambda: fleet.life.control.bring_back("cf1"))
    fleet.at(15.5, lambda: [vars(navigation).pop(name) for name in ("mended", "recover")])
    fleet.crash(16.0)
    fleet.run()
    assert heard == ["cf1"]
    assert drone(fleet).status is DroneStatus.FREE
    assert fleet.life.recorder.records.mended == []


def test_a_drone_that_is_neither_retired_nor_lost_need_not_be_brought_back() -> None:
    """Nothing is on record of that."""
    fleet = living("a")
    fleet.run(2.0)
    assert fleet.life.control.bring_back("cf1") == "cf1 is neither retired nor lost"
    assert not fleet.named("drone.brought_back")


def test_a_battery_that_charges_slowly_is_waited_for() -> None:
    """A category's charging time is what is expected; what counts is the battery."""
    fleet = living("a", homes=1)
    body = fleet.navigation.bodies["cf1"]
    slow = replace(body.drone.category, flight_time=21.0, charge_time=12_000.0)
    body.drone = replace(body.drone, category=slow)
    assert fleet.run() == ["COMPLETED"]
    (low,) = fleet.named("drone.charging")
    missing = 0.2 - float(str(low["battery"]))
    assert missing > 0
    passes(fleet, float(str(low["t"])) + missing * 12_000 - 1)
    assert drone(fleet).status is DroneStatus.CHARGING
    passes(fleet, fleet.kernel.now + 12)
    assert drone(fleet).status is DroneStatus.FREE


def test_who_is_not_ready_is_named_and_nobody_waits_for_it_in_the_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The others fly; what a drone says of itself commands no terminal, and is not endless."""

    async def roll_call(self: Pilots, drone: str) -> Standing:
        standing = fleet.navigation.bodies[drone].standing
        problems = ("its battery has 3.4 V", "\x1b[31m" + "x" * 1000) if drone == "cf1" else ()
        return replace(standing, problems=problems)

    async def fetched(drone: str) -> bool:
        await Signal[None]()
        return False

    monkeypatch.setattr(Pilots, "roll_call", roll_call)
    fleet = living(*"ab")
    vars(fleet.gateway.navigation).update(recover=fetched)
    fleet.life.session.core.fleet.somebody_comes = False
    assert fleet.run() == ["COMPLETED"] * 2
    assert names(fleet.named("trip.launched"), "drone") == ["cf2", "cf2"]
    assert drone(fleet).status is DroneStatus.RECOVERING
    assert "cf1 stands at (0.5, 0.5) and needs somebody: go and look" in names(
        fleet.named("log"), "text"
    )
    (event,) = fleet.named("drone.not_ready")
    line = str(line_of(event))
    assert "cf1 is not ready: its battery has 3.4 V; \\x1b[31mxxx" in line
    assert line.endswith("x…")
    assert len(line) < 600


def test_who_flies_home_after_a_failure_is_waited_for() -> None:
    """It needs nobody."""
    fleet = living("a", homes=1)
    fleet.life.session.core.fleet.somebody_comes = False
    fleet.at(8.0, lambda: fleet.life.control.cancel("a"))
    assert fleet.run() == ["CANCELLED"]
    assert names(fleet.named("drone.recovering"), "drone") == ["cf1"]
    assert drone(fleet).status is DroneStatus.FREE
