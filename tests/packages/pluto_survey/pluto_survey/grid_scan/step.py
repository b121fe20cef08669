"""What a GridScan does."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

from plutoc_runtime.domain.keeper import put_trips
from plutoc_runtime.domain.status import Status
from plutoc_runtime.flow.run import Run


def spread_trips(run: Run[Any], status: Status, *, spacing: float, side: int) -> Status:
    """Replace every trip of the mission by a grid around its target."""
    middle = (side - 1) / 2
    spread: list[Any] = []
    for trip in run.mission.trips:
        x, y, z = trip.target
        for row, column in product(range(side), repeat=2):
            target = (x + (column - middle) * spacing, y + (row - middle) * spacing, z)
            name = f"{trip.name}.{row + 1}.{column + 1}"
            spread.append(replace(trip, name=name, target=target, index=len(spread)))
    put_trips(run.mission, spread)
    run.core.log(f"{len(spread)} places to survey", run.mission.name)
    return status
