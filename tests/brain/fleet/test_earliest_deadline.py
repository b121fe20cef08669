"""`earliest_deadline`: who is due first goes first, unless that is too late already.

A trip waits for a drone in the air that will be there sooner than any free one, and for none for ever.
"""

from __future__ import annotations

from collections.abc import Coroutine, Sequence
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.errors import Failure
from pluto_fleet.shared.domain.keeper import put
from pluto_fleet.shared.domain.model import AfterTrip, Category, Point
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.fleet.earliest_deadline import earliest_deadline
from pluto_fleet.shared.flow.run import Run
from tests.deadlines import SHARE, TIRELESS, missed
from tests.kit import apps
from tests.kit.living import Living, enterable

NEAR, FAR = (14.0, 0.5, 0.0), (0.5, 0.5, 0.0)
OUT = [AfterTrip.STAY, AfterTrip.NEXT]


def order(
    deadlines: dict[str, float | None],
    priorities: dict[str, int] | None = None,
    sources: dict[str, Point] | None = None,
) -> list[tuple[str, str]]:
    """Return the order in which one drone flies missions, and why."""
    inner = apps.flow(policy=earliest_deadline)

    def flow(run: Run[apps.Mission]) -> Coroutine[Any, Any, Status]:
        put(run.mission, deadline=deadlines[run.mission.name])
        return inner(run)

    missions = [
        apps.mission(name, apps.trip("A", 3.0, priority=(priorities or {}).get(name, 0)))
        for name in deadlines
    ]
    for mission in missions:
        mission.trips[0].source = (sources or {}).get(mission.name)
    outcome = apps.fly(apps.app(flow), *missions)
    return [
        (str(e["mission"]), str(e["why"]).partition(";")[0])
        for e in apps.events(outcome, "trip.allocated")
    ]


def test_the_earliest_goes_first_and_one_without_goes_last() -> None:
    flown = order({"a": None, "b": 900.0, "c": 300.0, "d": 600.0})
    assert [name for name, _ in flown] == ["c", "d", "b", "a"]
    assert flown[0][1] == "due in 300 s"
    assert flown[3][1] == "no deadline"


def test_a_higher_priority_comes_before_any_deadline() -> None:
    assert [name for name, _ in order({"a": 100.0, "b": None}, {"b": 1})] == ["b", "a"]


def test_what_is_too_late_already_keeps_none_waiting_that_can_be_in_time() -> None:
    assert [name for name, _ in order({"a": 5.0, "b": None, "c": 60.0})] == ["c", "a", "b"]


def test_the_way_from_a_source_to_its_target_takes_its_time() -> None:
    """It is 37 s to the source, and 33 s from there."""
    deadlines: dict[str, float | None] = {"a": 60.0, "b": 300.0}
    far = {"a": (19.0, 0.5, 1.2)}
    assert [name for name, _ in order(deadlines, sources=far)] == ["b", "a"]
    assert [name for name, _ in order(deadlines | {"a": 90.0}, sources=far)] == ["a", "b"]


def test_it_misses_no_more_than_nearest_in_nearly_all_plans() -> None:
    """A share of the campaign."""
    found = [missed(number) for number in range(8)]
    assert sum(after <= before for before, after in found) >= SHARE * len(found)
    assert sum(after for _, after in found) < 0.75 * sum(before for before, _ in found)


def neighbours() -> Sequence[apps.Mission]:
    """Return two missions beside each other: one drone is near, the other far away."""
    return [apps.mission(f"m{n}", apps.trip("A", 15.0 + n)) for n in range(2)]


def launched(events: Sequence[Event]) -> list[tuple[str, str, float]]:
    """Return the missions of all flights, their drones, and when each set out."""
    return [
        (str(e["mission"]), str(e["drone"]), float(str(e["t"])))
        for e in events
        if e["event"] == "trip.launched"
    ]


@pytest.mark.parametrize("after", OUT)
@pytest.mark.parametrize("away", [2.0, 8.0])
def test_trips_of_a_mission_beside_each_other_stay_with_one_drone(
    after: AfterTrip, away: float
) -> None:
    """It is on its way down when the mission asks for the next; others wait at home."""
    row = apps.mission("row", *(apps.trip(str(n), away + 1.6 * n, 6.0) for n in range(6)))
    homes = [(1.0 + n, 0.5, 0.0) for n in range(4)]
    app = apps.app(apps.flow(policy=earliest_deadline), categories=(TIRELESS,))
    outcome = apps.fly(app, row, on=apps.fleet(*homes, after=after))
    assert len({drone for _, drone, _ in launched(outcome.events)}) == 1


def test_a_drone_on_its_way_home_is_not_waited_for() -> None:
    """With `home` none is free where a trip has ended: the next one goes at once."""
    row = apps.mission("row", *(apps.trip(str(n), 8.0 + n) for n in range(2)))
    app = apps.app(apps.flow(policy=earliest_deadline))
    flown = launched(apps.fly(app, row, on=apps.fleet(FAR, FAR)).events)
    assert [drone for _, drone, _ in flown] == ["cf1", "cf2"]


@pytest.mark.parametrize(
    ("homes", "away", "trips", "reserve", "other"),
    [
        pytest.param((FAR, FAR), 14.0, 2, 0.3, 1, id="for the trip"),
        pytest.param((FAR, (5.0, 0.5, 0.0)), 2.0, 8, 0.2, 7, id="and goes home to charge"),
    ],
)
def test_nor_is_one_that_will_be_too_low(
    homes: tuple[Point, Point], away: float, trips: int, reserve: float, other: int
) -> None:
    """The other flies at once, not when the first has landed."""
    kind = Category(name="scout", flight_time=100.0, reserve=reserve)
    app = apps.app(apps.flow(policy=earliest_deadline), categories=(kind,))
    row = apps.mission("row", *(apps.trip(str(n), away + 0.1 * n) for n in range(trips)))
    outcome = apps.fly(app, row, on=apps.fleet(*homes, after=AfterTrip.NEXT))
    flown = launched(outcome.events)
    assert [drone for _, drone, _ in flown] == ["cf1"] * other + ["cf2"]
    assert flown[other][2] == apps.times(outcome, "trip.completed")[other - 1]


def test_who_waits_for_a_limited_time_takes_what_is_free() -> None:
    def drones(within: float | None) -> list[str]:
        app = apps.app(apps.flow(policy=earliest_deadline, within=within))
        on = apps.fleet(NEAR, FAR, after=AfterTrip.NEXT)
        return [drone for _, drone, _ in launched(apps.fly(app, *neighbours(), on=on).events)]

    assert drones(None) == ["cf1", "cf1"]
    assert drones(600.0) == ["cf1", "cf2"]


def test_a_drone_that_is_lost_keeps_no_trip_waiting() -> None:
    """The other flies as soon as that is known."""
    app = enterable(policy=earliest_deadline, attempts=3)
    flight = Living(app, *neighbours(), on=apps.fleet(NEAR, FAR, after=AfterTrip.NEXT))
    flight.at(3.0, lambda: flight.navigation.strike("cf1", Failure.CRASH))
    assert flight.run() == ["COMPLETED"] * 2
    flown = launched(flight.events)
    assert flown[0] == ("m0", "cf1", 0.0)
    assert [drone for _, drone, _ in flown[1:]] == ["cf2"] * 2
    assert flown[1][2] == flight.times("drone.lost")[0]


@settings(max_examples=10)
@given(st.floats(0.0, 40.0), st.sampled_from(OUT))
def test_who_waits_when_the_brain_dies_is_served_by_the_next(when: float, after: AfterTrip) -> None:
    """It does not know for which drone a trip has waited; the same is done."""
    on = apps.fleet(NEAR, FAR, after=after)
    flight = Living(enterable(policy=earliest_deadline), *neighbours(), on=on)
    flight.crash(when)
    assert flight.run(1_000.0) == ["COMPLETED"] * 2
    assert len(flight.done_by_drones) == 2
