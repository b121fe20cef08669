"""Clock: delays, times of day and rounds at a fixed rate."""

from __future__ import annotations

import pytest

from tests.kit import apps


def starts(outcome: apps.SimulationResult) -> list[float]:
    return apps.times(outcome, "trip.launched")


def test_a_delay_counts_from_the_arrival_at_the_clock() -> None:
    trips = [apps.trip("A", 3.0, delay=30.0), apps.trip("B", 3.0, delay=40.0)]
    outcome = apps.flown(apps.mission("m", *trips), clock=True)
    first_end = apps.times(outcome, "trip.completed")[0]
    assert starts(outcome) == [30.0, pytest.approx(first_end + 40.0)]


def test_a_retry_waits_its_delay_anew() -> None:
    trips = [apps.trip("A", 15.0, delay=30.0)]
    outcome = apps.flown(
        apps.mission("m", *trips, safe_time=5.0), clock=True, attempts=2, watch=apps.timed
    )
    assert starts(outcome)[:2] == [30.0, 65.0]


def test_at_holds_the_first_trip_until_that_time_of_day() -> None:
    trips = [apps.trip("A", 3.0), apps.trip("B", 3.0)]
    outcome = apps.flown(apps.mission("m", *trips, at=8 * 3600.0), clock=True)
    first, second = starts(outcome)
    assert first == 8 * 3600.0
    assert second < first + 60.0


def test_every_starts_each_round_at_a_multiple_of_it_after_the_first() -> None:
    outcome = apps.flown(
        apps.mission("m", apps.trip("A", 3.0), repeat=3, every=100.0, at=60.0),
        clock=True,
        repeater=True,
    )
    assert starts(outcome) == [60.0, 160.0, 260.0, 360.0]


@pytest.mark.parametrize("every", [1e-300, 5e-324, float("nan"), float("inf")])
def test_rounds_that_no_number_counts_begin_at_once(every: float) -> None:
    """A hook may set it to anything: nothing but its own mission has that."""
    outcome = apps.flown(
        apps.mission("m", apps.trip("A", 3.0), repeat=1, every=every),
        on=apps.TWO,
        clock=True,
        repeater=True,
    )
    assert len(starts(outcome)) == 2
    assert starts(outcome)[1] < 60.0


def test_a_round_that_takes_longer_than_every_waits_for_the_next_multiple() -> None:
    outcome = apps.flown(
        apps.mission("m", apps.trip("A", 6.0), repeat=2, every=10.0),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), (2.5, 0.5, 0.0)),
        clock=True,
        repeater=True,
    )
    assert [start % 10.0 for start in starts(outcome)] == [0.0, 0.0, 0.0]
    assert starts(outcome)[1] > 10.0
