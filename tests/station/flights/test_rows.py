"""What all pages see of a mission."""

from __future__ import annotations

from collections.abc import Coroutine, Generator
from dataclasses import dataclass
from typing import Any, cast

import pytest

from pluto_fleet.station.rows import mission_row, recorded_row
from plutoc_runtime.domain.app import App
from plutoc_runtime.domain.model import Mission, Trip
from plutoc_runtime.domain.status import COMPLETED, STANDBY, Status
from plutoc_runtime.flow.mission import Core, MissionState


class Long:
    """Something for which one waits."""

    def __await__(self) -> Generator[None, None, None]:
        yield


async def flow(_: object) -> Status:
    # allocate = DroneAllocator
    await Long()
    return COMPLETED


@dataclass
class Resuming:
    """As much of an app as a row asks for."""

    flow: object = flow
    resumes: tuple[str, ...] = ("allocate",)


@dataclass
class Waiting:
    """As much of a task as says where it is."""

    coroutine: Coroutine[Any, Any, Status]


def row(mission: Mission[Any], state: MissionState | None) -> dict[str, object]:
    return mission_row(cast("App", Resuming()), mission, state, 10.0, lambda trip: trip.action)


def test_a_mission_whose_last_trip_is_judged_has_not_ended() -> None:
    mission = Mission[Any](name="a", trips=[])
    mission.status = COMPLETED
    state = MissionState(cast("Core", None), mission, lambda _: None)
    state.at = "judge"
    seen = row(mission, state)
    assert (seen["status"], seen["at"]) == ("STANDBY", ["judge"])


def test_a_mission_that_has_ended_is_at_the_end() -> None:
    mission = Mission[Any](name="a", trips=[])
    mission.status = COMPLETED
    seen = row(mission, None)
    assert (seen["status"], seen["at"], seen["wait"]) == ("COMPLETED", ["end"], "")


def test_a_mission_waits_for_a_drone_that_can_do_its_next_trip() -> None:
    trip = Trip(name="1", action="measure", target=(1.0, 1.0, 1.0))
    mission = Mission[Any](name="a", trips=[trip])
    mission.status = STANDBY
    state = MissionState(cast("Core", None), mission, lambda _: None)
    coroutine = flow(mission)
    coroutine.send(None)
    state.task = cast("Any", Waiting(coroutine))
    assert row(mission, state)["wait"] == "waits for a drone (measure)"
    coroutine.close()


@pytest.mark.parametrize(
    ("status", "ended", "shown"),
    [
        ("RUNNING", False, ("STANDBY", ["judge"])),
        ("COMPLETED", False, ("STANDBY", ["judge"])),
        ("COMPLETED", True, ("COMPLETED", ["end"])),
    ],
)
def test_what_was_judged_when_its_station_died_has_not_ended_either(
    status: str, ended: bool, shown: object
) -> None:
    record: dict[str, Any] = {"done": [], "todo": [], "status": status, "reason": ""}
    record |= {"ended": ended, "at": "judge", "index": 0, "attempts": 1, "round": 0}
    record |= dict.fromkeys(("question", "held", "paused"))
    seen = recorded_row("a", record)
    assert (seen["status"], seen["at"]) == shown


def test_a_mission_that_goes_on_is_shown_with_the_drone_that_has_its_item() -> None:
    record: dict[str, Any] = {"done": [], "todo": [], "status": "STANDBY", "reason": ""}
    record |= {"ended": False, "at": None, "index": 0, "attempts": 1, "round": 0, "carrier": "cf1"}
    record |= dict.fromkeys(("question", "held", "paused"))
    assert recorded_row("a", record, lives=True)["drone"] == "cf1"
    assert recorded_row("a", record)["drone"] is None
