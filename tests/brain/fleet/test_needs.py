"""Which requests a drone suffices for: found without a look at all, and the same as with one."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.flight.driver import Driver
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import AfterTrip, Category, Drone, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STRAIGHT, Motion
from pluto_fleet.shared.fleet.needs import Needs, Request
from pluto_fleet.shared.fleet.policies import Policy, first, least_used, nearest
from pluto_fleet.shared.fleet.queue import Queue
from pluto_fleet.shared.fleet.reach import Reach
from pluto_fleet.shared.fleet.telemetry import KnownState, resting
from pluto_fleet.shared.time.virtual import VirtualTime
from tests.kit import apps

PLAIN = Airspace(size=(30.0, 30.0))
WALLED = Airspace(size=(30.0, 30.0), no_fly=(((8, 5), (9, 5), (9, 25), (8, 25)),))

coordinate = st.floats(0, 30)
goals = st.tuples(coordinate, coordinate, st.floats(0, 10))
docks = st.tuples(coordinate, coordinate, st.just(0.0))


class Standing(KnownState):
    """A drone that stands somewhere, with a full battery."""

    def __init__(self, place: Point, motion: Motion) -> None:
        class Clock:
            now = 0.0

        super().__init__(Clock(), place, motion)
        self._legs = [resting(place, 0.0)]


def drone(kind: Category, home: Point, place: Point) -> Drone:
    return Drone(id="cf1", category=kind, home=home, telemetry=Standing(place, kind.motion))


def requests(
    motion: Motion, space: Airspace, places: list[Point]
) -> tuple[Category, list[Request]]:
    app = apps.app(apps.flow(), categories=(Category(name="scout", motion=motion),))
    reach = Reach(app, space)
    return app.categories[0], [
        Request(reach, apps.mission(f"m{n}", trip), first, (0, -n))
        for n, trip in enumerate(
            apps.Trip(name="1", action="take_photo", target=place) for place in places
        )
    ]


@settings(max_examples=100, deadline=None)
@given(
    st.sampled_from((STRAIGHT, CRAZYFLIE)),
    st.sampled_from((PLAIN, WALLED)),
    st.lists(goals, min_size=1, max_size=12),
    docks,
    docks,
    st.sets(st.integers(0, 11)),
    st.floats(0.2, 1.0),
)
def test_those_that_a_level_suffices_for_are_found_without_all(
    motion: Motion,
    space: Airspace,
    places: list[Point],
    home: Point,
    here: Point,
    gone: set[int],
    level: float,
) -> None:
    """Whatever has been asked before, and whichever have got a drone since."""
    kind, asked = requests(motion, space, places)
    one = drone(kind, home, here)
    assert all(request.at_least(one, here) <= request.level(one) for request in asked)
    arrived = asked[: len(asked) // 2]
    needs = Needs(one, arrived)
    needs.least(level)
    arrived += asked[len(asked) // 2 :]
    for number in gone & set(range(len(asked))):
        asked[number].is_set = True
    left = [request for request in asked if not request.is_set]
    assert set(needs.up_to(level, 100)) == {
        request for request in left if request.level(one) <= level
    }
    assert needs.least() == min((request.level(one) for request in left), default=float("inf"))


def plan(count: int) -> list[apps.Mission]:
    chance = Random(3)
    return [
        apps.mission(
            f"m{n}",
            *(
                apps.trip(str(k), chance.uniform(1, 19), chance.uniform(1, 19), priority=n % 3)
                for k in range(2)
            ),
        )
        for n in range(count)
    ]


HOMES = tuple((2.0 + 3 * n, 10.0, 0.0) for n in range(5))
WEAK = Category(name="scout", flight_time=200.0, charge_time=400.0)


def of_all(self: Queue) -> Iterator[int]:
    """Look at all that wait, in turn."""
    yield from range(len(self.requests) - 1, -1, -1)


@pytest.mark.parametrize("after", list(AfterTrip))
@pytest.mark.parametrize("policy", [nearest, least_used, first])
def test_a_look_at_few_chooses_as_one_at_all_does(
    policy: Policy, after: AfterTrip, monkeypatch: pytest.MonkeyPatch
) -> None:
    def flown() -> Any:
        app = apps.app(apps.flow(policy=policy, attempts=3), categories=(WEAK,))
        return apps.fly(app, *plan(40), on=apps.fleet(*HOMES, after=after)).events

    few = flown()
    monkeypatch.setattr(Queue, "_places", of_all)
    assert few == flown()
    assert sum(event["event"] == "trip.completed" for event in few) == 80


def test_few_are_looked_at_however_many_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    """A look at all would be 150 bounds a trip."""
    asked = 0
    at_least = Request.at_least

    def counted(self: Request, drone: Drone, here: Point) -> float:
        nonlocal asked
        asked += 1
        return at_least(self, drone, here)

    monkeypatch.setattr(Request, "at_least", counted)
    app = apps.app(apps.flow(), categories=(WEAK,))
    outcome = apps.fly(app, *plan(150), on=apps.fleet(*HOMES))
    assert outcome.completed
    assert asked < 20 * 300


def test_a_brain_is_called_a_few_times_a_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each call is due for a reason; none leaves another behind."""
    calls = 0
    advance = Brain.advance

    def counted(self: Brain, now: float) -> None:
        nonlocal calls
        calls += 1
        advance(self, now)

    monkeypatch.setattr(Brain, "advance", counted)
    app = apps.app(apps.flow(), categories=(WEAK,))
    outcome = apps.fly(app, *plan(20), on=apps.fleet(*HOMES, apart=0.5))
    assert outcome.completed
    assert calls < 4 * 40


def test_a_driver_forgets_a_call_that_is_not_due_any_more() -> None:
    """It schedules one call of its brain, however often that says when it is due."""

    class Due:
        over = None
        due: float | None = None

        def __init__(self) -> None:
            self.advanced: list[float] = []

        def events(self) -> list[Any]:
            return []

        orders = events

        def advance(self, now: float) -> None:
            self.advanced.append(now)
            self.due = None

    brain, kernel = Due(), VirtualTime()
    driver = Driver(kernel, brain, obey=print, motions=dict, hear=print)  # type: ignore[arg-type]
    for due in (5.0, 3.0, 7.0, 7.0):
        brain.due = due
        driver.pump()
    assert kernel.next_time() == 7.0
    kernel.now = 7.0
    kernel.drain()
    assert brain.advanced == [7.0]
    assert kernel.next_time() is None
