"""Writing fleets and missions as files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..jobs.reports import SILENCE
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.motion import CRAZYFLIE as CRAZYFLIE_MOTION
from ..shared.domain.motion import motion_of
from ..shared.domain.values import MOTION
from .fleet import CRAZYFLIE, OWN
from .landmarks_text import landmark_tables
from .toml import toml_text

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.fleet_data import WorldData
    from ..shared.domain.model import Mission, Trip
    from ..shared.domain.motion import Motion
    from .fleet import DroneEntry, FleetFile


def fleet_text(fleet: FleetFile) -> str:
    """Return the fleet file, without its floor plan, which lies beside the file that names it."""
    airspace = fleet.airspace
    of_map: dict[str, Any] = {
        "size": _floats(airspace.size),
        "cruise_height": float(airspace.cruise_height),
        "ceiling": float(airspace.ceiling),
    }
    if airspace.no_fly:
        of_map["no_fly"] = [[_floats(corner) for corner in area] for area in airspace.no_fly]
    shown = {"north": float(fleet.landmarks.north), **landmark_tables(fleet.landmarks)}
    of_map |= {key: value for key, value in shown.items() if value}
    behaviour: dict[str, Any] = {
        "after_trip": fleet.after_trip.value,
        "apart": float(fleet.apart),
        "max_airborne": fleet.max_airborne,
        "silence": None if fleet.silence == SILENCE else fleet.silence,
        "charges_at_home": None if fleet.charges_at_home else False,
        "navigation": None if fleet.navigation == CRAZYFLIE else fleet.navigation,
        "localization": None if fleet.localization == OWN else fleet.localization,
    }
    file: dict[str, Any] = {
        "map": of_map,
        "fleet": _given(behaviour),
        "motion": motion_data(fleet.motion) or None,
        "localization": fleet.localization_options or None,
        "navigation": fleet.options or None,
        "drone": [_drone(drone) for drone in fleet.drones],
        "world": None if fleet.world is None else _world(fleet.world),
    }
    return toml_text(_given(file))


def motion_data(motion: Motion) -> dict[str, Any]:
    """Return the `[motion]` of a fleet file: what differs from its defaults."""
    data, usual = asdict(motion), asdict(motion_of({"legs": motion.legs}))
    usual["legs"] = CRAZYFLIE_MOTION.legs
    return {key: data[key] for key in MOTION if data[key] != usual[key]}


def _drone(drone: DroneEntry) -> dict[str, Any]:
    return _given(
        {
            "id": drone.id,
            "category": drone.category,
            "home": _floats(drone.home if drone.home[2] else drone.home[:2]),
            "uri": drone.uri,
            "navigation": drone.navigation,
            "options": drone.options or None,
            "parameters": dict(drone.parameters) or None,
        }
    )


def _world(world: WorldData) -> dict[str, Any]:
    return {
        "background": {**world.background},
        "source": [asdict(source) | {"at": [*source.at]} for source in world.sources],
        "feature": [asdict(feature) | {"at": [*feature.at]} for feature in world.features],
    }


def _floats(numbers: Sequence[float]) -> list[float]:
    return [float(number) for number in numbers]


def _given(table: dict[str, Any]) -> dict[str, Any]:
    """Leave out what is not given."""
    return {key: value for key, value in table.items() if value is not None}


def missions_text(app: App, missions: Sequence[Mission[Any]]) -> str:
    """Return the missions file."""
    return toml_text({"mission": [mission_table(app, mission) for mission in missions]})


def mission_table(app: App, mission: Mission[Any]) -> dict[str, Any]:
    """Return one mission of a missions file."""
    trips = [trip_table(app, trip) for trip in mission.trips]
    fields = {**_promises(mission), **_fields(app, Entity.MISSION, mission)}
    return {"name": mission.name, **fields, "trip": trips}


def _promises(mission: Mission[Any]) -> dict[str, Any]:
    """Return what is promised of a mission as a file says it."""
    said = mission.promises
    when = {} if "deadline" not in said else {"deadline": said["deadline"]}
    if "opens" in said:
        when = {"window": [said["opens"], said["deadline"]]}
    return when | ({"after": [*said["after"]]} if "after" in said else {})


def trip_table(app: App, trip: Trip) -> dict[str, Any]:
    """Return one trip of a missions file."""
    table: dict[str, Any] = {"name": trip.name, "action": trip.action}
    if trip.source is not None:
        table["source"] = [float(along) for along in trip.source]
    table["target"] = [float(along) for along in trip.target]
    table.update(_fields(app, Entity.TRIP, trip))
    if trip.parameters:
        table["parameters"] = {**trip.parameters}
    if trip.item is not None:
        table["item"] = {"name": trip.item.name, "mass": trip.item.mass}
    return table


def _fields(app: App, entity: Entity, of: Mission[Any] | Trip) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    for field in app.fields:
        given = getattr(of, field.name) if field.on is entity else None
        if given is not None and field.type is FieldType.TIME_OF_DAY:
            minutes = round(given / 60)
            fields[field.name] = f"{minutes // 60:02}:{minutes % 60:02}"
        elif given is not None:
            fields[field.name] = given
    return fields
