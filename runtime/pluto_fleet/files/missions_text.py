"""Writing missions as a missions file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..shared.domain.fields import Entity, FieldType
from .toml import toml_text

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.model import Mission, Trip


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
