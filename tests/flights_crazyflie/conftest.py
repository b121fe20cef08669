"""Flights with simulated Crazyflies, a folder each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.plans import DISTRIBUTION, write
from tests.kit.apps import compiled

pytest.importorskip("cflib")

NewFlight = Callable[[str, str, int], Flight]


@pytest.fixture(scope="session")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app's package is imported from."""
    return compiled(DISTRIBUTION, tmp_path_factory.mktemp("package")) / "src"


@pytest.fixture
def new_flight(source: Path, tmp_path: Path) -> Iterator[NewFlight]:
    """Prepare flights: from the missions, the fleet and how many drones; nothing is left of them."""
    flights: list[Flight] = []

    def new(missions: str, fleet: str, drones: int) -> Flight:
        folder = tmp_path / str(len(flights))
        write(folder, missions, fleet)
        flights.append(Flight(app=DISTRIBUTION, source=source, folder=folder, drones=drones))
        return flights[-1]

    yield new
    for flight in flights:
        flight.end()
