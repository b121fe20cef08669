"""When a drone is free again, and where: by what is planned for it, or as it stands."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.domain.status import DroneStatus
from pluto_fleet.shared.fleet.durations import free_again
from tests.brain.fleet.standing import fleet

NOW = 100.0
HERE, THERE = (1.0, 1.0, 0.0), (5.0, 5.0, 1.2)


def told(
    status: DroneStatus, until: float | None, charged: float | None = None
) -> tuple[float, object]:
    """Return what is said of a drone of this status, of which a plan says when it is there."""
    [drone] = fleet(HERE)
    drone.status = status
    plans: dict[Drone, Any] = {} if until is None else {drone: (until, THERE)}
    queue: Any = SimpleNamespace(
        kernel=SimpleNamespace(now=NOW), plans={"until": plans}, ready_at=lambda _: charged
    )
    return free_again(drone, queue)


@pytest.mark.parametrize(
    ("status", "until", "charged", "expected"),
    [
        (DroneStatus.BUSY, 130.0, None, (30.0, THERE)),
        (DroneStatus.BUSY, NOW, None, (0.0, THERE)),
        (DroneStatus.BUSY, 80.0, None, (20.0, HERE)),  # late: as long again
        (DroneStatus.BUSY, None, None, (0.0, HERE)),
        (DroneStatus.FREE, 130.0, None, (30.0, HERE)),
        (DroneStatus.BUSY, 110.0, 160.0, (60.0, THERE)),
    ],
)
def test_a_drone_is_free_when_and_where_its_plan_says_unless_it_is_late(
    status: DroneStatus,
    until: float | None,
    charged: float | None,
    expected: tuple[float, object],
) -> None:
    assert told(status, until, charged) == expected
