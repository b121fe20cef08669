"""Missions and a fleet as the files that a person would write: what shows a mistake again."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..fields import Entity, FieldType
from ..model import Mission, Trip

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..model import Point
    from ..simulation.world import WorldData


def missions_text(app: App, missions: Sequence[Mission[Any]]) -> str:
    """Return the missions file."""
    return "\n".join(line for mission in missions for line in _mission(app, mission)) + "\n"


def fleet_text(fleet: FleetFile) -> str:
    """Return the fleet file."""
    return "\n".join(_fleet(fleet)) + "\n"


def _mission(app: App, mission: Mission[Any]) -> Iterator[str]:
    yield "[[mission]]"
    yield f"name = {_text(mission.name)}"
    yield from _fields(app, Entity.MISSION, mission)
    for trip in mission.trips:
        yield ""
        yield "[[mission.trip]]"
        yield f"name = {_text(trip.name)}"
        yield f"action = {_text(trip.action)}"
        if trip.source is not None:
            yield f"source = {_point(trip.source)}"
        yield f"target = {_point(trip.target)}"
        if trip.parameters:
            yield f"parameters = {_table(trip.parameters)}"
        if trip.item is not None:
            yield f"item = {_table({'name': trip.item.name, 'mass': trip.item.mass})}"
        yield from _fields(app, Entity.TRIP, trip)
    yield ""


def _fields(app: App, entity: Entity, of: Mission[Any] | Trip) -> Iterator[str]:
    for field in app.fields:
        value = getattr(of, field.name) if field.on is entity else None
        if value is None:
            continue
        if field.type is FieldType.TIME_OF_DAY:
            minutes = round(value / 60)
            yield f'{field.name} = "{minutes // 60:02}:{minutes % 60:02}"'
        else:
            yield f"{field.name} = {_value(value)}"


def _fleet(fleet: FleetFile) -> Iterator[str]:
    airspace = fleet.airspace
    yield "[map]"
    yield f"size = {_list(airspace.size)}"
    yield f"cruise_height = {float(airspace.cruise_height)!r}"
    yield f"ceiling = {float(airspace.ceiling)!r}"
    if airspace.no_fly:
        areas = ", ".join(f"[{', '.join(map(_list, area))}]" for area in airspace.no_fly)
        yield f"no_fly = [{areas}]"
    yield ""
    yield "[fleet]"
    yield f"after_trip = {_text(fleet.after_trip.value)}"
    yield f"apart = {float(fleet.apart)!r}"
    if fleet.max_airborne is not None:
        yield f"max_airborne = {fleet.max_airborne}"
    for drone in fleet.drones:
        yield ""
        yield "[[drone]]"
        yield f"id = {_text(drone.id)}"
        yield f"category = {_text(drone.category)}"
        yield f"home = {_list(drone.home[:2])}"
    if fleet.world is not None:
        yield from _world(fleet.world)


def _world(world: WorldData) -> Iterator[str]:
    yield ""
    yield "[world.background]"
    for quantity, value in world.background.items():
        yield f"{_text(quantity)} = {value!r}"
    for source in world.sources:
        yield ""
        yield "[[world.source]]"
        yield f"quantity = {_text(source.quantity)}"
        yield f"at = {_list(source.at)}"
        yield f"peak = {float(source.peak)!r}"
        yield f"radius = {float(source.radius)!r}"
    for feature in world.features:
        yield ""
        yield "[[world.feature]]"
        yield f"kind = {_text(feature.kind)}"
        yield f"at = {_list(feature.at)}"
        yield f"radius = {float(feature.radius)!r}"


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return _text(value) if isinstance(value, str) else repr(value)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)  # what JSON escapes, TOML escapes alike


def _point(point: Point) -> str:
    return _list(point)


def _list(values: Sequence[float]) -> str:
    return f"[{', '.join(repr(float(value)) for value in values)}]"


def _table(values: Mapping[str, object]) -> str:
    return "{ " + ", ".join(f"{name} = {_value(value)}" for name, value in values.items()) + " }"
