"""The fleet file: the map, the drones on it, and what a simulation makes them see (docs/files.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import cycle, islice
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.airspace import Airspace
from plutoc_runtime.domain.fleet_data import FleetData

from . import errors
from .behaviour import APART, CRAZYFLIE, OWN, read_behaviour
from .drones import DroneEntry, named_navigations, read_drones
from .free_tables import Options, navigation_options, options_under
from .map import read_map
from .reading import Document, read
from .table import Table
from .world import read_world

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Point

__all__ = ["DroneEntry", "FleetFile", "default_fleet", "fleet_of", "load_fleet"]

DEFAULT_SIZE, ROW = 5, 18
"""Drones of a fleet that nobody described, and how many stand in a row."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetFile(FleetData):
    """What a fleet file says, of real flights too."""

    drones: tuple[DroneEntry, ...]
    image: str | None = None
    """The floor plan, relative to the file."""
    apart: float = APART
    """The least distance between two drones, in metres."""
    navigation: str = CRAZYFLIE
    """How real drones are flown: a name, or `module:Class`."""
    options: Mapping[str, Options] = field(default_factory=dict)
    """For each way of flying them, by its name."""
    localization: str = OWN
    """Who tells real drones where they are: a name, or `module:Class`."""
    localization_options: Options = field(default_factory=dict)


def default_fleet(app: App, size: int = DEFAULT_SIZE) -> FleetFile:
    """Return the fleet of whoever has written no fleet file: five drones on an empty plain."""
    categories = islice(cycle(app.categories), size)
    drones = tuple(
        DroneEntry(id=f"cf{place + 1}", category=category.name, home=_default_home(place))
        for place, category in enumerate(categories)
    )
    return FleetFile(airspace=Airspace(), drones=drones)


def _default_home(place: int) -> Point:
    row, column = divmod(place, ROW)
    return float(column + 1), 0.5 + row, 0.0


def load_fleet(path: Path, app: App) -> FleetFile:
    """Return what a fleet file says; raise `BadInput` with everything that is wrong with it."""
    return fleet_of(read(path), app)


def fleet_of(document: Document, app: App) -> FleetFile:
    """Return what a fleet file that was read says, as `load_fleet` does."""
    top = Table(document, document.data)
    top.only(("map", "fleet", "drone", "navigation", "localization", "world"), "a fleet file")
    airspace, image = read_map(top)
    behaviour = read_behaviour(top)
    drones = read_drones(top, app, airspace)
    options = navigation_options(top, named_navigations(top, behaviour.navigation))
    localization_options = options_under(top, "localization")
    if "localization" in top.data and behaviour.localization == OWN:
        top.problem(errors.localization_unused(), "localization")
    world = read_world(top)
    document.refuse_if_bad()
    return FleetFile(
        airspace=airspace or Airspace(),
        image=image,
        after_trip=behaviour.after_trip,
        apart=behaviour.apart,
        max_airborne=behaviour.max_airborne,
        navigation=behaviour.navigation,
        options=options,
        localization=behaviour.localization,
        localization_options=localization_options,
        drones=drones,
        world=world,
    )
