"""Drones that are lost, not ready or slow to charge: who waits for them, and how they come back."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.gateway.executor import Executor
from pluto_fleet.jobs.reports import DroneReport
from pluto_fleet.journal.standing import Standing
from pluto_fleet.report.sentences import line_of
from pluto_fleet.shared.domain.errors import BadInput, Failure
from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.domain.status import DroneStatus
from pluto_fleet.shared.time.kernel import FLEET, Future
from tests.kit import apps
from tests.kit.living import Living, enterable, names
from tests.library.journal.memory import Memory

HOMES = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))


def living(*names: str, homes: int = 2, attempts: int = 5) -> Living:
    """Return a fleet with a trip for each of these missions; what failed is flown again."""
    missions = [apps.mission(name, apps.trip("1", 4.0)) for name in names]
    return Living(enterable(attempts=attempts), *missions, on=apps.fleet(*HOMES[:homes]))


def drone(living: Living, id: str = "cf1") -> Drone:
    return next(one for one in living.life.drones if one.id == id)


def records(living: Living) -> Standing:
    return living.life.recorder.standing


def flights_of(living: Living, id: str) -> list[float]:
    flights = [event for event in living.named("trip.launched") if event["drone"] == id]
    return [float(str(event["t"])) for event in flights]


def passes(living: Living, until: float) -> None:
    kernel = living.kernel
    kernel.run(kernel.spawn(kernel.sleep(until - kernel.now), FLEET, "time passes"))


def crashes(living: Living, when: float) -> None:
    living.at(when, lambda: living.navigation.strike("cf1", Failure.CRASH))


def test_a_lost_drone_flies_again_when_a_person_has_looked_after_it() -> None:
    """It is RECOVERING until it says that it is well; before, no mission gets it."""
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


def test_a_lost_drone_stays_lost_in_the_next_life_though_it_calls_itself_well() -> None:
    """The app dies; the drone is put home and is well, but no person has said that they saw to it."""
    fleet = living(*"abcdefgh")
    crashes(fleet, 5.0)
    fleet.at(19.0, lambda: fleet.navigation.mended("cf1"))
    fleet.crash(20.0)
    seen: list[Any] = []
    fleet.at(60.0, lambda: seen.append((drone(fleet).status, records(fleet).lost["cf1"]["at"])))
    fleet.at(60.0, lambda: seen.append(fleet.life.brain.drones()["cf1"]["unready"]))
    fleet.at(61.0, lambda: fleet.life.control.bring_back("cf1"))
    assert fleet.run() == ["COMPLETED"] * 8
    (status, at), why = seen
    assert status is DroneStatus.LOST
    assert why == f"cf1 crashed at ({at[0]:g}, {at[1]:g})"
    assert not [time for time in flights_of(fleet, "cf1") if 5.0 < time < 61.0]
    assert flights_of(fleet, "cf1")[-1] > 61.0
    assert records(fleet).lost == {}


def test_where_every_drone_is_lost_nothing_begins() -> None:
    """It says who, why, and what to do."""
    fleet = living("a", homes=1)
    fleet.die()
    lost = {"cf1": {"reason": "cf1 crashed at (1, 2)", "at": [1.0, 2.0, 0.0]}}
    fleet.memory = Memory({"t": 0.0, "event": "journal.begun", "lost": lost})
    fleet.live_on()
    passes(fleet, 10.0)
    assert fleet.life.control.whole is not None
    with pytest.raises(BadInput, match="cf1: it is lost, and was not brought back"):
        fleet.life.control.whole.result()


def test_who_is_not_ready_is_named_and_in_the_end_not_waited_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The others fly; what a drone says of itself commands no terminal, and is not endless."""

    async def drone_report(self: Executor, drone: str) -> DroneReport:
        report = fleet.navigation.bodies[drone].report
        problems = ("its battery has 3.4 V", "\x1b[31m" + "x" * 1000) if drone == "cf1" else ()
        return replace(report, problems=problems)

    async def fetched(drone: str) -> bool:
        await Future[None]()
        return False

    monkeypatch.setattr(Executor, "drone_report", drone_report)
    fleet = living(*"ab")
    vars(fleet.gateway.executor).update(recover=fetched)
    fleet.life.carried_home = False
    assert fleet.run() == ["COMPLETED"] * 2
    assert names(fleet.named("trip.launched"), "drone") == ["cf2", "cf2"]
    assert drone(fleet).status is DroneStatus.RECOVERING
    assert "cf1 stands at (0.5, 0.5) and needs a person: go and look" in names(
        fleet.named("log"), "text"
    )
    (event,) = fleet.named("drone.not_ready")
    line = str(line_of(event))
    assert "cf1 is not ready: its battery has 3.4 V; \\x1b[31mxxx" in line
    assert line.endswith("x…")
    assert len(line) < 600
