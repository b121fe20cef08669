"""`least_makespan` plans ahead: the last trip ends soonest, and no drone or trip is given twice."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import AfterTrip, Category, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.shared.fleet.batch_optimal import batch_optimal
from pluto_fleet.shared.fleet.earliest_deadline import earliest_deadline
from pluto_fleet.shared.fleet.least_makespan import least_makespan
from pluto_fleet.shared.fleet.policies import Policy, nearest
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from tests.kit import apps

TIRED = Category(name="scout", flight_time=200.0, charge_time=400.0)


def drawn(number: int, most: int = 30) -> tuple[list[apps.Mission], tuple[Point, ...]]:
    chance = Random(f"least makespan/{number}")
    missions = [
        apps.mission(
            f"m{n}",
            *(
                apps.trip(str(k), chance.uniform(1, 15), chance.uniform(1, 15))
                for k in range(chance.choice((1, 1, 2)))
            ),
        )
        for n in range(chance.randint(1, most))
    ]
    homes = tuple((1.0 + 1.5 * n, 0.5, 0.0) for n in range(chance.randint(1, 6)))
    return missions, homes


def makespan(policy: Policy, number: int, after: AfterTrip) -> float:
    missions, homes = drawn(number)
    fleet = replace(apps.fleet(*homes, after=after), motion=CRAZYFLIE)
    outcome = apps.flown(*missions, on=fleet, policy=policy)
    assert outcome.completed
    return outcome.duration


def test_ten_plans_take_less_time_than_with_any_other_policy() -> None:
    """Each to its own luck: together."""
    took = {
        policy: sum(makespan(policy, number, AfterTrip.NEXT) for number in range(10))
        for policy in (nearest, batch_optimal, least_makespan)
    }
    assert took[least_makespan] < took[batch_optimal] < 0.9 * took[nearest]


@settings(max_examples=15)
@given(
    st.sampled_from((least_makespan, earliest_deadline)),
    st.integers(0, 10_000),
    st.sampled_from(AfterTrip),
    st.booleans(),
    st.sampled_from((None, 1, 2)),
    st.sampled_from((Faults(), Faults(crash=0.05, link=0.1, action=0.1))),
)
def test_every_plan_comes_to_its_end(
    policy: Policy, number: int, after: AfterTrip, tired: bool, most: int | None, faults: Faults
) -> None:
    """Whatever befalls its drones: none waits for one that does not come, and the same is flown each time."""

    def flown() -> apps.SimulationResult:
        missions, homes = drawn(number, 15)
        kinds = (TIRED,) if tired else (apps.SCOUT,)
        app = apps.app(apps.flow(policy=policy, attempts=3), categories=kinds)
        fleet = apps.fleet(*homes, after=after, max_airborne=most)
        return apps.fly(app, *missions, on=fleet, faults=faults, seed=number)

    outcome = flown()
    assert all(mission.status.name in ("COMPLETED", "FAILED") for mission in outcome.missions)
    assert faults != Faults() or outcome.completed
    assert outcome.events == flown().events


@pytest.mark.parametrize("count", range(2, 7))
@pytest.mark.parametrize("away", [4.0, 9.0, 14.0])
def test_no_drone_flies_two_trips_while_another_could_have_flown_one_sooner(
    count: int, away: float
) -> None:
    """Trips at one spot, and as many drones side by side: each has one, be it near or far."""
    homes = tuple((0.5 + n, 0.5, 0.0) for n in range(count))
    missions = [apps.mission(f"m{n}", apps.trip("A", 3.0, away)) for n in range(count)]
    app = apps.app(apps.flow(policy=least_makespan))
    fleet = replace(apps.fleet(*homes, after=AfterTrip.NEXT), motion=CRAZYFLIE)
    given = apps.events(apps.fly(app, *missions, on=fleet), "trip.allocated")
    assert len({e["drone"] for e in given}) == count


def test_of_very_many_those_that_came_first_are_planned(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three at a time."""
    monkeypatch.setattr("pluto_fleet.shared.fleet.least_makespan.MOST", 3)
    missions = [apps.mission(f"m{n}", apps.trip("A", 2.0 + n)) for n in (5, 3, 1, 4, 2)]
    app = apps.app(apps.flow(policy=least_makespan))
    outcome = apps.fly(app, *missions, on=apps.fleet(after=AfterTrip.NEXT))
    order = [str(e["mission"]) for e in apps.events(outcome, "trip.allocated")]
    assert order == ["m1", "m3", "m2", "m4", "m5"]


def test_a_drone_that_is_busy_for_long_keeps_no_trip_waiting() -> None:
    """It is near, and late, and nobody knows for how long: the other flies."""

    async def slow(drone: object, trip: object, context: Context) -> None:
        await context.sleep(500.0)

    act = OwnAction(name="dig", hook=slow)
    app = apps.app(apps.flow(policy=least_makespan), actions=(act,))
    missions = [
        apps.mission("slow", apps.trip("A", 15.0, action="dig")),
        apps.mission("other", apps.trip("A", 15.5)),
        apps.mission("third", apps.trip("A", 16.0)),
    ]
    homes = (14.0, 0.5, 0.0), (0.5, 0.5, 0.0)
    outcome = apps.fly(app, *missions, on=apps.fleet(*homes, after=AfterTrip.NEXT))
    ends = {str(e["mission"]): float(str(e["t"])) for e in apps.events(outcome, "mission.ended")}
    assert ends["other"] < 300.0
    assert ends["third"] < 300.0


def test_no_trip_waits_for_a_drone_that_flies_home_where_another_is_free() -> None:
    """It has flown when it was to; but as nothing waited then, it is on its way home."""
    far, later = apps.mission("far", apps.trip("A", 15.0)), apps.trip("B", 14.0)
    later.delay = 40.0
    outcome = apps.flown(
        far,
        apps.mission("later", later),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), after=AfterTrip.NEXT),
        policy=least_makespan,
        clock=True,
    )
    assert apps.times(outcome, "trip.completed")[0] < 40.0
    assert apps.times(outcome, "trip.launched") == [0.0, 40.0]
