"""All drones come down at once, in the middle of anything, and keep apart."""

from __future__ import annotations

from math import dist, hypot

import pytest

from pluto_fleet.jobs.reports import Down, JobState
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.fleet.telemetry import resting
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.flights import Field, Task
from tests.library.simulation.flights import fly

APART = 0.5


def brought_down(field: Field, how: Down) -> None:
    """Ask the brain's own link to bring everything down, and wait until it is."""
    fly(field.kernel, field.link(9).bring_down(how))


def all_landed(field: Field) -> bool:
    return all(field.navigation.telemetry[drone.id].landed for drone in field.drones)


@pytest.mark.parametrize("apart", [APART, 0.0])
def test_landing_breaks_off_every_flight(apart: float) -> None:
    """Jobs whose action has not begun may be flown again; nothing is reported of them."""
    field, heard = Field(apart=apart), list[object]()
    link = field.link(1)
    link.fly(Task(), heard.append)
    field.kernel.spawn(link.goes("cf2", (2.0, 1.0, 1.2)), FLEET, "an errand")
    field.advance(3)
    brought_down(field, Down.LAND)
    assert (all_landed(field), heard) == (True, [])
    assert field.kernel.now == pytest.approx(6)  # up for three seconds, and down
    fleet_report = fly(field.kernel, field.link(10).fleet_report())
    assert fleet_report.jobs[Task().id].state is JobState.BROKEN_OFF


def test_the_link_is_not_heard_from_then_on_until_the_roll_is_called() -> None:
    """What a brain still says in the same breath would send drones up again."""
    field, heard = Field(), list[object]()
    link = field.link(1)
    link.fly(Task(), heard.append)
    field.advance(5)
    field.kernel.spawn(link.bring_down(Down.LAND), FLEET, "stop")
    field.advance(0)
    link.fly(Task(id="other", drone="cf2"), heard.append)
    field.advance(60)
    assert (all_landed(field), field.navigation.flown("cf2")) == (True, 0)
    fly(field.kernel, link.fleet_report())
    link.fly(Task(id="other", drone="cf2"), heard.append)
    field.advance(60)
    assert heard == [None]


def test_who_stands_elsewhere_goes_home_too_if_it_can() -> None:
    """With what it carries; one with too little in its battery, or crashed, stays where it is."""
    field = Field()
    link = field.link(1)
    for place, drone in enumerate(field.drones):
        stops = ((4.0 + place, 5.0, 1.2),)
        link.fly(Task(id=drone.id, drone=drone.id, stops=stops), lambda _: None)
        field.advance(20)
        fly(field.kernel, link.land(drone.id))
    low = field.navigation.bodies["cf2"]
    low.restore({**low.data, "charge": [0.03, field.kernel.now, 0.0]})
    field.navigation.strike("cf3", Failure.CRASH)
    brought_down(field, Down.HOME)
    at = [field.navigation.telemetry[drone.id].location for drone in field.drones]
    assert at == [pytest.approx((1, 1, 0)), pytest.approx((5, 5, 0)), pytest.approx((6, 5, 0))]
    assert field.navigation.carrying("cf1") is not None
    assert all_landed(field)


def test_landing_is_more_urgent_than_going_home() -> None:
    """Asked for while the drones fly home, it is done; the other way round, nothing changes."""
    field = Field()
    link = field.link(1)
    link.fly(Task(stops=((15, 10, 1.2),)), lambda _: None)
    field.advance(30)
    field.kernel.spawn(link.bring_down(Down.HOME), FLEET, "home")
    field.advance(1)
    field.kernel.spawn(link.bring_down(Down.LAND), FLEET, "land")
    field.kernel.spawn(link.bring_down(Down.HOME), FLEET, "home after all")
    field.advance(10)
    assert all_landed(field)
    assert field.navigation.telemetry["cf1"].location[0] > 5


def test_it_goes_on_without_the_brain() -> None:
    """Another brain waits for its end before it commands."""
    field = Field()
    link = field.link(1)
    link.fly(Task(), lambda _: None)
    field.advance(12)
    field.kernel.spawn(link.bring_down(Down.HOME), FLEET, "stop")
    field.advance(1)
    new = field.link(2)
    new.fly(Task(id="too early", drone="cf2"), lambda _: None)
    fleet_report = fly(field.kernel, new.fleet_report())
    assert all(report.landed for report in fleet_report.drones.values())
    assert list(fleet_report.jobs) == [Task().id]


def test_no_drone_lands_on_another_or_where_it_may_not() -> None:
    """Of two above one another the higher moves aside; one over a no-fly area leaves it."""
    field = Field(airspace=Airspace(no_fly=(((9, 9), (11, 9), (11, 11), (9, 11)),)))
    link = field.link(1)
    for drone, height in (("cf1", 1.2), ("cf2", 1.8), ("cf3", 2.4)):
        stops = ((5.0, 5.0, height),)
        link.fly(Task(id=drone, drone=drone, stops=stops, action=None), lambda _: None)
    field.advance(60)
    now = field.kernel.now
    field.navigation.bodies["cf3"].turn([resting((10, 10.4, 1), now)], now)
    brought_down(field, Down.LAND)
    at = [field.navigation.telemetry[drone.id].location for drone in field.drones]
    assert at[0] == (5, 5, 0)
    assert APART <= dist(at[0], at[1]) <= APART + 0.3
    assert field.airspace.problem(at[2]) is None
    assert hypot(at[2][0] - 10, at[2][1] - 10.4) < 1


def test_without_a_heartbeat_everything_lands_and_the_brain_is_cut_off() -> None:
    """Only when something flies; a brain that is heard of is left alone."""
    field, lost = Field(patience=3), list[str]()
    field.link(1, lambda: lost.append("idle"))
    field.advance(100)
    assert lost == []
    link = field.link(2, lambda: lost.append("silent"))
    field.advance(0)
    link.fly(Task(stops=((18, 18, 1.2),)), lambda _: None)
    for _ in range(10):
        field.advance(2)
        link.heartbeat()
    assert lost == ["idle"]
    assert not all_landed(field)
    field.advance(2.9)
    assert lost == ["idle"]
    field.advance(0.1)
    assert lost == ["idle", "silent"]
    field.advance(4)
    assert all_landed(field)


def test_a_gateway_that_no_brain_ever_finds_lands_everything_too() -> None:
    """It was started again after a crash, over drones that hover."""
    field = Field(patience=3)
    field.link(1).fly(Task(), lambda _: None)
    field.advance(2)
    field.gateway.crash()
    field.another()
    field.advance(10)
    assert all_landed(field)


def test_a_gateway_that_was_killed_lands_nothing() -> None:
    """Its drones hover until another takes over: what was to be looked at later is not done by a dead one."""
    field = Field(patience=3)
    field.link(1).fly(Task(), lambda _: None)
    field.advance(5)
    field.gateway.crash()
    field.advance(20)
    assert not field.navigation.telemetry["cf1"].landed
