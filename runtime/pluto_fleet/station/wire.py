"""What goes over the wire between a station and its pages: the one schema of both sides.

The OpenAPI description, the pages' types and the Python client are made from these types
(`python -m tests.station.schema`). Times are seconds since a flight's beginning unless a name ends
in `_at`, which is in milliseconds since 1970; places are in metres, batteries from 0 to 1.
"""

from __future__ import annotations

from typing import Literal, NotRequired, TypedDict

Point = list[float]
"""x and y, and z where it is known."""
Scalar = str | int | float | bool
Phase = Literal["idle", "flying", "stopping", "stopped", "interrupted", "over"]


class Words(TypedDict):
    """A sentence that each page says in its own language: a key of its catalogue, and its facts.

    `text` is the sentence in English, for whatever does not know the key.
    """

    key: str
    facts: dict[str, Scalar | list[str]]
    text: str


class State(TypedDict):
    """How the station stands."""

    phase: Phase
    time: float
    plan: int
    """The revision of the plan."""
    map: int
    """The revision of the map's places, zones and picture."""
    said: str
    """What is wrong; empty: nothing."""
    how: Literal["rtl", "land"] | None
    """How the drones come down."""
    busy: Literal["", "connecting", "asking"]
    """What all missions wait for: drones to be found, or asked where they are."""


class TripRow(TypedDict):
    """A trip as the Monitor shows it."""

    name: str
    status: str
    x: float
    y: float
    priority: int | float | None
    action: str


class Question(TypedDict):
    """What only a person can know."""

    text: str
    answers: list[str]


class MissionRow(TypedDict):
    """A mission of the flight."""

    name: str
    index: int
    status: str
    reason: str
    trips: list[TripRow]
    current: int | None
    done: int
    total: int
    drone: str | None
    at: list[str]
    """The blocks of the graph at which it is."""
    wait: str
    """Why it waits; empty: it does not."""
    until: float | None
    attempt: int
    attempts: int
    round: int
    question: Question | None
    due: float | None
    late: bool
    fields: dict[str, Scalar]


class DroneRow(TypedDict):
    """A drone, as it was heard of last."""

    id: str
    status: str
    x: float | None
    y: float | None
    z: float | None
    seen_at: int | None
    """When it was heard of; None: just now, or never where x is None."""
    battery: float | None
    mission: str | None
    trips: int
    retired: bool
    why: str
    ready_in: NotRequired[float | None]
    """Seconds until its battery is high enough to fly, while it charges."""


class LogLine(TypedDict):
    """A line of the console."""

    number: int
    time: float
    mission: str | None
    text: str
    kind: Literal["good", "bad", "info", "hook"]


class PhotoValue(TypedDict):
    """A photo: what it covers and shows, and where its picture is, if the camera took one."""

    position: Point
    width: float
    height: float
    sees: list[str]
    sharpness: float
    picture: str | None
    """The address of the picture; `&size=thumb` of a small one."""


class Result(TypedDict):
    """One value that a flight brought, with what it is, where and when.

    `values` are its numbers as quantities, `tags` its findings: what a layer of the map shows.
    """

    number: int
    time: float
    mission: str
    trip: str | None
    round: int | None
    attempt: int | None
    drone: str | None
    kind: Literal["measurement", "photo", "result", "verdict", "handling"]
    action: str | None
    parameters: dict[str, Scalar]
    target: Point | None
    at: Point | None
    """Where it was really done; None: at the target."""
    place: str | None
    """The named place or zone that it belongs to."""
    value: Scalar | PhotoValue | None
    values: list[Quantity]
    tags: list[str]


class Quantity(TypedDict):
    """A number with what it is and its unit."""

    quantity: str
    value: float
    unit: str | None


class Alert(TypedDict):
    """Something that somebody must know of, until it is over."""

    id: str
    kind: Literal["lost", "crashed", "battery", "uncertain", "finding", "late", "waiting", "failed"]
    urgent: bool
    mission: str | None
    drone: str | None
    x: float | None
    y: float | None
    since_at: int
    said: Words
    over: bool
    by: str | None
    """Who has acknowledged it."""
    by_at: int | None


class Person(TypedDict):
    """Another browser that looks at the station."""

    id: str
    name: str
    role: Literal["watch", "fly"]
    page: str
    touches: str
    """The key of the mission or trip that it has selected; empty: none."""


class LiveMessage(TypedDict):
    """What has changed since a page looked; the rows are whole."""

    server: str
    flight: str
    version: int
    made_at: int
    state: State
    missions: list[MissionRow]
    drones: list[DroneRow]
    log: list[LogLine]
    results: list[Result]
    alerts: list[Alert]
    people: NotRequired[list[Person]]
    """All others, if that has changed."""


class LiveRequest(TypedDict):
    """What a page has seen, and what it tells of itself."""

    token: NotRequired[str]
    flight: str
    seen: int
    log: int
    results: int
    me: NotRequired[Me]


class Me(TypedDict):
    """Who looks, for the others."""

    id: str
    name: str
    page: str
    touches: str


class FlightSummary(TypedDict):
    """A flight of the past, by its journal."""

    id: str
    begun_at: int
    ended_at: int | None
    seconds: float
    by: str | None
    simulated: bool
    end: Phase
    missions: int
    completed: int
    failed: int
    cancelled: int
    trips: int
    results: int
    drones: list[str]
    lost: list[str]
    recorded: bool
    """Whether what the pages showed was recorded, so that the replay is what was seen."""


class Frame(TypedDict):
    """What changed on the pages at an instant of a recording; a keyframe has every row."""

    t: float
    state: State
    missions: list[MissionRow]
    drones: list[DroneRow]


class Replay(TypedDict):
    """A part of a recording, from a keyframe on."""

    flight: str
    begun_at: int
    seconds: float
    """The length of the whole recording."""
    frames: list[Frame]
    next: float | None
    """Where the next part begins."""
    log: list[LogLine]
    """All lines of the flight; only with the first part."""
    results: list[Result]
    alerts: list[Alert]
    batteries: dict[str, list[Point]]
    """Of each drone pairs of time and level; only with the first part."""


class DroneHours(TypedDict):
    """What a drone has flown, over all flights kept here."""

    id: str
    flights: int
    trips: int
    hours: float
    cycles: float
    """Full charges, by what its battery gave."""
    lost: int


class Readiness(TypedDict):
    """A drone before a Start."""

    id: str
    battery: float | None
    ready: bool
    why: Words | None
    ready_in: float | None


class MissionForecast(TypedDict):
    """What is expected of a mission."""

    key: str
    name: str
    trips: int
    median: float | None
    high: float | None
    late: float
    """The share of runs in which it is late."""
    fails: float


class Forecast(TypedDict):
    """What is expected of a Start, by many runs in virtual time."""

    revision: int
    runs: int
    median: float | None
    high: float | None
    """95 % of runs end before."""
    missions: list[MissionForecast]
    drones: list[Readiness]
    lowest_battery: float | None
    bottlenecks: list[Words]
    problems: list[Words]
    rehearsal: str | None
    """The id of a recording of the median run, to be replayed."""


class Place(TypedDict):
    """A named place of the map."""

    name: str
    x: float
    y: float
    z: NotRequired[float]


class Zone(TypedDict):
    """A named area of the map."""

    name: str
    corners: list[Point]


class MapData(TypedDict):
    """What can be drawn on the map by pages, and is kept in the fleet file."""

    revision: int
    places: list[Place]
    zones: list[Zone]
    north: float
    """Degrees by which north is turned from up, clockwise."""
    image: Picture | None
    writable: bool
    said: str
    """Why nothing that is drawn can be kept; empty: it can."""


class Picture(TypedDict):
    """The floor plan, and where it lies: its lower left corner, its size, and its turn in degrees."""

    address: str
    x: float
    y: float
    width: float
    height: float
    turn: float


class SavedPlan(TypedDict):
    """A plan, or a template, that is kept under a name."""

    name: str
    saved_at: int
    by: str
    missions: int | None
    """How many it has; None: it cannot be read."""
    template: bool
    said: str
    """What is wrong with it, or still to be done before it can fly; empty: nothing."""


class TrashedPlan(TypedDict):
    """A plan that was deleted, and can be restored."""

    id: str
    name: str
    deleted_at: int


class SavedPlans(TypedDict):
    """All plans that are kept under names, and what was deleted of them."""

    plans: list[SavedPlan]
    trash: list[TrashedPlan]


class PlanChange(TypedDict):
    """A change of the plan, of the last 200."""

    revision: int
    by: str
    """The browser that made it; empty: the station."""
    step: Literal["edit", "undo", "redo"]


class PlanChanges(TypedDict):
    """The last changes of the plan, and what the browser that asks can take back."""

    changes: list[PlanChange]
    undo: bool
    redo: bool


class Swept(TypedDict):
    """How an area is flown over: the targets of its trips, in their order."""

    targets: list[Point]
    metres: float
    """The way from the first to the last."""
    forbidden: float
    """The share of the area that may not be flown over."""


class Ways(TypedDict):
    """The way of each pair of places, both ends included; None: there is none."""

    ways: list[list[Point] | None]


class MapEdit(TypedDict):
    """What a page has drawn on the map: PUT /api/map. What it does not send stays."""

    revision: int
    places: NotRequired[list[Place]]
    zones: NotRequired[list[Zone]]
    north: NotRequired[float]
    image: NotRequired[Laid | None]
    """Where the floor plan lies; null: there is to be none."""


class Laid(TypedDict):
    """Where the floor plan is to lie."""

    x: float
    y: float
    width: float
    height: float
    turn: NotRequired[float]


class WaysAsked(TypedDict):
    """Pairs of places, at most 500, whose ways are asked for: POST /api/ways."""

    ways: list[list[Point]]


class AreaAsked(TypedDict):
    """An area that is to be swept, as `[[mission.area]]` has it: POST /api/plan/sweep."""

    polygon: list[Point]
    spacing: str | float
    height: NotRequired[str | float]
    before: NotRequired[Point]
    """From where the drones come; without it the sweep begins wherever it is shortest."""


class StepAsked(TypedDict):
    """POST /api/plan/undo and /api/plan/redo, with the header X-Pluto-Me."""

    revision: int


class PlanSaved(TypedDict):
    """How the plan is to be kept: PUT /api/plans?name=…"""

    by: NotRequired[str]
    template: NotRequired[bool]
    replace: NotRequired[bool]
    """Whether one that has the name already goes to the trash."""


class PlanOpened(TypedDict):
    """Which plan is to be opened: POST /api/plans/open."""

    name: str
    revision: int
    add: NotRequired[bool]
    """Beside what is drawn, and not in place of what has not been started."""


class PlanRestored(TypedDict):
    """What is to be taken out of the trash: POST /api/plans/restore."""

    id: str
