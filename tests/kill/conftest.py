"""Flights of real processes, a folder each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.kill.lives import Flight
from tests.kill.painter import WALL, painter_in
from tests.kill.plans import PLANS, Plan
from tests.kill.trial import end_gateway
from tests.kit.apps import compiled

NewFlight = Callable[[float], Flight]


@pytest.fixture
def plan() -> Plan:
    """An app with delays and retries, whose three missions carry things."""
    return next(plan for plan in PLANS if plan.app == "drugs_distribution_retry")


@pytest.fixture
def painting(tmp_path: Path) -> Iterator[Flight]:
    """Prepare a flight of the app with an action of its own."""
    WALL.write(tmp_path)
    source = painter_in(tmp_path / "painter")
    flight = Flight(app="painter", source=source, folder=tmp_path, speed=20.0)
    yield flight
    flight.end()
    end_gateway(flight.journal)


@pytest.fixture
def new_flight(plan: Plan, tmp_path: Path) -> Iterator[NewFlight]:
    """Prepare flights at some speed; none of their processes is left behind."""
    flights: list[Flight] = []
    source = compiled(plan.app) / "src"

    def new(speed: float) -> Flight:
        folder = tmp_path / str(len(flights))
        folder.mkdir()
        plan.write(folder)
        flights.append(Flight(app=plan.app, source=source, folder=folder, speed=speed))
        return flights[-1]

    yield new
    for flight in flights:
        flight.end()
        end_gateway(flight.journal)
