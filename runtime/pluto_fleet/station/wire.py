"""What goes over the wire between a station and its pages: the one schema of both sides.

The OpenAPI description, the pages' types and the Python client are made from these types
(`python -m station_interface`). Times are seconds since a flight's beginning unless a name ends
in `_at`, which is in milliseconds since 1970; places are in metres, batteries from 0 to 1.
"""

from __future__ import annotations

from typing import Annotated, Literal, NotRequired, TypedDict

from msgspec import Meta

Point = list[float]
"""x and y, and z where it is known."""
Scalar = str | int | float | bool
Phase = Literal["idle", "flying", "stopping", "stopped", "interrupted", "over"]
Busy = Literal["", "connecting", "asking"]
LineKind = Literal["good", "bad", "info", "hook"]
ResultKind = Literal["measurement", "photo", "result", "verdict", "handling"]
AlertKind = Literal[
    "lost", "crashed", "battery", "drained", "uncertain", "finding", "late", "waiting", "failed"
]
Role = Literal["watch", "fly"]
SaidKey = Literal[
    "alert.battery",
    "alert.battery-stays",
    "alert.crashed",
    "alert.drained",
    "alert.failed",
    "alert.finding",
    "alert.late",
    "alert.lost",
    "alert.uncertain",
    "alert.uncertain-action",
    "alert.waiting",
    "preflight.beside",
    "preflight.brought-back",
    "preflight.busy",
    "preflight.cannot",
    "preflight.charges",
    "preflight.charging",
    "preflight.endless",
    "preflight.few",
    "preflight.few-lift",
    "preflight.flies",
    "preflight.given-up",
    "preflight.heard-before",
    "preflight.in-the-air",
    "preflight.lost",
    "preflight.low",
    "preflight.low-away",
    "preflight.never-heard",
    "preflight.no-rehearsal",
    "preflight.not-apart",
    "preflight.not-ready",
    "preflight.promise",
    "preflight.refused",
    "preflight.retired",
    "preflight.room",
    "preflight.too-far",
    "preflight.uncharged",
    "question.action",
    "question.other",
    "wait.after",
    "wait.drone",
    "wait.drone-full",
    "wait.paused",
    "wait.time",
    "wait.verdict",
    "wait.you",
]


class Said(TypedDict):
    """What was done, or why it was not: a sentence for people."""

    said: str


class Words(TypedDict):
    """A sentence that each page says in its own language: a key of its catalogue, and its facts.

    `text` is the sentence in English, for whatever does not know the key.
    """

    key: SaidKey
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
    fleet: int
    """How many drones there are; once it grows, `/api/app` describes the new one."""
    said: str
    """What is wrong; empty: nothing."""
    how: Literal["rtl", "land"] | None
    """How the drones come down."""
    busy: Busy
    """What all missions wait for: drones to be found, or asked where they are."""


class TripRow(TypedDict):
    """A trip as the Monitor shows it.

    Where it follows what moves, its place is where its drone will meet that.
    """

    name: str
    status: str
    x: float
    y: float
    priority: int | float | None
    action: str
    track: NotRequired[str]
    """The id of the track that it follows."""


class Question(TypedDict):
    """What only a person can know."""

    said: Words
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
    wait: Words | None
    """Why it waits; None: it does not."""
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


class TrackRow(TypedDict):
    """Something that moves, and is tracked."""

    id: str
    kind: str
    x: float
    y: float
    z: float
    seen: float
    """When it was reported last, in seconds of the flight; where it is since then is not known."""
    trail: list[Point]
    """Where it was in the minute before that, the oldest first."""


class TrackWay(TypedDict):
    """Where something was that was tracked."""

    id: str
    kind: str
    way: list[Point]
    """Of each report the second of the flight, x, y and z."""


class EventRow(TypedDict):
    """Something that has happened, and what has come of it."""

    id: str
    name: str
    time: float
    at: Point | None
    track: str | None
    mission: str | None
    """That whose hook or drone has raised it."""
    trip: str | None
    drone: str | None
    fields: dict[str, Scalar | None]
    """Those that the app declares."""
    made: list[str]
    """The missions that were made of it."""
    broke_off: list[str]
    """The missions whose flights it has broken off."""
    why: str
    """Why no mission was made of it; empty: one was, no creator was asked, or none has answered yet."""
    over: float | None
    """When that was decided, in seconds of the flight."""


class LogLine(TypedDict):
    """A line of the console."""

    number: int
    time: float
    mission: str | None
    text: str
    kind: LineKind


class Layer(TypedDict):
    """A layer of the map: what of the results it shows, and how.

    The id of a layer of `measure` without a quantity stands for a layer for each quantity that is
    measured and has none of its own.
    """

    id: str
    action: str
    kind: Literal["heat", "values", "findings", "photos"]
    title: str | None
    """As the app calls it; None: a page calls it by its kind, or by its quantity."""
    quantity: str | None
    unit: str | None
    low: float | None
    """The values at the ends of the colours; None: the lowest, or the highest, that was measured."""
    high: float | None
    reach: float | None
    """Of a heat map: how many metres around its place a value speaks for."""


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
    kind: ResultKind
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
    layers: list[str]
    """The ids of the layers that show it."""
    drained: float | None
    """The level with which its drone came home after this trip, if that was less than its reserve."""


class Quantity(TypedDict):
    """A number with what it is and its unit."""

    quantity: str
    value: float
    unit: str | None


class Alert(TypedDict):
    """Something that a person must know of, until it is over."""

    id: str
    kind: AlertKind
    urgent: bool
    mission: str | None
    drone: str | None
    x: float | None
    y: float | None
    since_at: int
    said: Words
    over: bool
    by: str | None
    """Who has acknowledged it: a name, or an empty text if none was said; null: it was not."""
    by_at: int | None


class Person(TypedDict):
    """Another browser that looks at the station."""

    id: str
    name: str
    role: Role
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
    amended: list[Result]
    """Results of before of which more is known now."""
    alerts: list[Alert]
    events: list[EventRow]
    """Of those that were raised, or of which something has come; of many the newest."""
    tracks: NotRequired[list[TrackRow]]
    """All that is tracked, if that has changed."""
    people: NotRequired[list[Person]]
    """All others, if that has changed."""


Count = Annotated[int, Meta(ge=0, le=2**53)]
Flight = Annotated[str, Meta(max_length=100)]
"""The id of a flight."""


class LiveRequest(TypedDict):
    """What a page has seen, and what it tells of itself."""

    token: NotRequired[str]
    flight: Flight
    seen: Count
    log: Count
    results: Count
    me: NotRequired[Me]


class Me(TypedDict):
    """Who looks, for the others."""

    id: str
    name: str
    page: str
    touches: str


FlightEnd = Literal["flying", "stopped", "interrupted", "over", "unknown"]
"""How a flight stands by its journal; unknown: that cannot be read, or not to its end."""


class FlightSummary(TypedDict):
    """A flight of the past, by its journal."""

    id: str
    begun_at: int | None
    """None: its journal cannot be read."""
    ended_at: int | None
    seconds: float
    by: str | None
    """Who started it, if that is known."""
    simulated: bool | None
    end: FlightEnd
    missions: int
    completed: int
    failed: int
    cancelled: int
    trips: int
    results: int
    drones: list[str]
    lost: list[str]
    said: str
    """What is wrong with its journal; empty: nothing."""


class Frame(TypedDict):
    """What changed on the pages at an instant of a flight; a keyframe has every row."""

    t: float
    state: State
    missions: list[MissionRow]
    drones: list[DroneRow]
    alerts: list[Alert]


class Replay(TypedDict):
    """A part of a replay, from a keyframe on."""

    flight: str
    begun_at: int | None
    said: str
    """What is missing, or not known; empty: nothing."""
    seconds: float
    """The length of the whole replay."""
    frames: list[Frame]
    next: float | None
    """Where the next part begins."""
    log: list[LogLine]
    """All lines of the flight; only with the first part."""
    results: list[Result]
    alerts: list[Alert]
    events: list[EventRow]
    """What has happened, as it is at the end; only with the first part, like the next."""
    tracks: list[TrackWay]
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
    unmeasured: int
    """Flights, among those, of which its hours and cycles are not known."""


class ReportTrip(TypedDict):
    """A trip in a report, as it was flown last."""

    name: str
    action: str
    status: str
    drone: str | None
    attempts: int
    began: float | None
    ended: float | None
    why: str


class ReportMission(TypedDict):
    """A mission in a report."""

    name: str
    status: str
    why: str
    began: float | None
    """When its first trip was launched."""
    ended: float | None
    due: float | None
    late: bool
    rounds: int
    trips: list[ReportTrip]


class ReportResults(TypedDict):
    """All results of one kind; the three numbers are there where each value is one."""

    action: str | None
    kind: str
    quantity: str | None
    unit: str | None
    count: int
    lowest: float | None
    mean: float | None
    highest: float | None


class ReportDrone(TypedDict):
    """What a drone did in a flight; None: that was not measured."""

    id: str
    trips: int
    launched: int
    hours: float | None
    first_battery: float | None
    lowest_battery: float | None
    last_battery: float | None
    lost: int


class Incident(TypedDict):
    """Something that did not go as planned, or that was found."""

    time: float
    kind: Literal["lost", "drained", "failed", "uncertain", "held", "late", "finding", "stopped"]
    mission: str | None
    drone: str | None
    text: str


class ReportCommand(TypedDict):
    """What somebody commanded."""

    time: float | None
    """In the flight; None: only the station's log has it."""
    at: int | None
    command: str
    given: dict[str, Scalar | None]
    by: str | None
    client: str | None
    """The address from which it came."""
    said: str


class FlightReport(TypedDict):
    """What is to be said of a flight on paper."""

    flight: FlightSummary
    missions: list[ReportMission]
    results: list[ReportResults]
    drones: list[ReportDrone]
    incidents: list[Incident]
    commands: list[ReportCommand]


class Readiness(TypedDict):
    """A drone before a Start."""

    id: str
    battery: float | None
    ready: bool
    why: Words | None
    ready_in: float | None
    """Seconds until its battery is high enough for one of the missions; None: it never is there."""
    assumed: Words | None
    """What is supposed of it, as it is not known."""


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
    world: Literal["traffic", "alone"]
    """Whether drones were kept apart in them, or each had the air to itself."""
    median: float | None
    high: float | None
    """95 % of runs end before."""
    missions: list[MissionForecast]
    drones: list[Readiness]
    lowest_battery: float | None
    bottlenecks: list[Words]
    assumed: list[Words]
    """What is supposed of the whole."""
    problems: list[Words]
    """Why a Start would be refused, and which promises cannot be kept."""
    rehearsal: str | None
    """The id under which the median run can be replayed."""


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


class Plane(TypedDict):
    """Where the map lies on the Earth."""

    latitude: float
    """Of the map's corner (0, 0), in degrees of WGS 84."""
    longitude: float
    altitude: float
    """Of the map's z = 0, in metres above sea level."""
    bearing: float
    """The compass direction of the map's y, in radians, clockwise."""


class MapData(TypedDict):
    """What can be drawn on the map by pages, and is kept in the fleet file."""

    revision: int
    places: list[Place]
    zones: list[Zone]
    north: float
    """Degrees by which north is turned from up, clockwise."""
    plane: Plane | None
    """Where the map lies; null: it is not said."""
    image: Picture | None
    writable: bool
    said: str
    """Why nothing that is drawn can be kept, or else what the last drawing of another program has brought."""


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


class SweptTrip(TypedDict):
    """A trip of those that fly over an area."""

    target: Point
    source: Point | None
    """Where its line begins; null: it is no line, but one place."""
    every: float | None
    """After how many metres of a line the action is done, each time."""


class Swept(TypedDict):
    """How an area is flown over."""

    trips: list[SweptTrip]
    """In their order."""
    places: int
    """At which the action is done."""
    metres: float
    """The way from the first place to the last."""
    outside: float
    """Of that, what is not over the area."""
    seconds: float | None
    """How long one drone takes for that, with what it does there; null: none can do the action."""
    forbidden: float
    """The share of the area that may not be flown over."""


class Ways(TypedDict):
    """The way of each pair of places, both ends included; None: there is none."""

    ways: list[list[Point] | None]


class Laid(TypedDict):
    """Where the floor plan is to lie."""

    x: float
    y: float
    width: float
    height: float
    turn: NotRequired[float]
