"""The fleet file: the map, its drones, and the simulated world (docs/files.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import cycle, islice
from pathlib import Path
from typing import TYPE_CHECKING

from ..jobs.reports import SILENCE
from ..shared.domain import values
from ..shared.domain.airspace import Airspace
from ..shared.domain.fleet_data import Feature, FleetData, Source, WorldData
from ..shared.domain.model import AfterTrip
from ..shared.domain.motion import CRAZYFLIE as CRAZYFLIE_MOTION
from ..shared.domain.motion import motion_of
from ..shared.domain.quantities import Type
from . import errors
from .addresses import address_of, crowded_air
from .drones import CRAZYFLIE, DroneEntry, joining_drone, named_navigations, read_drones
from .landmarks import NO_LANDMARKS, Landmarks
from .landmarks_reading import KEYS as LANDMARK_KEYS
from .landmarks_reading import read_landmarks
from .options import Options, navigation_options, options_under
from .reading import Document, Table, read

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Corner
    from ..shared.domain.model import Point
    from ..shared.domain.motion import Motion
    from .options import Options


APART = 0.5
"""Metres: two Crazyflies closer than this disturb each other with their downwash."""

BETWEEN = values.Quantity(Type.LENGTH, 0.05, 10.0, or_none=True)
"""What may lie between two drones."""

OWN = "own"
"""The default localization: the drones' own."""


QUIET = values.Quantity(Type.TIME, 1.0, 30.0)
"""How long a drone in the air may tell nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Behaviour:
    """`[fleet]`."""

    after_trip: AfterTrip = AfterTrip.NEXT
    apart: float = APART
    max_airborne: int | None = None
    silence: float = SILENCE
    charges_at_home: bool = True
    navigation: str = CRAZYFLIE
    localization: str = OWN


_BEHAVIOUR = (
    *("after_trip", "apart", "max_airborne", "silence", "charges_at_home"),
    *("navigation", "localization"),
)


def read_behaviour(top: Table) -> Behaviour:
    """Return it, with its defaults."""
    table = top.table("fleet")
    if table is None:
        return Behaviour()
    table.only(_BEHAVIOUR, "[fleet]")
    apart = table.read("apart", BETWEEN)
    charges = table.read("charges_at_home", values.boolean)
    return Behaviour(
        after_trip=table.read("after_trip", values.after_trip) or AfterTrip.NEXT,
        apart=APART if apart is None else apart,
        max_airborne=table.read("max_airborne", values.count),
        silence=table.read("silence", QUIET) or SILENCE,
        charges_at_home=charges is not False,
        navigation=table.read("navigation", values.name) or CRAZYFLIE,
        localization=table.read("localization", values.name) or OWN,
    )


def read_motion(top: Table) -> Motion:
    """Return how the fleet's drones move: like Crazyflies, but for what `[motion]` says."""
    table = top.table("motion")
    if table is None:
        return CRAZYFLIE_MOTION
    table.only(tuple(values.MOTION), "[motion]")
    given = {key: table.read(key, values.MOTION[key]) for key in values.MOTION if key in table.data}
    return motion_of({key: value for key, value in given.items() if value is not None})


def read_map(top: Table) -> tuple[Airspace | None, Landmarks]:
    """Return the map and what it shows; no map if it is invalid."""
    table = top.table("map")
    if table is None:
        return (None if "map" in top.data else Airspace()), NO_LANDMARKS
    table.only(("size", "cruise_height", "ceiling", "no_fly", *LANDMARK_KEYS), "[map]")
    airspace = _airspace(table)
    return airspace, read_landmarks(table, airspace)


def _airspace(table: Table) -> Airspace | None:
    plain = Airspace()
    size = table.read("size", values.size) if "size" in table.data else plain.size
    cruise = _height(table, "cruise_height", plain.cruise_height)
    ceiling = _height(table, "ceiling", max(plain.ceiling, cruise or 0.0))
    no_fly = _no_fly(table)
    if cruise is not None and ceiling is not None and cruise > ceiling:
        table.problem(errors.cruise_above_ceiling(cruise, ceiling), "cruise_height")
    if size is None or cruise is None or ceiling is None or no_fly is None:
        return None
    return Airspace(size=size, cruise_height=cruise, ceiling=ceiling, no_fly=no_fly)


def _height(table: Table, key: str, default: float) -> float | None:
    if key not in table.data:
        return default
    return table.read(key, values.HEIGHT)


def _no_fly(table: Table) -> tuple[tuple[Corner, ...], ...] | None:
    given = table.read("no_fly", values.areas)
    areas: list[tuple[Corner, ...]] = []
    bad = given is None and "no_fly" in table.data
    for index, element in enumerate(given or ()):
        try:
            areas.append(values.area(element))
        except ValueError as error:
            table.problem(errors.no_fly_area(index + 1, str(error)), "no_fly", index)
            bad = True
    return None if bad else tuple(areas)


def read_world(top: Table) -> WorldData | None:
    """Return the world that the file describes, if any."""
    table = top.table("world")
    if table is None:
        return None
    table.only(("background", "feature", "source"), "[world]")
    features = [_feature(entry) for entry in table.tables("feature", "world.feature")]
    sources = [_source(entry) for entry in table.tables("source", "world.source")]
    return WorldData(
        features=tuple(feature for feature in features if feature is not None),
        sources=tuple(source for source in sources if source is not None),
        background=_background(table),
    )


def _background(table: Table) -> dict[str, float]:
    given = table.table("background")
    if given is None:
        return {}
    read = {quantity: given.read(quantity, values.real) for quantity in given.data}
    return {quantity: value for quantity, value in read.items() if value is not None}


def _feature(entry: Table) -> Feature | None:
    entry.who = "[[world.feature]]"
    entry.only(("kind", "at", "radius"), "a feature")
    kind = entry.read("kind", values.name, required=True)
    at = entry.read("at", values.corner, required=True)
    if "radius" not in entry.data:
        return None if kind is None or at is None else Feature(kind=kind, at=at)
    radius = entry.read("radius", values.RADIUS)
    if kind is None or at is None or radius is None:
        return None
    return Feature(kind=kind, at=at, radius=radius)


def _source(entry: Table) -> Source | None:
    entry.who = "[[world.source]]"
    entry.only(("quantity", "at", "peak", "radius"), "a source")
    quantity = entry.read("quantity", values.name, required=True)
    at = entry.read("at", values.corner, required=True)
    peak = entry.read("peak", values.real, required=True)
    radius = entry.read("radius", values.RADIUS, required=True)
    if quantity is None or at is None or peak is None or radius is None:
        return None
    return Source(quantity=quantity, at=at, peak=peak, radius=radius)


__all__ = ["CRAZYFLIE", "DroneEntry", "FleetFile", "default_fleet", "fleet_of", "load_fleet"]

DEFAULT_SIZE, ROW = 5, 18
"""Drones of the default fleet, and how many stand in a row."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetFile(FleetData):
    """The data of a fleet file, with what real flights need."""

    drones: tuple[DroneEntry, ...]
    landmarks: Landmarks = NO_LANDMARKS
    """What the map shows."""
    apart: float = APART
    """The least distance between two drones, in metres."""
    silence: float = SILENCE
    """Seconds for which a real drone in the air may tell nothing before its flight fails."""
    navigation: str = CRAZYFLIE
    """How real drones are flown: a name, or `module:Class`."""
    options: Mapping[str, Options] = field(default_factory=dict)
    """Options by navigation."""
    localization: str = OWN
    """The localization of real drones: a name, or `module:Class`."""
    localization_options: Options = field(default_factory=dict)


def default_fleet(app: App, size: int = DEFAULT_SIZE) -> FleetFile:
    """Return the fleet that is used without a file: five drones on an empty map."""
    categories = islice(cycle(app.categories), size)
    drones = tuple(
        DroneEntry(id=f"cf{place + 1}", category=category.name, home=_default_home(place))
        for place, category in enumerate(categories)
    )
    return FleetFile(airspace=Airspace(), drones=drones, motion=CRAZYFLIE_MOTION)


def _default_home(place: int) -> Point:
    row, column = divmod(place, ROW)
    return float(column + 1), 0.5 + row, 0.0


def load_fleet(path: Path, app: App) -> FleetFile:
    """Load a fleet file; raise `BadInput` with everything that is wrong with it."""
    return fleet_of(read(path), app)


def fleet_of(document: Document, app: App) -> FleetFile:
    """Return the fleet of a file's text, as `load_fleet` does."""
    top = Table(document, document.data)
    top.only(
        ("map", "fleet", "motion", "drone", "navigation", "localization", "world"), "a fleet file"
    )
    airspace, landmarks = read_map(top)
    behaviour, motion = read_behaviour(top), read_motion(top)
    drones = read_drones(top, app, airspace, behaviour.navigation)
    options = navigation_options(top, named_navigations(top, behaviour.navigation))
    localization_options = options_under(top, "localization")
    if "localization" in top.data and behaviour.localization == OWN:
        top.problem(errors.localization_unused(), "localization")
    world = read_world(top)
    document.refuse_if_bad()
    return FleetFile(
        airspace=airspace or Airspace(),
        landmarks=landmarks,
        after_trip=behaviour.after_trip,
        apart=behaviour.apart,
        max_airborne=behaviour.max_airborne,
        silence=behaviour.silence,
        charges_at_home=behaviour.charges_at_home,
        motion=motion,
        navigation=behaviour.navigation,
        options=options,
        localization=behaviour.localization,
        localization_options=localization_options,
        drones=drones,
        world=world,
    )


def navigation_of(fleet: FleetFile, drone: DroneEntry) -> str:
    """Return how a drone is flown: a name, or `module:Class`."""
    return drone.navigation or fleet.navigation


def options_of(fleet: FleetFile, drone: DroneEntry) -> Options:
    """Return the options for its navigation: the fleet's, overridden by the drone's own."""
    return {**fleet.options.get(navigation_of(fleet, drone), {}), **drone.options}


def with_joined(app: App, fleet: FleetFile, joined: Sequence[Mapping[str, object]]) -> FleetFile:
    """Return the fleet with the drones that have joined it, each as it was given."""
    for data in joined:
        drone = joining_drone(app, fleet.airspace, fleet.navigation, fleet.drones, data)
        fleet = replace(fleet, drones=(*fleet.drones, drone))
    return fleet


def not_real(fleet: FleetFile) -> str | None:
    """Return why this fleet cannot be flown with real drones, if it cannot."""
    if all(drone.line is None for drone in fleet.drones):
        return errors.no_fleet_file()
    lost = [
        (drone.id, drone.line)
        for drone in fleet.drones
        if drone.uri is None and navigation_of(fleet, drone) == CRAZYFLIE
    ]
    return errors.no_uri(lost) if lost else None


def too_fast(app: App, fleet: FleetFile) -> list[str]:
    """Return a sentence for each category that is faster than its Crazyflies can follow."""
    named = [d for d in fleet.drones if d.line is not None and navigation_of(fleet, d) == CRAZYFLIE]
    flown, limit = {d.category for d in named}, fleet.motion.limit
    return [
        errors.too_fast(category.name, category.speed, limit)
        for category in app.categories
        if fleet.motion.smooth and category.name in flown and category.speed > limit
    ]


def shared_by_air(fleet: FleetFile) -> list[str]:
    """Return a sentence for each way in which its Crazyflies are in each other's way on the air."""
    flown = [one for one in fleet.drones if navigation_of(fleet, one) == CRAZYFLIE]
    cameras: dict[str, list[str]] = {}
    for one in flown:
        cameras.setdefault(f"{options_of(fleet, one).get('camera', '')}", []).append(one.id)
    return [
        *crowded_air({one.id: address_of(one.uri) for one in flown if one.uri}),
        *(
            errors.shared_camera(drones, where)
            for where, drones in cameras.items()
            if where and len(drones) > 1
        ),
    ]
