"""The fleet file: the map, the drones on it, and what a simulation makes them see (docs/files.md)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import cycle, islice
from math import dist
from pathlib import Path
from typing import TYPE_CHECKING

from ..airspace import Airspace
from ..model import AfterTrip
from ..quantities import Type
from ..words import quoted
from . import errors, values
from .map import read_map
from .reading import Document, read
from .table import Table
from .world import read_world

if TYPE_CHECKING:
    from ..app import App
    from ..model import Point
    from ..simulation.world import WorldData

APART = 0.5
"""Metres: two Crazyflies nearer than that blow each other off course."""

HOME_SIZE = 0.1
"""Metres that a drone takes up where it stands."""

DEFAULT_SIZE = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEntry:
    """A drone as the fleet file has it."""

    id: str
    category: str
    """The name of one of the app's categories."""
    home: Point
    uri: str | None = None
    line: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetFile:
    """What a fleet file says."""

    airspace: Airspace
    drones: tuple[DroneEntry, ...]
    image: str | None = None
    """The floor plan, relative to the file."""
    after_trip: AfterTrip = AfterTrip.HOME
    apart: float = APART
    """The least distance between two drones, in metres."""
    max_airborne: int | None = None
    world: WorldData | None = None
    """None: a simulation makes up a world from its seed."""


def default_fleet(app: App) -> FleetFile:
    """Return the fleet of whoever has written no fleet file: five drones on an empty plain."""
    categories = islice(cycle(app.categories), DEFAULT_SIZE)
    drones = tuple(
        DroneEntry(id=f"cf{place}", category=category.name, home=(float(place), 0.5, 0.0))
        for place, category in enumerate(categories, start=1)
    )
    return FleetFile(airspace=Airspace(), drones=drones)


def load_fleet(path: Path, app: App) -> FleetFile:
    """Return what a fleet file says; raise `BadInput` with everything that is wrong with it."""
    return fleet_of(read(path), app)


def fleet_of(document: Document, app: App) -> FleetFile:
    """Return what a fleet file that was read says, as `load_fleet` does."""
    top = Table(document, document.data)
    top.only(("map", "fleet", "drone", "world"), "a fleet file")
    airspace, image = read_map(top)
    after_trip, apart, max_airborne = _behaviour(top)
    drones = _drones(top, app, airspace)
    world = read_world(top)
    document.refuse_if_bad()
    return FleetFile(
        airspace=airspace or Airspace(),
        image=image,
        after_trip=after_trip,
        apart=apart,
        max_airborne=max_airborne,
        drones=drones,
        world=world,
    )


def _behaviour(top: Table) -> tuple[AfterTrip, float, int | None]:
    table = top.table("fleet")
    if table is None:
        return AfterTrip.HOME, APART, None
    table.only(("after_trip", "apart", "max_airborne"), "[fleet]")
    after_trip = table.read("after_trip", _after_trip)
    apart = table.read("apart", partial(values.quantity, kind=Type.LENGTH, least=0.0))
    max_airborne = table.read("max_airborne", partial(values.integer, least=1))
    return after_trip or AfterTrip.HOME, APART if apart is None else apart, max_airborne


def _after_trip(value: object) -> AfterTrip:
    for choice in AfterTrip:
        if value == choice.value:
            return choice
    raise values.Wrong(f"is none of: {', '.join(choice.value for choice in AfterTrip)}")


def _drones(top: Table, app: App, airspace: Airspace | None) -> tuple[DroneEntry, ...]:
    drones: list[DroneEntry] = []
    ids: dict[str, Table] = {}
    for index, table in enumerate(top.tables("drone", "drone")):
        drone = _drone(table, index, app, airspace, ids)
        if drone is not None:
            _stands_alone(drone, drones, table)
            drones.append(drone)
    if top.data.get("drone", []) == []:
        top.problem(errors.none_given("drone"))
    return tuple(drones)


def _drone(
    table: Table, index: int, app: App, airspace: Airspace | None, ids: dict[str, Table]
) -> DroneEntry | None:
    table.who = f"drone {index + 1}"
    table.only(("id", "category", "home", "uri"), "a drone")
    name = table.read("id", values.name, required=True)
    if name is not None:
        table.who = f"drone {quoted(name)}"
        other = ids.setdefault(name, table)
        if other is not table:
            table.problem(errors.not_unique("drone", name, other.line("id")), "id")
    category = _category(table, app)
    home = table.read("home", partial(values.position, height=0.0), required=True)
    uri = table.read("uri", values.name)
    if home is not None and airspace is not None:
        problem = airspace.problem(home)
        if problem is not None:
            table.problem(f"home {problem}", "home")
    if name is None or category is None or home is None:
        return None
    return DroneEntry(id=name, category=category, home=home, uri=uri, line=table.line())


def _category(table: Table, app: App) -> str | None:
    names = [category.name for category in app.categories]
    if "category" not in table.data:
        if len(names) == 1:  # there is nothing to choose
            return names[0]
        table.problem(errors.category_missing(names))
        return None
    name = table.read("category", values.text)
    if name is not None and name not in names:
        table.problem(errors.unknown_name("category", name, names, "this app has"), "category")
        return None
    return name


def _stands_alone(drone: DroneEntry, others: list[DroneEntry], table: Table) -> None:
    for other in others:
        if dist(drone.home, other.home) < HOME_SIZE:
            table.problem(errors.shared_home(other.id), "home")
            return
