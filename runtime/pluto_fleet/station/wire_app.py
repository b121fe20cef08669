"""What pages are told once: the app with its fields, actions and graph, the fleet, and the plan."""

from __future__ import annotations

from typing import NotRequired, TypedDict

from .wire import Layer, Point, Role, Scalar


class FieldData(TypedDict):
    """A field of missions or of trips that the user of an app fills in."""

    name: str
    type: str
    """`time`, `int`, `rounds`, `time of day`, `evaluator`, `along`, or a type of the language."""
    label: str
    default: Scalar | None
    own: NotRequired[bool]
    """Whether the app itself has declared it."""
    needed: NotRequired[bool]
    """Whether it must be filled in."""
    units: NotRequired[list[str]]
    actions: NotRequired[list[str]]
    """Of `along`: what can be done on the way."""
    spaced: NotRequired[list[str]]
    """Those of them that are done again and again, `every` so far or so long."""


class FieldsData(TypedDict):
    """The fields that this app has."""

    mission: list[FieldData]
    trip: list[FieldData]


class ParameterData(TypedDict):
    """A parameter of an action."""

    name: str
    type: str
    units: list[str]
    default: Scalar | None


class ActionData(TypedDict):
    """An action that a drone of the fleet can do."""

    name: str
    item: bool
    """Whether it takes an item or puts one down."""
    parameters: list[ParameterData]


class EventData(TypedDict):
    """An event that the app declares."""

    name: str
    fields: list[ParameterData]
    creates: bool
    """Whether a creator is asked to make a mission of it."""


class CategoryData(TypedDict):
    """A category of drones."""

    name: str
    payload: float
    """Kilograms."""
    speed: float
    """Metres per second."""
    flight_time: float
    """Seconds with a full battery."""
    actions: list[str] | None
    """The actions that it can do; null: all."""


class FleetDrone(TypedDict):
    """A drone of the fleet file."""

    id: str
    category: str
    home: Point


class MapShape(TypedDict):
    """What of the map does not change while the station runs."""

    size: Point
    cruise_height: float
    ceiling: float
    no_fly: list[list[Point]]
    image: str | None
    """The address of the floor plan."""


class BlockData(TypedDict):
    """A block of the app's graph, or its start or end, by its upper left corner."""

    name: str
    kind: NotRequired[str]
    """Start and end have none."""
    gate: NotRequired[bool]
    x: float
    y: float


class EdgeData(TypedDict):
    """An edge of the app's graph, with the statuses that pass."""

    source: str
    target: str
    statuses: list[str]
    fork: NotRequired[bool]
    """Whether it is a branch of a fork."""
    implicit: NotRequired[bool]
    """Whether the app has no such edge: missions end there all the same."""


class GraphData(TypedDict):
    """The app's graph as plutoc has laid it out: the package's `graph.json`, as it is."""

    kinds: dict[str, str]
    """What blocks of each kind do."""
    blocks: list[BlockData]
    edges: list[EdgeData]


class AppData(TypedDict):
    """The app and its fleet, which stay the same while the station runs."""

    name: str
    title: str
    """What the station is called: as its app, if `--title` says no other."""
    logo: str | None
    """The address of the picture that `--logo` names."""
    server: str
    """Another after each start of the station."""
    role: Role
    """What who asks this may do: `watch` reads, `fly` commands, too."""
    sim: bool
    speed: float
    fields: FieldsData
    evaluators: list[str]
    actions: list[ActionData]
    categories: list[CategoryData]
    drones: list[FleetDrone]
    events: list[EventData]
    """Those that it declares, which can be raised."""
    layers: list[Layer]
    """How results are shown on the map."""
    map: MapShape
    retries: bool
    """Whether the graph flies a failed trip again."""
    rounds: bool
    """Whether missions may be flown in rounds."""
    graph: GraphData | None


class ItemData(TypedDict):
    """What a drone carries."""

    name: NotRequired[str]
    mass: NotRequired[Scalar]
    """With its unit, as in `4 g`."""


class PlanTrip(TypedDict):
    """A trip of the plan, with the fields that the app's trips have beside these."""

    key: str
    name: NotRequired[str]
    action: str
    target: list[float] | None
    source: NotRequired[list[float]]
    parameters: dict[str, Scalar]
    item: ItemData | None


class PlanMission(TypedDict):
    """A mission of the plan, with the fields that the app's missions have beside these."""

    key: str
    name: str
    launched: NotRequired[bool]
    """Whether it flies, and may not be changed; what a page says of that is ignored."""
    ended: NotRequired[str | None]
    """How its last flight ended, if it has not been changed since."""
    opens: NotRequired[Scalar]
    deadline: NotRequired[Scalar]
    after: NotRequired[list[str]]
    trips: list[PlanTrip]


class PlanProblemData(TypedDict):
    """What keeps the plan from being flown."""

    mission: str | None
    """The key of the mission."""
    trip: str | None
    field: str | None
    text: str


class PlanData(TypedDict):
    """The plan that users draw."""

    revision: int
    missions: list[PlanMission]
    problems: list[PlanProblemData]
    said: str
    """Why it could not be stored; empty: it was."""
