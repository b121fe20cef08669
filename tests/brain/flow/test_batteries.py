"""What an action of one's own takes of a battery: reckoned with before, and watched while it runs."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.report.report import report, simulation_data
from pluto_fleet.report.sentences import sentence_of
from pluto_fleet.shared.domain.actions import Parameter
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import Category, Drone
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.reach import problems, reckoned
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.shared.time.told import Stuck
from tests.batteries import Judged, judged
from tests.kit import apps
from tests.kit.living import Living

SCOUT = Category(name="scout", payload=0.01, flight_time=240.0, reserve=0.2)


def looking(seconds: float, takes: float | str | None = None) -> OwnAction:
    """Return an action whose hook takes so many seconds."""

    async def look(drone: Drone, trip: apps.Trip, context: Context, **_: object) -> None:
        await context.sleep(seconds)

    span = Parameter(name="span", type=Type.TIME, default=150.0)
    return OwnAction(name="look", hook=look, takes=takes, parameters=(span,))


def app(action: OwnAction) -> App:
    return apps.app(apps.flow(attempts=1), categories=(SCOUT,), actions=[action])


@pytest.mark.parametrize("minutes", [3.0, 3.5, 5.0])
def test_an_action_is_cancelled_when_the_battery_only_just_suffices(minutes: float) -> None:
    outcome = apps.fly(
        app(looking(60 * minutes)), apps.mission("m", apps.trip("A", 6.0, action="look"))
    )
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason.startswith("look failed: battery: ")
    assert (outcome.crashed, apps.events(outcome, "drone.lost")) == (0, [])
    landed, *_ = outcome.standing["drones"].values()
    assert landed["status"] in ("FREE", "CHARGING")


def test_what_it_is_said_to_take_is_reckoned_with_and_it_completes_with_its_reserve() -> None:
    outcome = apps.fly(
        app(looking(150.0, 150.0)), apps.mission("m", apps.trip("A", 6.0, action="look"))
    )
    assert outcome.completed


@pytest.mark.parametrize("takes", [200.0, "span"])
def test_a_trip_whose_action_takes_too_long_is_refused_before_anything_flies(
    takes: float | str,
) -> None:
    action = looking(1.0, takes)
    trip = apps.trip("A", 6.0, action="look")
    trip.parameters = {"span": 200.0}
    mission = apps.mission("m", trip)
    (problem,) = problems(app(action), [mission], apps.fleet(), forever=False)
    assert "no drone of the fleet can do it: scout would need" in problem


def test_a_time_of_the_trip_counts_and_else_its_default() -> None:
    action = looking(1.0, "span")
    assert [action.lasts(given) for given in ({}, {"span": 20.0}, {"span": -3.0})] == [150, 20, 0]
    assert action.seconds == looking(1.0).lasts({}) == 5.0


def test_what_nobody_has_said_is_told() -> None:
    mission = apps.mission("m", apps.trip("A", 6.0, action="look"))
    assert reckoned(app(looking(1.0, 9.0)), [mission]) == []
    (told,) = reckoned(app(looking(1.0)), [mission])
    assert told.startswith("look is reckoned with 5 s")


def test_a_reserve_that_was_broken_is_told() -> None:
    """Drones are slower than they are reckoned with: such is chance, and so is traffic."""
    on = replace(apps.fleet(), motion=replace(CRAZYFLIE, spread=0.2))
    slow = moving(app(looking(96.0, 96.0)), on.motion)
    told = []
    for seed in range(10):
        trip = apps.trip("A", 9.0, 3.0, action="look")
        flown = apps.fly(slow, apps.mission("m", trip), on=on, seed=seed)
        told += apps.events(flown, "drone.drained")
    assert told
    for event in told:
        level = event["level"]
        assert isinstance(level, float)
        assert level < SCOUT.reserve
        assert "less than its reserve" in (sentence_of(event) or "")


@pytest.mark.parametrize("number", [5, 12, 15])
def test_nothing_falls_with_actions_that_take_long(number: int) -> None:
    """More by `python -m tests.batteries`."""
    assert judged(number) == Judged("kept")


SEED = 4
"""Of a flight on which one of three trips takes more of the battery than its reserve leaves."""


def varied() -> tuple[App, FleetFile]:
    """Return an app and its fleet, whose drones are slower or faster than they are reckoned with."""
    on = replace(apps.fleet(), motion=replace(CRAZYFLIE, spread=0.3))
    enters = apps.changed(app(looking(100.0, 100.0)), resumes=("allocate",))
    return moving(enters, on.motion), on


def until_drained(*crashes: float, retired: float | None = None) -> Living:
    """Fly three such trips; the app may crash, and its drone be retired meanwhile."""
    slow, on = varied()
    trips = [apps.trip(name, 6.0, 3.0, action="look") for name in "ABC"]
    living = Living(slow, apps.mission("m", *trips), on=on, seed=SEED)
    if retired is not None:
        living.at(retired, lambda: living.life.control.retire("cf1"))
    for when in crashes:
        living.crash(when)
    with suppress(Stuck):  # what a retired drone had to do is done by none
        living.run()
    return living


def test_a_broken_reserve_is_told_once_also_of_a_retired_drone_and_when_the_app_resumes() -> None:
    """It still charges then, below its reserve, and has come home long ago."""
    (home,) = until_drained().times("drone.drained")
    assert until_drained(home + 3.0, home + 8.0).times("drone.drained") == [home]
    assert until_drained(retired=home - 30.0).times("drone.drained") == [home]


def test_a_broken_reserve_stands_in_the_report_and_in_the_data_of_a_simulation() -> None:
    slow, on = varied()
    trips = [apps.trip(name, 6.0, 3.0, action="look") for name in "ABC"]
    flown = apps.fly(slow, apps.mission("m", *trips), on=on, seed=SEED)
    assert any("less than its reserve" in line for line in report(slow, flown, on))
    assert simulation_data("tested", 0, flown)["drained"] == ["cf1"]
