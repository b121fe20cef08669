"""No trip waits for ever, however many new ones are nearer: after `OLD` seconds it goes before all younger ones.

The bound: from then on only those that have waited longer come before it, and they are no more than waited when it
came. Each of them takes one drone's flight, its way home and one charge at most, and so does it.
"""

from __future__ import annotations

from collections.abc import Coroutine
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.keeper import put
from pluto_fleet.shared.domain.model import AfterTrip, Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet import batch
from pluto_fleet.shared.fleet.batch_optimal import batch_optimal
from pluto_fleet.shared.fleet.earliest_deadline import earliest_deadline
from pluto_fleet.shared.fleet.least_makespan import least_makespan
from pluto_fleet.shared.fleet.policies import Policy
from pluto_fleet.shared.flow.run import Run
from tests.kit import apps

POLICIES = [batch_optimal, least_makespan, earliest_deadline]
HALF_AN_HOUR, OLD = batch.OLD, 250.0
"""What is old, and what is in these tests, so that few trips are a crowd."""
NEAR = 70
LONGEST = 150.0
"""Seconds of the longest flight there, with landing and the way home, in a field of 18 metres."""
TIRED = Category(name="scout", flight_time=300.0, charge_time=200.0)
TIRELESS = Category(name="scout", flight_time=100_000.0)


@pytest.fixture(autouse=True, scope="module")
def _soon_old() -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(batch, "OLD", OLD)
        yield


def crowd(
    policy: Policy, far: list[float], kind: Category, homes: int = 1
) -> dict[str, tuple[float, float]]:
    """Fly far trips while near ones keep coming; return when each began to wait, and when it got a drone."""
    inner = apps.flow(policy=policy, clock=True)

    def flow(run: Run[apps.Mission]) -> Coroutine[Any, Any, Status]:
        if run.mission.name.startswith("near"):
            put(run.mission, deadline=1e6 + run.mission.index)
        return inner(run)

    missions = [
        apps.mission(f"near {n}", apps.trip("1", 1.0 + n % 3, 2.0, delay=6.0 * n + 0.5))
        for n in range(NEAR)
    ]
    missions += [
        apps.mission(f"far {n}", apps.trip("1", x, 18.0, delay=1.0 + n)) for n, x in enumerate(far)
    ]
    docks = [(1.0 + 1.5 * n, 0.5, 0.0) for n in range(homes)]
    on = apps.fleet(*docks, after=AfterTrip.NEXT)
    outcome = apps.fly(apps.app(flow, categories=(kind,)), *missions, on=on)
    assert outcome.completed
    since = {one.name: one.completed_trips[0].delay or 0.0 for one in outcome.missions}
    got = apps.moments(outcome, "trip.allocated")
    return {name: (since[name], got[name]) for name in got}


@settings(max_examples=6)
@given(
    st.sampled_from(POLICIES),
    st.lists(st.floats(0.5, 18.0), min_size=1, max_size=3),
    st.integers(1, 2),
    st.sampled_from((TIRED, TIRELESS)),
)
def test_none_waits_longer_than_the_bound(
    policy: Policy, far: list[float], homes: int, kind: Category
) -> None:
    """Also where near trips keep every drone too low for the far one."""
    flown = crowd(policy, far, kind, homes)
    charge = 0.0 if kind is TIRELESS else kind.charge_time
    for name, (since, got) in flown.items():
        if name.startswith("far"):
            before = sum(other < since for other, _ in flown.values())
            assert got - since <= OLD + (before + 1) * (LONGEST + charge)


@pytest.mark.parametrize("policy", POLICIES)
def test_the_old_go_in_the_order_in_which_they_came(policy: Policy) -> None:
    """Once both are old."""
    flown = crowd(policy, [18.0, 17.0, 16.0], TIRED)
    late = OLD + LONGEST + TIRED.charge_time
    old = sorted((since, got) for since, got in flown.values() if got - since > late)
    assert len(old) > 10
    assert all(one[1] <= other[1] for one, other in pairwise(old))


def test_without_it_one_would_wait_for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plan above is one in which a far trip is passed over: else it would prove nothing."""
    since, got = crowd(earliest_deadline, [18.0], TIRELESS)["far 0"]
    assert OLD <= got - since <= OLD + LONGEST
    monkeypatch.setattr(batch, "OLD", 1e9)
    since, without = crowd(earliest_deadline, [18.0], TIRELESS)["far 0"]
    assert without > got + LONGEST


def test_a_trip_is_as_old_as_it_has_waited_and_not_as_the_day() -> None:
    """One that comes late in the day is shared out like any other: its nearest drone is the other's."""
    late = 0.9 * OLD
    missions = [
        apps.mission(name, apps.trip("1", x, 0.5, delay=late))
        for name, x in (("a", 3.5), ("b", 5.5))
    ]
    on = apps.fleet((0.5, 0.5, 0.0), (4.5, 0.5, 0.0))
    outcome = apps.fly(apps.app(apps.flow(policy=batch_optimal, clock=True)), *missions, on=on)
    got = {one["mission"]: one["drone"] for one in apps.events(outcome, "trip.allocated")}
    assert got == {"a": "cf1", "b": "cf2"}
