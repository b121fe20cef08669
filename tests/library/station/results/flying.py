"""Examples that have been flown into a journal, and the worlds over which their drones flew."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.shared.alone.world import World
from pluto_fleet.station.results.flights import FlightResults, ResultsOfFlights
from tests.kit.apps import example
from tests.library.station import in_process

SEED = 3


@dataclass(frozen=True, kw_only=True)
class Flown:
    """A flight that is over."""

    app: App
    world: World
    """The world without the errors of its sensors: `truth` of them."""
    size: tuple[float, float]
    results: FlightResults


def flown(name: str, folder: Path) -> Flown:
    """Fly an example's missions to their end, and read their results off the journal."""
    with pytest.MonkeyPatch.context() as patch, in_process.world(patch) as here:
        options = {"seed": SEED, "speed": 200.0}
        station = in_process.Flown(world=here, name=name, folder=folder, options=options)
        station.tell("start")
        station.comes_to("over")
        [journal] = station.journals()
    app, fleet = example(name).app, example(name).fleet
    return Flown(
        app=app,
        world=World(SEED, fleet.airspace, fleet.world),
        size=fleet.airspace.size,
        results=ResultsOfFlights(app, folder).of(journal.stem),
    )


def truth(world: World, quantity: str, x: float, y: float) -> float:
    """Return what the world holds at a place, without the error of a sensor."""
    value = world.background.get(quantity, 0.0)
    for source in world.sources:
        if source.quantity == quantity:
            value += source.at_distance(x - source.at[0], y - source.at[1])
    return value
