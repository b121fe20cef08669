"""What everybody sees of a mission."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

from plutoc_runtime.app import App
from plutoc_runtime.core import Core
from plutoc_runtime.model import Mission
from plutoc_runtime.state import State
from plutoc_runtime.station.rows import mission_row
from plutoc_runtime.status import COMPLETED, Status


async def flow(_: object) -> Status:
    return COMPLETED


@dataclass
class Resuming:
    """As much of an app as a row asks for."""

    flow: object = flow
    resumes: tuple[str, ...] = ("allocate",)


def row(mission: Mission[Any], state: State | None) -> dict[str, object]:
    return mission_row(cast("App", Resuming()), mission, state, 10.0, "1 free")


def test_a_mission_whose_last_trip_is_judged_has_not_ended() -> None:
    mission = Mission[Any](name="a", trips=[])
    mission.status = COMPLETED
    state = State(cast("Core", None), mission, print, print)
    state.at = "judge"
    seen = row(mission, state)
    assert (seen["status"], seen["at"]) == ("STANDBY", ["judge"])


def test_a_mission_that_has_ended_is_at_the_end() -> None:
    mission = Mission[Any](name="a", trips=[])
    mission.status = COMPLETED
    seen = row(mission, None)
    assert (seen["status"], seen["at"], seen["wait"]) == ("COMPLETED", ["end"], "")
