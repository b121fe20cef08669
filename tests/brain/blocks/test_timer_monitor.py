"""TimerMonitor: it fails a trip at the very instant of its safe time, and never another one."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.status import DroneStatus, Status
from tests.kit import apps


def timed(
    *trips: apps.Trip, safe_time: float, attempts: int | None = None
) -> apps.SimulationResult:
    """Fly trips that may each take so long."""
    mission = apps.mission("m", *trips, safe_time=safe_time)
    return apps.flown(mission, watch=apps.timed, attempts=attempts)


def test_a_safe_time_longer_than_each_trip_never_fails_a_later_one() -> None:
    """A gate that counts arrivals would let the first trip's timer fail the mission."""
    outcome = timed(*(apps.trip(name, 8.0) for name in "ABC"), safe_time=60.0)
    assert outcome.completed
    assert outcome.duration > 60.0


def test_a_trip_longer_than_its_safe_time_fails_at_that_very_instant() -> None:
    outcome = timed(apps.trip("A", 15.0), safe_time=12.345)
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "trip A took longer than its safe time of 12.3 s"
    assert apps.times(outcome, "trip.failed") == [pytest.approx(12.345, abs=1e-6)]


def test_each_attempt_has_its_own_time_and_a_drone_that_is_home_again() -> None:
    outcome = timed(apps.trip("A", 15.0), safe_time=12.0, attempts=2)
    first, again = apps.times(outcome, "trip.launched")
    home = apps.times(outcome, "drone.free")[0]
    assert apps.times(outcome, "drone.recovering")[0] == pytest.approx(12.0)
    assert again == home > 20.0
    assert apps.times(outcome, "trip.failed") == pytest.approx([first + 12.0, again + 12.0])
    assert outcome.drones[0].status is DroneStatus.FREE


def test_an_explicit_safe_time_of_zero_is_no_limit() -> None:
    assert timed(apps.trip("A", 15.0), safe_time=0.0).completed


def test_at_one_instant_the_trips_own_end_wins() -> None:
    first = timed(apps.trip("A", 4.0), safe_time=99.0)
    (trip,) = first.missions[0].completed_trips
    assert timed(apps.trip("A", 4.0), safe_time=trip.elapsed).completed
    assert not timed(apps.trip("A", 4.0), safe_time=trip.elapsed - 0.001).completed


def test_of_several_limits_each_comes_at_its_own_time() -> None:
    """One timer serves them all, whichever was set first."""
    missions = [
        apps.mission(name, apps.trip("A", 18.0, 1.0), safe_time=safe)
        for name, safe in (("a", 12.0), ("b", 9.0), ("c", 15.0), ("d", 9.0))
    ]
    on = apps.fleet(*((0.5 + n, 0.5, 0.0) for n in range(4)))
    outcome = apps.flown(*missions, watch=apps.timed, on=on)
    failed = apps.moments(outcome, "trip.failed")
    assert failed == {"a": 12.0, "b": 9.0, "c": 15.0, "d": 9.0}
