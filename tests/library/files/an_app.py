"""An app as plutoc would make it: two categories, every kind of field, an action of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pluto_fleet.app import described
from pluto_fleet.shared.domain.actions import BUILT_IN, Parameter
from pluto_fleet.shared.domain.app import App
from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.fields import Entity, Field, FieldType
from pluto_fleet.shared.domain.model import Category, Drone, Mission, Trip
from pluto_fleet.shared.domain.own_fields import OwnField
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.events.company import CompanyOf
from pluto_fleet.shared.events.declared import TRIP_FIELDS, AlongField
from pluto_fleet.shared.events.raising import EventsOf
from pluto_fleet.shared.events.tracks import TracksOf
from pluto_fleet.shared.fleet.policies import nearest
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Context
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_repeater.step import repeat_mission
from plutoc_blocks.priority_manager.step import raise_priority
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.step import watch_trip


@dataclass(slots=True, kw_only=True, eq=False)
class FieldTrip(Trip):
    delay: float | None = None
    priority: int = 0


@dataclass(slots=True, kw_only=True, eq=False)
class FieldMission(Mission[FieldTrip]):
    safe_time: float | None = None
    repeat: int | bool = 0
    at: float | None = None
    evaluator: str | None = None


async def fly_mission(run: Run[FieldMission]) -> Status:
    status = create_mission(run, Status.UNEXECUTED)
    while True:
        status = await allocate_drone(
            run, status, block="allocate", policy=nearest, allocate_within=None
        )
        status = await watch_trip(run, launch_trip(run, status))
        if status is Status.FAILED:
            trip = run.mission.current
            status = raise_priority(run, status, max_attempts=2, priority=trip.priority)
        if status is Status.COMPLETED:
            status = repeat_mission(run, status, repeat=run.mission.repeat)
        if status in (Status.COMPLETED, Status.FAILED):
            return status


async def pollinate(drone: Drone, trip: Trip, context: Context, *, dose: float, **_: Any) -> float:
    await context.sleep(2.0)
    if dose > 1.0:
        raise ActionFailed("the brush is not that large")
    return dose


def field(name: str, on: Entity, kind: FieldType) -> Field:
    return Field(name=name, on=on, type=kind, label=name, doc=name)


POLLINATE = OwnAction(
    name="pollinate",
    parameters=(
        Parameter(name="dose", type=Type.MASS),
        Parameter(name="gently", type=Type.BOOL, default=True),
        Parameter(name="strokes", type=Type.INT, default=3),
        Parameter(name="share", type=Type.PERCENT, default=0.5),
        Parameter(name="note", type=Type.TEXT, default=""),
        Parameter(name="force", type=Type.FLOAT, default=1.0),
    ),
    hook=pollinate,
)

APP = described(
    App(
        name="alfalfa",
        title="Alfalfa crop monitoring",
        flow=fly_mission,
        mission=FieldMission,
        trip=FieldTrip,
        fields=(
            field("safe_time", Entity.MISSION, FieldType.TIME),
            field("repeat", Entity.MISSION, FieldType.ROUNDS),
            field("at", Entity.MISSION, FieldType.TIME_OF_DAY),
            field("evaluator", Entity.MISSION, FieldType.EVALUATOR),
            field("delay", Entity.TRIP, FieldType.TIME),
            field("priority", Entity.TRIP, FieldType.INT),
        ),
        categories=(
            Category(name="scout", actions=frozenset({"take_photo", "measure"})),
            Category(
                name="carrier",
                payload=0.005,
                speed=0.8,
                actions=frozenset({"pick_item", "release_item", "pollinate"}),
            ),
        ),
        actions={**BUILT_IN, "pollinate": POLLINATE},
        evaluators={"find_blooms": lambda mission, results: None},
    )
)

PLAIN = described(
    App(
        name="plain",
        title="Plain",
        flow=fly_mission,
        mission=FieldMission,
        trip=FieldTrip,
        fields=(),
        categories=(Category(name="drone"),),
        actions=BUILT_IN,
    )
)
"""An app without fields, categories or hooks."""


@dataclass(slots=True, kw_only=True, eq=False)
class OwnTrip(Trip):
    delay: float | None = None
    fragile: bool
    note: str = ""
    layers: int = 1
    height_over_ground: float = 0.3
    warmth: float


@dataclass(slots=True, kw_only=True, eq=False)
class OwnMission(Mission[OwnTrip]):
    repeat: int | bool = 0
    patient: str
    margin: float = 600.0
    share: float = 0.5
    urgent: bool = False


def own(name: str, on: Entity, kind: Type, default: bool | float | str | None) -> OwnField:
    return OwnField(name=name, on=on, type=kind, label=name.capitalize(), default=default)


OWN = described(
    App(
        name="wards",
        title="Wards",
        flow=fly_mission,
        mission=OwnMission,
        trip=OwnTrip,
        fields=(
            field("repeat", Entity.MISSION, FieldType.ROUNDS),
            own("patient", Entity.MISSION, Type.TEXT, None),
            own("margin", Entity.MISSION, Type.TIME, 600.0),
            own("share", Entity.MISSION, Type.PERCENT, 0.5),
            own("urgent", Entity.MISSION, Type.BOOL, False),
            field("delay", Entity.TRIP, FieldType.TIME),
            own("fragile", Entity.TRIP, Type.BOOL, None),
            own("note", Entity.TRIP, Type.TEXT, ""),
            own("layers", Entity.TRIP, Type.INT, 1),
            own("height_over_ground", Entity.TRIP, Type.LENGTH, 0.3),
            own("warmth", Entity.TRIP, Type.TEMPERATURE, None),
        ),
        categories=(Category(name="drone"),),
        actions=BUILT_IN,
    )
)
"""An app with fields of its own, of every sort."""


@dataclass(slots=True, kw_only=True, eq=False)
class SurveyTrip(Trip):
    track: str | None = None
    reach: float = 0.5
    lost_after: float = 2.0
    along: Mapping[str, Any] | None = None


SURVEY = described(
    App(
        name="survey",
        title="Survey",
        flow=fly_mission,
        mission=FieldMission,
        trip=SurveyTrip,
        fields=(
            *TRIP_FIELDS,
            AlongField(
                name="along",
                on=Entity.TRIP,
                type=FieldType.ALONG,
                label="On the way",
                actions=("take_photo", "measure"),
            ),
        ),
        categories=(Category(name="scout", speed=1.0, flight_time=600.0),),
        actions=BUILT_IN,
        parts=(EventsOf(), TracksOf(), CompanyOf()),
    )
)
"""An app whose drones take photos on the way."""
