"""Limits on flights: they fail a trip at their very instant, and never another one's."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.status import DroneStatus, Status
from pluto_fleet.shared.domain.trace import Event
from tests.kit import apps


def test_a_safe_time_longer_than_each_trip_never_fails_a_later_one() -> None:
    """A gate that counts arrivals would let the first trip's timer fail the mission."""
    trips = [apps.trip(name, 8.0) for name in "ABC"]
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.timed)), apps.mission("m", *trips, safe_time=60.0)
    )
    assert outcome.missions[0].status is Status.COMPLETED
    assert outcome.duration > 60.0


def test_a_trip_longer_than_its_safe_time_fails_at_that_very_instant() -> None:
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.timed)),
        apps.mission("m", apps.trip("A", 15.0), safe_time=12.345),
    )
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "trip A took longer than its safe time of 12.3 s"
    assert apps.times(outcome, "trip.failed") == [pytest.approx(12.345, abs=1e-6)]


def test_a_drone_that_was_called_back_is_not_handed_out_before_it_is_home() -> None:
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.timed, attempts=2)),
        apps.mission("m", apps.trip("A", 15.0), safe_time=12.0),
    )
    assert outcome.count("trip.launched") == 2
    again = apps.times(outcome, "trip.launched")[1]
    home = apps.times(outcome, "drone.free")[0]
    assert apps.times(outcome, "drone.recovering")[0] == pytest.approx(12.0)
    assert again == home > 20.0
    assert outcome.drones[0].status is DroneStatus.FREE


def test_an_explicit_safe_time_of_zero_is_no_limit() -> None:
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.timed)),
        apps.mission("m", apps.trip("A", 15.0), safe_time=0.0),
    )
    assert outcome.completed


def test_at_one_instant_the_trips_own_end_wins() -> None:
    tested = apps.app(apps.flow(watch=apps.timed))
    first = apps.fly(tested, apps.mission("m", apps.trip("A", 4.0)))
    ends = apps.times(first, "trip.completed")[0]
    exact = apps.fly(
        tested,
        apps.mission(
            "m", apps.trip("A", 4.0), safe_time=first.missions[0].completed_trips[0].elapsed
        ),
    )
    assert exact.completed, f"it ends at {ends}"
    tight = apps.fly(tested, apps.mission("m", apps.trip("A", 4.0), safe_time=ends - 0.001))
    assert not tight.completed


def gap_failures(outcome: apps.SimulationResult) -> list[Event]:
    """The failures of a gap."""
    return [e for e in apps.events(outcome, "trip.failed") if "previous one" in str(e["reason"])]


def test_the_first_trip_of_a_mission_has_no_gap() -> None:
    trips = [apps.trip("A", 15.0, gap=1.0)]
    outcome = apps.fly(apps.app(apps.flow(watch=apps.gapped)), apps.mission("m", *trips))
    assert outcome.completed


def test_an_action_too_long_after_the_previous_one_fails_its_trip() -> None:
    trips = [apps.trip("A", 3.0), apps.trip("B", 15.0, gap=20.0)]
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.gapped)),
        apps.mission("m", *trips),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0)),
    )
    (failure,) = gap_failures(outcome)
    assert failure["t"] == pytest.approx(apps.times(outcome, "trip.completed")[0] + 20.0)


def test_a_retry_counts_its_gap_from_its_own_start() -> None:
    trips = [apps.trip("A", 3.0), apps.trip("B", 15.0, gap=20.0)]
    outcome = apps.fly(
        apps.app(apps.flow(watch=apps.gapped, attempts=2)),
        apps.mission("m", *trips),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0)),
    )
    _, second = gap_failures(outcome)
    assert second["t"] == pytest.approx(apps.times(outcome, "trip.launched")[2] + 20.0)
