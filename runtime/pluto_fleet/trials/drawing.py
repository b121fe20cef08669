"""Missions at random, small, for an app whose own are not there: they fit its fields and actions."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import PICK, RELEASE, Plain
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.model import Item
from plutoc_runtime.domain.quantities import Type

from ..files.plan_check import problems

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission, Point, Trip

    from ..files.fleet import FleetFile

TRIES = 50
"""So often is a mission drawn until the fleet can fly it."""

_TIMES = (0.0, 2.0, 5.0, 12.0, 30.0)
_VALUES: dict[Type, Plain] = {
    Type.INT: 1,
    Type.BOOL: True,
    Type.TEXT: "x",
    Type.MASS: 0.001,
    Type.PERCENT: 0.5,
    Type.TEMPERATURE: 293.15,
}
"""What is given where an action has no default; any other number is 1."""


def drawn_missions(app: App, fleet: FleetFile, seed: int) -> list[Mission[Any]]:
    """Return up to three missions of up to three trips that the fleet can fly, by a seed."""
    drawing = _Drawing(app, fleet, Random(f"{seed}/missions"))
    missions: list[Mission[Any]] = []
    for _ in range(drawing.rng.choice((1, 2, 2, 3))):
        for _ in range(TRIES):
            mission = drawing.mission(len(missions))
            if not problems([mission], app, fleet, fleet.airspace):
                missions.append(mission)
                break
    return missions


class _Drawing:
    def __init__(self, app: App, fleet: FleetFile, rng: Random) -> None:
        self.app, self.fleet, self.rng = app, fleet, rng
        self.width, self.depth = fleet.airspace.size

    def mission(self, index: int) -> Mission[Any]:
        trips: list[Trip] = []
        for _ in range(self.rng.choice((1, 2, 2, 3))):
            self.add(trips)
        mission = self.app.mission(name=f"m{index + 1}", index=index, trips=trips)
        self.fill(mission, Entity.MISSION)
        return mission

    def add(self, trips: list[Trip]) -> None:
        action = self.rng.choice([name for name in self.app.actions if name != RELEASE])
        payload = min((c.payload for c in self.app.categories if c.can(PICK)), default=0.001)
        item = Item(name=f"item{len(trips) + 1}", mass=round(payload / 2, 6))
        for name in (PICK, RELEASE) if action == PICK else (action,):
            place = len(trips)
            carries = item if action == PICK else None
            trips.append(self.trip(place, name, carries))

    def trip(self, place: int, action: str, item: Item | None) -> Trip:
        given = {
            parameter.name: (
                _VALUES.get(parameter.type, 1.0) if parameter.default is None else parameter.default
            )
            for parameter in self.app.actions[action].parameters
        }
        trip = self.app.trip(
            name=str(place + 1),
            action=action,
            target=self.spot(),
            source=self.spot() if self.rng.random() < 0.1 else None,
            parameters=given,
            item=item,
            index=place,
        )
        self.fill(trip, Entity.TRIP)
        return trip

    def spot(self) -> Point:
        airspace = self.fleet.airspace
        for _ in range(TRIES):
            x, y = (
                round(self.rng.uniform(0.3, side - 0.3), 1) for side in (self.width, self.depth)
            )
            spot = (x, y, airspace.cruise_height)
            if airspace.problem(spot) is None:
                break
        return spot

    def fill(self, entity: Mission[Any] | Trip, kind: Entity) -> None:
        for field in self.app.fields:
            if field.on is kind and self.rng.random() < 0.6:
                setattr(entity, field.name, self.value(field))

    def value(self, field: Field) -> object:
        match field.type:
            case FieldType.TIME:
                return self.rng.choice(_TIMES)
            case FieldType.TIME_OF_DAY:
                return 60.0 * self.rng.randrange(3)
            case FieldType.EVALUATOR:
                return self.rng.choice((None, *self.app.evaluators))
            case _:
                return self.rng.randrange(3)
