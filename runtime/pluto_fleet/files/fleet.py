"""The fleet file: the map, its drones, and the simulated world (docs/files.md)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import cycle, islice
from pathlib import Path
from typing import TYPE_CHECKING

from ..jobs.reports import SILENCE
from ..shared.alone.files import (
    FLEET,
    read_behaviour,
    read_map,
    read_motion,
    read_world,
)
from ..shared.domain import values
from ..shared.domain.airspace import Airspace
from ..shared.domain.fleet_data import FleetData
from ..shared.domain.motion import CRAZYFLIE as CRAZYFLIE_MOTION
from ..shared.domain.quantities import Type
from ..shared.domain.text import number, quoted
from .addresses import SUCH_AS, address_of, crowded_air
from .drones import CRAZYFLIE, DroneEntry, drones_of, joining_drone
from .landmarks import NO_LANDMARKS, Landmarks, read_landmarks
from .options import Options, navigation_options, options_in
from .reading import Document, listed, read, top

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.model import Point
    from .options import Options


APART = 0.5
"""Metres: two Crazyflies closer than this disturb each other with their downwash."""

BETWEEN = values.Quantity(Type.LENGTH, 0.05, 10.0, or_none=True)
"""What may lie between two drones."""

OWN = "own"
"""The default localization: the drones' own."""


QUIET = values.Quantity(Type.TIME, 1.0, 30.0)
"""How long a drone in the air may tell nothing."""


_REAL: dict[str, values.Read] = {
    "apart": BETWEEN,
    "silence": QUIET,
    "navigation": values.name,
    "localization": values.name,
}
"""How the keys of `[fleet]` are read that only real flights need."""


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
    whole = top(document, FLEET)
    on_map = whole.table("map")
    behaviour = whole.table("fleet")
    airspace = read_map(on_map)
    given = {
        **read_behaviour(behaviour),
        **{
            key: value
            for key, read in _REAL.items()
            if (value := behaviour.value(key, read)) is not None
        },
    }
    flown_by = given.get("navigation", CRAZYFLIE)
    drones = drones_of(whole, app, airspace, flown_by)
    if "localization" in whole.data and given.get("localization", OWN) == OWN:
        said = "is for a source of positions that [fleet] names with localization = …"
        whole.problem(f"[localization] {said}; here each drone finds its own", "localization")
    used = [*dict.fromkeys([flown_by, *(one.navigation for one in drones if one.navigation)])]
    fleet = FleetFile(
        **given,
        airspace=airspace or Airspace(),
        landmarks=read_landmarks(on_map, airspace),
        motion=read_motion(whole),
        options=navigation_options(whole, used),
        localization_options=options_in(whole.table("localization")),
        drones=drones,
        world=read_world(whole),
    )
    document.refuse_if_bad()
    return fleet


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
        return (
            "real drones are named in a fleet file: give it with --fleet;"
            " the command drones --save F.toml writes one of those that the radio hears"
        )
    lost = [
        f"{quoted(drone.id)} (line {drone.line})" if drone.line else quoted(drone.id)
        for drone in fleet.drones
        if drone.uri is None and navigation_of(fleet, drone) == CRAZYFLIE
    ]
    if not lost:
        return None
    one = len(lost) == 1
    return (
        f"{'drone' if one else 'drones'} {listed(lost)} {'has' if one else 'have'} no uri, where a real"
        f" drone is reached: add {'one' if one else 'one to each'}, such as uri = {quoted(SUCH_AS)}"
    )


def too_fast(app: App, fleet: FleetFile) -> list[str]:
    """Return a sentence for each category that is faster than its Crazyflies can follow."""
    named = [d for d in fleet.drones if d.line is not None and navigation_of(fleet, d) == CRAZYFLIE]
    flown, limit = {d.category for d in named}, fleet.motion.limit
    return [
        f"drones of the category {quoted(category.name)} fly at up to {number(category.speed)} m/s: a"
        f" Crazyflie follows no course faster than {number(limit)} m/s as its firmware comes, and will"
        " not take off; lower the speed, or set its posCtlPid.xVelMax and yVelMax"
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
            f"{listed(drones)} have one camera, {where}: the photos of all would be those of whichever"
            " AI-deck this computer reaches; have all decks join one WiFi, and give each drone its own"
            " address"
            for where, drones in cameras.items()
            if where and len(drones) > 1
        ),
    ]
