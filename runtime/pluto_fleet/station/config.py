"""The configuration of a station, and the constant data of app and fleet for pages."""

from __future__ import annotations

import json
from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.own_fields import OwnField
from ..shared.domain.quantities import QUANTITIES, Type, units_of
from ..shared.events.declared import AlongField, EventsDeclared
from .map.drawn import WITHOUT_A_FLEET_FILE
from .results.meaning import SIMULATED_UNITS, Meanings

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..files.stand_ins import StandIns
    from ..shared.domain.actions import Action, Parameter
    from ..shared.domain.fields import Field
    from ..shared.domain.model import Category
    from .map.drawn import DrawnMap
    from .map.pictures import Logo
    from .wire import Layer
    from .wire_app import (
        ActionData,
        AppData,
        CategoryData,
        EventData,
        FieldData,
        GraphData,
        ParameterData,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class StationConfig:
    """The configuration of a station."""

    folder: Path
    """The folder of journals; the station's own files are in its subfolder `station`."""
    fleet: FleetFile
    fleet_text: str | None = None
    fleet_path: Path | None = None
    sim: bool = True
    stand_ins: StandIns | None = None
    """The drones that are simulated down to their protocol, and flown as real ones, or None."""
    seed: int = 0
    faults: Mapping[str, float]
    speed: float | None = None
    """The speed of time; None: real time, or as before."""
    title: str | None = None
    logo: Logo | None = None

    @property
    def map_path(self) -> Path:
        """The file into which is written what is drawn on the map."""
        return self.fleet_path or self.own_folder / WITHOUT_A_FLEET_FILE

    @property
    def own_folder(self) -> Path:
        """The folder of the station's own files."""
        return self.folder / "station"


def described(app: App, config: StationConfig, drawn: DrawnMap, server: str) -> AppData:
    """Return the data of app, fleet and map, with the fields and actions that this app has.

    `server` is this run of the station; what was drawn on the map may change.
    """
    graph = _graph(app)
    space = config.fleet.airspace
    return {
        "name": app.name,
        "title": config.title or app.title or app.name,
        "logo": config.logo.address if config.logo is not None else None,
        "server": server,
        "role": "fly",
        "sim": config.sim or config.stand_ins is not None,
        "speed": config.speed or 1.0,
        "fields": {
            "mission": [_field(one, app.actions) for one in app.fields if one.on is Entity.MISSION],
            "trip": [_field(one, app.actions) for one in app.fields if one.on is Entity.TRIP],
        },
        "evaluators": list(app.evaluators),
        "layers": layers(app, config.sim),
        "events": _events(app),
        "actions": [_action(action) for action in app.actions.values() if _can(app, action)],
        "categories": [_category(category) for category in app.categories],
        "drones": [
            {"id": entry.id, "category": entry.category, "home": list(entry.home)}
            for entry in config.fleet.drones
        ],
        "map": {
            "size": list(space.size),
            "cruise_height": space.cruise_height,
            "ceiling": space.ceiling,
            "no_fly": [[list(corner) for corner in area] for area in space.no_fly],
            "image": drawn.address if drawn.image is not None else None,
        },
        "retries": _retries(graph),
        "rounds": any(field.type is FieldType.ROUNDS for field in app.fields),
        "graph": graph,
    }


def layers(app: App, sim: bool) -> list[Layer]:
    """Return the layers of the map for the results of all that this app's drones can do."""
    able = [name for name, action in app.actions.items() if _can(app, action)]
    return Meanings(app.results, able, SIMULATED_UNITS if sim else {}).layers


def _field(field: Field, built_in: Container[str]) -> FieldData:
    kind = field.type
    data: FieldData = {
        "name": field.name,
        "type": kind.value,
        "label": field.label,
        "default": field.default,
    }
    if isinstance(kind, Type):
        data["units"] = _units(kind)
    if isinstance(field, OwnField):
        data["own"] = True
        data["needed"] = bool(field.hint)
    if isinstance(field, AlongField):
        data["actions"] = list(field.actions)
        data["spaced"] = [name for name in field.actions if name in built_in]
    return data


def _can(app: App, action: Action) -> bool:
    return any(category.can(action.name) for category in app.categories)


def _action(action: Action) -> ActionData:
    return {
        "name": action.name,
        "item": action.name in (PICK, RELEASE),
        "parameters": _parameters(action.parameters),
    }


def _parameters(given: Iterable[Parameter]) -> list[ParameterData]:
    return [
        {
            "name": one.name,
            "type": one.type.value,
            "units": _units(one.type),
            "default": one.default,
        }
        for one in given
    ]


def _events(app: App) -> list[EventData]:
    declared = [part for part in app.parts if isinstance(part, EventsDeclared)]
    creates = {creator.event for part in declared for creator in part.creators}
    return [
        {"name": one.name, "fields": _parameters(one.fields), "creates": one.name in creates}
        for part in declared
        for one in part.types
    ]


def _units(kind: Type) -> list[str]:
    return list(units_of(kind)) if kind in QUANTITIES else []


def _category(category: Category) -> CategoryData:
    return {
        "name": category.name,
        "payload": category.payload,
        "speed": category.speed,
        "flight_time": category.flight_time,
        "actions": None if category.actions is None else sorted(category.actions),
    }


def _graph(app: App) -> GraphData | None:
    """Return the graph in the package of an app; one that plutoc has not written has none."""
    file = Path(app.flow.__code__.co_filename).with_name("graph.json")
    return json.loads(file.read_text("utf-8")) if file.is_file() else None


def _retries(graph: GraphData | None) -> bool:
    """Whether a failed trip may be retried: some edge of FAILED leads on."""
    if graph is None:
        return True
    onward = {one["name"] for one in graph["blocks"] if "kind" in one and "gate" not in one}
    return any("FAILED" in one["statuses"] and one["target"] in onward for one in graph["edges"])
