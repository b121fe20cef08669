"""Driving a brain by hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.airspace import Airspace
from tests.kit import apps

Data = Mapping[str, Any]


def trip(x: float = 3.0, **more: object) -> Data:
    """Return a trip as plain data."""
    return {"action": "take_photo", "target": [x, 0.5, 1.2], **more}


def charged(drones: int = 1, app: App | None = None, **fleet: object) -> Brain:
    """Return a brain whose drones stand charged at home."""
    ids = [f"cf{number}" for number in range(1, drones + 1)]
    homes = [{"id": one, "home": [float(x), 0.5, 0.0]} for x, one in enumerate(ids, 1)]
    brain = Brain(app or apps.app(apps.flow()), {"drones": homes, **fleet}, space=Airspace())
    brain.tell({"telemetry": {drone: {"battery": 1.0} for drone in ids}}, 0.0)
    return brain


def settled(brain: Brain, now: float) -> Sequence[Data]:
    """Let all happen that is due at a time, and return what is ordered."""
    orders = brain.orders()
    while (due := brain.due) is not None and due <= now:
        brain.advance(now)
        orders += brain.orders()
    return orders
