"""What each drone has flown, over all flights that are kept."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..wire import DroneHours
    from .digest import Digest


def hours_of(digests: Iterable[Digest]) -> list[DroneHours]:
    """Return a row for each drone, in the order of their ids."""
    found: dict[str, DroneHours] = {}
    for digest in digests:
        for drone, work in digest.work.items():
            row = found.setdefault(
                drone,
                {
                    "id": drone,
                    "flights": 0,
                    "trips": 0,
                    "hours": 0.0,
                    "cycles": 0.0,
                    "lost": 0,
                    "unmeasured": 0,
                },
            )
            flew = bool(work.launched or work.measured)
            row["flights"] += flew
            row["trips"] += work.trips
            row["hours"] += work.seconds / 3600
            row["cycles"] += work.cycles
            row["lost"] += work.lost
            row["unmeasured"] += flew and not work.measured
    return [found[drone] for drone in sorted(found)]
