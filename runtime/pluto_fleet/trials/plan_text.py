"""Missions as the file that a person would write: what shows a mistake again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.fields import Entity, FieldType
from plutoc_runtime.domain.model import Mission, Trip

from ..files.toml_text import numbers, text, value

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App


def missions_text(app: App, missions: Sequence[Mission[Any]]) -> str:
    """Return the missions file."""
    return "\n".join(line for mission in missions for line in _mission(app, mission)) + "\n"


def _mission(app: App, mission: Mission[Any]) -> Iterator[str]:
    yield "[[mission]]"
    yield f"name = {text(mission.name)}"
    yield from _fields(app, Entity.MISSION, mission)
    for trip in mission.trips:
        yield ""
        yield "[[mission.trip]]"
        yield f"name = {text(trip.name)}"
        yield f"action = {text(trip.action)}"
        if trip.source is not None:
            yield f"source = {numbers(trip.source)}"
        yield f"target = {numbers(trip.target)}"
        if trip.parameters:
            yield f"parameters = {value(trip.parameters)}"
        if trip.item is not None:
            yield f"item = {value({'name': trip.item.name, 'mass': trip.item.mass})}"
        yield from _fields(app, Entity.TRIP, trip)
    yield ""


def _fields(app: App, entity: Entity, of: Mission[Any] | Trip) -> Iterator[str]:
    for field in app.fields:
        given = getattr(of, field.name) if field.on is entity else None
        if given is None:
            continue
        if field.type is FieldType.TIME_OF_DAY:
            minutes = round(given / 60)
            yield f'{field.name} = "{minutes // 60:02}:{minutes % 60:02}"'
        else:
            yield f"{field.name} = {value(given)}"
