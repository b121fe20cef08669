"""Missions, a fleet and mishaps at random, made so that much falls on the same instant.

Everything stands on a grid of half metres and drones fly half a metre or a metre a second: so two
flights often end together, and a limit often falls on the very end of a flight.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.model import AfterTrip, Item, Mission, Point, Trip
from pluto_fleet.shared.domain.motion import STRAIGHT, Motion
from pluto_fleet.shared.events.world import Mover
from plutoc.emit.model_file import fields_of, own_field
from plutoc.graph.model import Graph
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status
from plutoc_runtime.events.declared import AlongField, TrackField

Plain = bool | int | float | str | None | dict[str, str | float]
TIMES = (0.0, 0.5, 2.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0, 17.0, 21.0, 25.0, 30.0, 60.0)
WALKERS = WorldData(
    movers=(
        Mover(name="t1", kind="person", path=((1.0, 0.5), (7.0, 1.5)), speed=0.25, repeat=True),
        Mover(name="t2", kind="dog", path=((8.0, 1.5), (1.0, 0.5)), speed=0.5, starts=5.0),
    )
)
TRACKS = (None, None, "t1", "t2", "t3")
"""What a trip follows; the last one is never seen."""
LIMITS = ("safe_time", "gap", "deadline")
OF_A_PURSUIT = ("reach", "lost_after")
"""The fields that trips have as they are."""
BUILT_IN = ("take_photo", "take_photo", "measure")
ITEM = Item(name="pills", mass=0.004)


@dataclass(frozen=True, slots=True, kw_only=True)
class TripPlan:
    """A trip to be flown."""

    name: str
    action: str
    target: Point
    source: Point | None = None
    parameters: Mapping[str, bool | int | float | str] = field(default_factory=dict)
    fields: Mapping[str, Plain] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionPlan:
    """A mission to be flown."""

    name: str
    trips: tuple[TripPlan, ...]
    fields: Mapping[str, Plain] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """All that a run depends on besides the app; a plain value that can be printed."""

    seed: int
    missions: tuple[MissionPlan, ...]
    homes: tuple[tuple[str, Point], ...]
    """A category and a place for each drone."""
    after_trip: AfterTrip
    max_airborne: int | None
    faults: Faults
    until: float
    entry: tuple[str, Status] | None = None
    """The block where the missions go on, as if they had been interrupted, and how they stand."""
    motion: Motion = STRAIGHT
    walkers: bool = False
    """Something moves."""

    @property
    def fleet(self) -> FleetFile:
        """The fleet file."""
        drones = [
            DroneEntry(id=f"cf{number}", category=category, home=home)
            for number, (category, home) in enumerate(self.homes, start=1)
        ]
        return FleetFile(
            airspace=Airspace(),
            drones=tuple(drones),
            after_trip=self.after_trip,
            max_airborne=self.max_airborne,
            motion=self.motion,
            world=WALKERS if self.walkers else None,
        )

    @property
    def limits(self) -> tuple[float, ...]:
        """Times from a trip's start at which it may be over for another reason."""
        found: dict[float, None] = {}
        for mission in self.missions:
            for trip in mission.trips:
                safe, gap = mission.fields.get("safe_time"), trip.fields.get("gap")
                delay = trip.fields.get("delay") or 0.0
                since = gap - delay if isinstance(gap, float) and isinstance(delay, float) else None
                found |= dict.fromkeys(t for t in (safe, gap, since) if isinstance(t, float))
        return tuple(found) or (7.0, 12.0)

    def made(self, app: App) -> list[Mission[Any]]:
        """Return the missions, fresh, as this app has them."""
        return [_mission(app, place, mission) for place, mission in enumerate(self.missions)]


def _mission(app: App, place: int, mission: MissionPlan) -> Mission[Any]:
    trips = [_trip(app, number, trip) for number, trip in enumerate(mission.trips)]
    fields: Mapping[str, Any] = mission.fields
    return app.mission(name=mission.name, index=place, trips=trips, **fields)


def _trip(app: App, place: int, trip: TripPlan) -> Trip:
    carries = trip.action in ("pick_item", "release_item")
    return app.trip(
        name=trip.name,
        action=trip.action,
        target=trip.target,
        source=trip.source,
        index=place,
        parameters=dict(trip.parameters),
        item=ITEM if carries else None,
        **trip.fields,
    )


def random_world(rng: Random, graph: Graph, times: Sequence[float] = TIMES) -> World:
    """Return a world for an app, with these times for its delays and limits."""
    drawing = _World(rng, graph, times)
    drones, missions = rng.choice((1, 2, 2, 3, 4, 6)), rng.choice((1, 2, 2, 3, 4))
    return World(
        seed=rng.randrange(1000),
        missions=tuple(drawing.mission(number) for number in range(1, missions + 1)),
        homes=tuple(drawing.home(number) for number in range(drones)),
        after_trip=rng.choice((AfterTrip.HOME, AfterTrip.HOME, AfterTrip.STAY, AfterTrip.NEXT)),
        max_airborne=rng.choice((None, None, None, 1, 2)),
        faults=drawing.faults(),
        until=rng.choice((150.0, 400.0, 900.0)),
        walkers=graph.reacts,
    )


FOLLOWED = (4.0, 4.0, 400.0)
"""Seconds for which something is followed: the last one is more than a battery lasts."""
OWN_VALUES: dict[object, tuple[Plain, ...]] = {
    Type.TEXT: ("", "a text"),
    Type.INT: (0, 3),
    Type.BOOL: (True, False),
    Type.PERCENT: (0.0, 0.5, 1.0),
}


class _World:
    def __init__(self, rng: Random, graph: Graph, times: Sequence[float]) -> None:
        self.rng, self.graph, self.times = rng, graph, times
        self.on_a_line = rng.random() < 0.5
        """Every flight takes whole or half seconds: no sum of times is rounded."""
        self.spots = [self.spot() for _ in range(rng.choice((1, 2, 4)))]
        self.limit: float | None = None
        """All limits of the mission, if they are to fall on one instant."""
        self.fields = fields_of(graph)
        self.own = tuple(map(own_field, graph.fields))
        own = tuple(one.name for one in graph.actions if one.name not in graph.along)
        follow = ("follow",) if graph.follows else ()
        wanted = (*BUILT_IN, *follow, *own, *own)
        known = [each.actions for each in graph.categories]
        able = [name for name in wanted if any(can is None or name in can for can in known)]
        self.actions = (able or wanted) if rng.random() < 0.95 else wanted

    def spot(self) -> Point:
        if self.on_a_line:
            return self.rng.randrange(1, 16) / 2, 0.5, 1.2
        y = 0.5 if self.rng.random() < 0.7 else self.rng.choice((1.5, 2.5, 4.0))
        return self.rng.randrange(1, 16) / 2, y, self.rng.choice((1.2, 1.2, 1.2, 0.6))

    def home(self, number: int) -> tuple[str, Point]:
        category = self.graph.categories[number % len(self.graph.categories)].name
        return category, (float(number + 1), 0.5, 0.0)

    def faults(self) -> Faults:
        if self.rng.random() < 0.35:
            return Faults()
        shares = (0.0, 0.0, 0.05, 0.2)
        names = ("crash", "link", "action", "battery")
        return Faults(**{name: self.rng.choice(shares) for name in names})

    def mission(self, number: int) -> MissionPlan:
        name = f"m{number}"
        several = sum(each.name in LIMITS for each in self.fields) > 1
        together = self.rng.random() < (0.7 if several else 0.3)
        self.limit = (
            self.rng.choice([time for time in TIMES if 0 < time < 12]) if together else None
        )
        trips: list[TripPlan] = []
        for place in range(1, self.rng.choice((1, 2, 2, 3, 4)) + 1):
            trips += self.trips(f"{name}.{place}")
        return MissionPlan(name=name, trips=tuple(trips), fields=self.values(Entity.MISSION))

    def trips(self, name: str) -> list[TripPlan]:
        if self.rng.random() < 0.08:
            return [self.trip(f"{name}{what[0]}", what) for what in ("pick_item", "release_item")]
        return [self.trip(name, self.rng.choice(self.actions))]

    def trip(self, name: str, action: str) -> TripPlan:
        there = self.rng.random() < 0.5
        return TripPlan(
            name=name,
            action=action,
            target=self.rng.choice(self.spots) if there else self.spot(),
            source=self.spot() if self.rng.random() < 0.1 else None,
            parameters=self.parameters(action),
            fields=self.values(Entity.TRIP),
        )

    def parameters(self, name: str) -> dict[str, bool | int | float | str]:
        if name == "measure":
            return {"quantity": "temperature"}
        if name == "follow":
            return {"for": self.rng.choice(FOLLOWED), "every": 4.0}
        declared = [
            p for action in self.graph.actions if action.name == name for p in action.parameters
        ]
        return {p.name: "wide" if p.type is Type.TEXT else 0.04 for p in declared}

    def values(self, entity: Entity) -> dict[str, Plain]:
        luck = Random(f"{entity.value}/{self.rng.getstate()[1][-1]}")
        own = {
            each.name: luck.choice(OWN_VALUES[each.type])
            for each in self.own
            if each.on is entity and (each.hint or luck.random() < 0.5)
        }
        given = {
            each.name: self.value(each)
            for each in self.fields
            if each.on is entity and each.name not in OF_A_PURSUIT and self.given(each)
        }
        return {**given, **own}

    def given(self, wanted: Field) -> bool:
        if self.limit is not None and wanted.name in LIMITS:
            return True
        return self.rng.random() < (0.6 if self.limit is None else 0.2)

    def value(self, wanted: Field) -> Plain:
        if isinstance(wanted, AlongField):
            action = self.rng.choice(wanted.actions)
            return {"action": action, **({} if action == "look" else {"seconds": 2.0})}
        if isinstance(wanted, TrackField):
            return self.rng.choice(TRACKS)
        match wanted.type:
            case FieldType.TIME | FieldType.TIME_OF_DAY:
                if self.limit is not None and wanted.name in LIMITS:
                    return self.limit
                return self.rng.choice(self.times)
            case FieldType.INT:
                return self.rng.choice((0, 0, 1, 2))
            case FieldType.ROUNDS:
                return self.rng.choice((0, 1, 1, 2, True))
            case FieldType.EVALUATOR:
                names = [hook.name for hook in self.graph.hooks if hook.kind.value == "evaluator"]
                return self.rng.choice((None, *names))
            case _:
                raise AssertionError(f"{wanted.name} is the app's own")
