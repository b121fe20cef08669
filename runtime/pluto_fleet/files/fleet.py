"""The fleet file: the map, its drones, and the simulated world (docs/files.md)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date, time
from functools import partial
from itertools import cycle, islice
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, cast

from ..geodesy import LocalPlane
from ..jobs.reports import SILENCE
from ..shared.alone.files import (
    FLEET,
    read_behaviour,
    read_drones,
    read_map,
    read_motion,
    read_world,
)
from ..shared.domain import values
from ..shared.domain.airspace import Airspace
from ..shared.domain.errors import BadInput
from ..shared.domain.fleet_data import DroneData, FleetData
from ..shared.domain.motion import CRAZYFLIE as CRAZYFLIE_MOTION
from ..shared.domain.quantities import Type
from ..shared.domain.text import number, quoted
from ..shared.domain.values import Keys, Table
from ..wind import Wind
from .addresses import SUCH_AS, address_of, crowded_air, which
from .landmarks import NO_LANDMARKS, Landmarks, read_landmarks
from .reading import Document, PlanTable, listed, near, read, top
from .vehicle_addresses import SUCH_AS as VEHICLE_SUCH_AS
from .vehicle_addresses import is_vehicle, vehicle_address
from .weather import blown, read_wind

if TYPE_CHECKING:
    from ..app import App

CRAZYFLIE = "crazyflie"
"""The default navigation."""
MAVLINK = "mavlink"
"""The navigation of drones whose uri says that they speak MAVLink."""
APART = 0.5
"""Metres: two Crazyflies closer than this disturb each other with their downwash."""

BETWEEN = values.Quantity(Type.LENGTH, 0.05, 100.0, or_none=True)
"""What may lie between two drones."""

OWN = "own"
"""The default localization: the drones' own."""

QUIET = values.Quantity(Type.TIME, 1.0, 30.0)
"""How long a drone in the air may tell nothing."""

_REAL: Keys = {
    "apart": BETWEEN,
    "silence": QUIET,
    "navigation": values.name,
    "localization": values.name,
    "tracker": values.name,
}
"""How the keys of `[fleet]` are read that only real flights need."""

DEFAULT_SIZE, ROW = 5, 18
"""Drones of the default fleet, and how many stand in a row."""


# What a navigation is told

Options = Mapping[str, object]
"""Texts, numbers, booleans, and lists and tables of these."""

DEEPEST = 8
"""The deepest nesting of tables and lists, which are sent to another process as JSON."""

_LARGEST_WHOLE = 2**63


def options_in(table: Table) -> Options:
    """Return a table's options; what JSON cannot hold is noted."""
    return table.read({}, dict.fromkeys(table.data, plain))


def navigation_options(top: Table, used: Sequence[str]) -> Mapping[str, Options]:
    """Return the tables `[navigation.NAME]` by name; one that no drone uses is noted."""
    every = top.table("navigation")
    for name in every.data:
        if name not in used:
            every.who = f"[navigation.{name}]"
            hint = near(name, used) or f"; in this fleet there is: {listed(used)}"
            every.problem(f"nothing is flown by a navigation {quoted(name)}{hint}", name)
    return {name: options_in(every.table(name)) for name in every.data if name in used}


def plain(value: object) -> object:
    """Return a value, if JSON can hold it without change."""
    for part, depth in _parts(value, 1):
        if depth > DEEPEST:
            raise ValueError("is nested too deep")
        if said := _no_json(part):
            raise ValueError(said if part is value else f"has an element that {said}")
    return value


def _parts(value: object, depth: int) -> Iterator[tuple[object, int]]:
    yield value, depth
    inner = value.values() if isinstance(value, dict) else value
    if isinstance(value, dict | list) and depth <= DEEPEST:
        for part in cast("Iterable[object]", inner):
            yield from _parts(part, depth + 1)


def _no_json(value: object) -> str:
    if isinstance(value, date | time):
        return "is a date or a time: put it in quotes"
    if isinstance(value, float) and not isfinite(value):
        return "is not a finite number"
    return "is too large" if isinstance(value, int) and abs(value) >= _LARGEST_WHOLE else ""


# Drones


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEntry(DroneData):
    """A drone of the fleet file, with how a real one is flown."""

    uri: str | None = None
    """The address of a real one, in its navigation's format."""
    navigation: str | None = None
    """How it is flown; None: as the fleet is."""
    options: Options = field(default_factory=dict)
    """Options for its navigation, which override the fleet's."""
    parameters: Mapping[str, float] = field(default_factory=dict)
    """What it is set to when it is connected to, by the names of its firmware."""
    line: int | None = None


def drones_of(
    top: PlanTable, app: App, airspace: Airspace | None, flown_by: str
) -> tuple[DroneEntry, ...]:
    """Return the drones of a fleet; `flown_by`: how it is flown, where a drone says nothing of that."""
    drones = list[DroneEntry]()
    uris = dict[str, Table]()
    for table, given in read_drones(top, app, airspace):
        navigation = table.value("navigation", values.name) or navigation_by(table.data.get("uri"))
        uri = table.value("uri", partial(_uri, navigation or flown_by))
        _answers_alone(table, uris)
        real = {
            "uri": uri,
            "navigation": navigation,
            "options": options_in(table.table("options")),
            "parameters": table.value("parameters", _parameters) or {},
        }
        drones.append(DroneEntry(**given, **real, line=table.document.line(table.path)))
    return tuple(drones)


def joining_drone(
    app: App,
    airspace: Airspace,
    flown_by: str,
    drones: Sequence[DroneEntry],
    data: Mapping[str, object],
) -> DroneEntry:
    """Read a drone that joins these, given as in a fleet file; raise `BadInput` with all that is wrong."""
    others = [_known(one) for one in drones]
    document = Document("", {"drone": [*others, {**data}]})
    *_, drone = drones_of(PlanTable(document, document.data), app, airspace, flown_by)
    document.refuse_if_bad()
    if drone.home[2] != 0.0:  # what is known of ways from the docks on the ground would not hold
        raise BadInput(
            f"drone {quoted(drone.id)}: a drone that joins has its dock on the ground: home = [x, y]"
        )
    return drone


def _known(drone: DroneEntry) -> dict[str, object]:
    """Return a drone as a fleet file has it, by what no other one may have."""
    table = {"id": drone.id, "category": drone.category, "home": [*drone.home]}
    own = {"uri": drone.uri, "navigation": drone.navigation}
    return {**table, **{key: value for key, value in own.items() if value is not None}}


def _answers_alone(table: Table, uris: dict[str, Table]) -> None:
    uri = table.data.get("uri")
    if isinstance(uri, str):
        other = uris.setdefault(which(uri), table)
        if other is not table:
            said = f"uri is that of {other.who}{other.where('uri')}: it would be one and the same drone"
            table.problem(said, "uri")


def _parameters(value: object) -> Mapping[str, float]:
    """Read them; TOML makes tables of names with a point that are not in quotes."""
    if not isinstance(value, dict):
        raise ValueError(  # noqa: TRY004 - it is told with the key
            'is not a table: write { "locSrv.extPosStdDev" = 0.01 }'
        )
    return dict(_named(value, ""))


def _named(table: Mapping[str, object], group: str) -> Iterator[tuple[str, float]]:
    for key, value in table.items():
        name = f"{group}{key}"
        if isinstance(value, dict):
            yield from _named(value, f"{name}.")
            continue
        try:
            yield name, values.real(value)
        except ValueError as error:
            raise ValueError(f"sets {quoted(name)} to what {error}") from None


def navigation_by(uri: object) -> str | None:
    """Return the navigation that follows from a uri; None: as the fleet is flown."""
    return MAVLINK if isinstance(uri, str) and is_vehicle(uri) else None


def _uri(navigation: str, value: object) -> str:
    uri: str = values.name(value)
    if navigation == CRAZYFLIE:
        address_of(uri)
    elif navigation == MAVLINK:
        vehicle_address(uri)
    return uri


# Fleets


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
    tracker: str | None = None
    """What tells real drones what moves: a name, or `module:Class`."""
    tracker_options: Options = field(default_factory=dict)
    wind: Wind | None = None
    """That of a simulated world; `motion` counts with it."""

    @property
    def plane(self) -> LocalPlane | None:
        """Where the map lies on the Earth, if it says so."""
        return self.landmarks.plane


def default_fleet(app: App, size: int = DEFAULT_SIZE) -> FleetFile:
    """Return the fleet that is used without a file: five drones on an empty map."""
    drones = list[DroneEntry]()
    for place, category in enumerate(islice(cycle(app.categories), size)):
        row, column = divmod(place, ROW)
        home = (float(column + 1), 0.5 + row, 0.0)
        drones.append(DroneEntry(id=f"cf{place + 1}", category=category.name, home=home))
    return FleetFile(airspace=Airspace(), drones=tuple(drones), motion=CRAZYFLIE_MOTION)


def load_fleet(path: Path, app: App) -> FleetFile:
    """Load a fleet file; raise `BadInput` with everything that is wrong with it."""
    return fleet_of(read(path), app)


def fleet_of(document: Document, app: App) -> FleetFile:
    """Return the fleet of a file's text, as `load_fleet` does."""
    whole = top(document, FLEET)
    on_map = whole.table("map")
    airspace = read_map(on_map)
    given = read_behaviour(whole.table("fleet"), _REAL)
    flown_by = given.get("navigation", CRAZYFLIE)
    drones = drones_of(whole, app, airspace, flown_by)
    if "localization" in whole.data and given.get("localization", OWN) == OWN:
        said = "is for a source of positions that [fleet] names with localization = …"
        whole.problem(f"[localization] {said}; here each drone finds its own", "localization")
    if "tracker" in whole.data and "tracker" not in given:
        said = "is for what says where things move, which [fleet] names with tracker = …"
        whole.problem(f"[tracker] {said}", "tracker")
    landmarks = read_landmarks(on_map, airspace)
    motion = read_motion(whole)
    wind = read_wind(whole, motion)
    if wind is not None:
        motion = blown(motion, wind, landmarks.north, max(kind.speed for kind in app.categories))
    used = [*dict.fromkeys([flown_by, *(one.navigation for one in drones if one.navigation)])]
    fleet = FleetFile(
        **given,
        airspace=airspace or Airspace(),
        landmarks=landmarks,
        motion=motion,
        wind=wind,
        options=navigation_options(whole, used),
        localization_options=options_in(whole.table("localization")),
        tracker_options=options_in(whole.table("tracker")),
        drones=drones,
        world=read_world(whole, app.parts),
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
    by_degrees = [d.id for d in fleet.drones if navigation_of(fleet, d) == MAVLINK]
    if by_degrees and fleet.plane is None:
        return (
            f"{listed([quoted(id) for id in by_degrees])} fly by degrees: say where the map is, in [map]:"
            " origin = { latitude = 47.3977, longitude = 8.5456, altitude = 488 }"
        )
    lost = [
        f"{quoted(drone.id)} (line {drone.line})" if drone.line else quoted(drone.id)
        for drone in fleet.drones
        if drone.uri is None and navigation_of(fleet, drone) in _SUCH_AS
    ]
    if not lost:
        return None
    one = len(lost) == 1
    such = _SUCH_AS[CRAZYFLIE if fleet.navigation not in _SUCH_AS else fleet.navigation]
    return (
        f"{'drone' if one else 'drones'} {listed(lost)} {'has' if one else 'have'} no uri, where a real"
        f" drone is reached: add {'one' if one else 'one to each'}, such as uri = {quoted(such)}"
    )


_SUCH_AS = {CRAZYFLIE: SUCH_AS, MAVLINK: VEHICLE_SUCH_AS}


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


def moving_otherwise(fleet: FleetFile) -> list[str]:
    """Return a sentence if its MAVLink vehicles are counted with as if they were Crazyflies."""
    named = [d.id for d in fleet.drones if navigation_of(fleet, d) == MAVLINK]
    if not named or not fleet.motion.smooth:
        return []
    who = listed([quoted(id) for id in named])
    how = 'say how they move, by [motion] legs = "steady"'
    return [f"{who} would be counted with as Crazyflies, which fly at 1 m/s: {how}"]


def gusty(fleet: FleetFile) -> list[str]:
    """Return a sentence if gusts are more than its vehicles can fly against."""
    wind = fleet.wind
    most = fleet.motion.airspeed
    if wind is None or wind.speed + wind.gusts < most:
        return []
    strongest = number(wind.speed + wind.gusts)
    at_most = f"{number(most)} m/s through the air (airspeed of [motion])"
    return [f"gusts reach {strongest} m/s, and drones fly at up to {at_most}: they are blown away"]


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
