"""TripSkipper: a failed trip is left out, and the mission goes on with the next one."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.trip_skipper.step import skip_trip
from tests.kit import apps


async def watched(run: Run[Any], status: Status) -> Status:
    """Watch the trip, and leave it out if it fails."""
    status = await apps.watched(run, status)
    return skip_trip(run, status) if status is Status.FAILED else status


@pytest.mark.parametrize("trips", [1, 3])
def test_a_mission_whose_trips_all_fail_is_complete_without_them(trips: int) -> None:
    mission = apps.mission("m", *(apps.trip(f"{n}", 3.0) for n in range(trips)))
    outcome = apps.flown(mission, watch=watched, faults=Faults(action=1.0))
    names = [f"{n}" for n in range(trips)]
    assert [event["trip"] for event in apps.events(outcome, "trip.skipped")] == names
    assert [event["trip"] for event in apps.events(outcome, "trip.launched")] == names
    assert mission.status is Status.COMPLETED
    assert not mission.trips
    assert not mission.completed_trips


def test_the_reason_of_a_failure_goes_with_its_trip() -> None:
    mission = apps.mission("m", apps.trip("A", 3.0), apps.trip("B", 3.0))
    outcome = apps.flown(mission, watch=watched, faults=Faults(action=0.5), seed=3)
    skipped = apps.events(outcome, "trip.skipped")
    assert len(skipped) + len(mission.completed_trips) == 2
    assert (mission.status, mission.reason) == (Status.COMPLETED, "")
