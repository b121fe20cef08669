"""GapMonitor: an action follows the one before it within its gap."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.trace import Event
from tests.kit import apps


def gapped(*trips: apps.Trip, attempts: int | None = None, **mission: int) -> apps.SimulationResult:
    """Fly trips with gaps; a second drone can begin at once."""
    return apps.flown(
        apps.mission("m", *trips, **mission),
        on=apps.TWO,
        watch=apps.gapped,
        attempts=attempts,
        repeater=True,
    )


def failures(outcome: apps.SimulationResult) -> list[Event]:
    """The failures of a gap."""
    return [e for e in apps.events(outcome, "trip.failed") if "previous one" in str(e["reason"])]


def near_and_far() -> tuple[apps.Trip, apps.Trip]:
    return apps.trip("A", 3.0), apps.trip("B", 15.0, gap=20.0)


def test_the_first_trip_of_a_mission_has_no_gap() -> None:
    assert gapped(apps.trip("A", 15.0, gap=1.0)).completed


def test_the_first_trip_of_each_further_round_has_none_either() -> None:
    """The round before has ended long ago, or a moment ago: it does not count."""
    outcome = gapped(apps.trip("A", 15.0, gap=1.0), repeat=2)
    assert outcome.completed
    assert outcome.count("trip.completed") == 3


def test_an_action_too_long_after_the_previous_one_fails_its_trip() -> None:
    outcome = gapped(*near_and_far())
    (failure,) = failures(outcome)
    assert failure["t"] == pytest.approx(apps.times(outcome, "trip.completed")[0] + 20.0)
    assert failure["reason"] == (
        "the action of trip B was not done within 20 s of the previous one"
    )


def test_a_retry_counts_its_gap_from_its_own_start() -> None:
    outcome = gapped(*near_and_far(), attempts=2)
    _, second = failures(outcome)
    assert second["t"] == pytest.approx(apps.times(outcome, "trip.launched")[2] + 20.0)


def test_a_gap_of_zero_is_no_limit() -> None:
    assert gapped(apps.trip("A", 3.0), apps.trip("B", 15.0, gap=0.0)).completed
