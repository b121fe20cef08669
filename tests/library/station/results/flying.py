"""Examples that have been flown into a journal, and the worlds over which their drones flew."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from pluto_fleet.app import described
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.shared.alone.world import World
from pluto_fleet.station.results.flights import FlightResults, ResultsOfFlights
from tests.kit.apps import EXAMPLES, compiled

if TYPE_CHECKING:
    from pluto_fleet.app import App

SEED = 3
NAME = "flight"


@dataclass(frozen=True, kw_only=True)
class Flown:
    """A flight that is over."""

    app: App
    world: World
    """The world without the errors of its sensors: `truth` of them."""
    size: tuple[float, float]
    results: FlightResults


def flown(name: str, folder: Path) -> Flown:
    """Compile an example, fly its missions to their end, and read their results off the journal."""
    package = compiled(name, folder)
    files = EXAMPLES / name
    path = os.pathsep.join((str(package / "src"), os.environ.get("PYTHONPATH", "")))
    words = [sys.executable, "-m", name, "fly", str(files / "missions.toml")]
    words += ["--fleet", str(files / "fleet.toml"), "--sim", "--speed", "500"]
    words += ["--seed", str(SEED), "--journal", str(folder / f"{NAME}.journal")]
    done = subprocess.run(
        words, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False
    )
    assert done.returncode in (0, 1), done.stdout + done.stderr
    app = _imported(name, package)
    fleet = load_fleet(files / "fleet.toml", app)
    return Flown(
        app=app,
        world=World(SEED, fleet.airspace, fleet.world),
        size=fleet.airspace.size,
        results=ResultsOfFlights(app, folder).of(NAME),
    )


def _imported(name: str, package: Path) -> App:
    for module in [known for known in sys.modules if known.split(".")[0] == name]:
        del sys.modules[module]
    sys.path.insert(0, str(package / "src"))
    try:
        return described(import_module(f"{name}.flow").APP)
    finally:
        sys.path.remove(str(package / "src"))


def truth(world: World, quantity: str, x: float, y: float) -> float:
    """Return what the world holds at a place, without the error of a sensor."""
    value = world.background.get(quantity, 0.0)
    for source in world.sources:
        if source.quantity == quantity:
            value += source.at_distance(x - source.at[0], y - source.at[1])
    return value
