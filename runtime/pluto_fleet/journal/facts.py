"""What the events and rows of a journal must say, which may be from anybody, before it is used."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NotRequired, TypedDict

from msgspec import Meta, MsgspecError, convert
from msgspec.json import Decoder

from ..jobs.flown import ACTS_BESIDE, FLEW
from ..process.untrusted import LATEST, Test, fits, parsed
from ..shared.domain.status import Status, TripStatus
from ..shared.domain.text import bounded, printable

Event = dict[str, Any]

BROKEN = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, StopIteration)
"""What an event raises that is not as this version knows it."""

Point = tuple[float, float, float]
Place = tuple[str, str, int, int]


class ItemFacts(TypedDict):
    """What a mission carries."""

    name: str
    mass: float


class TripFacts(TypedDict):
    """A trip."""

    name: str
    action: str
    target: Point
    index: int
    source: NotRequired[Point]
    fields: NotRequired[dict[str, Any]]
    parameters: NotRequired[dict[str, Any]]
    item: NotRequired[ItemFacts]
    added: NotRequired[bool]
    attempt: NotRequired[int]
    status: NotRequired[TripStatus]
    reason: NotRequired[str]
    start_time: NotRequired[float | None]
    end_time: NotRequired[float | None]
    round: NotRequired[int]


class PhotoFacts(TypedDict):
    """A photo."""

    position: Point
    width: float
    height: float
    sees: list[str]
    sharpness: float
    file: NotRequired[str]


class PromiseFacts(TypedDict):
    """What a mission promises."""

    after: NotRequired[list[str]]
    opens: NotRequired[float]
    deadline: NotRequired[float]


class PlanFacts(TypedDict):
    """A mission, as its user gave it."""

    index: int
    fields: dict[str, Any]
    trips: list[TripFacts]
    promises: NotRequired[PromiseFacts]


class LossFacts(TypedDict):
    """Why a drone is lost, and where."""

    reason: str
    at: Point | None


class TakesFacts(TypedDict):
    """How long plans reckon that an action takes, and the parameter that may say otherwise."""

    seconds: float
    parameter: NotRequired[str]


Metres = Annotated[list[float], Meta(min_length=3, max_length=3)]
"""A place, as rows have it."""


class FlightRow(TypedDict):
    """The latest flight of a mission."""

    trip: str
    drone: str
    round: int
    attempt: int
    since: float
    retry: bool
    begun: bool
    beside: Metres | None
    outcome: str | None
    heard: bool
    relieved: NotRequired[int]


class MissionRow(TypedDict):
    """How a mission stands."""

    index: int
    fields: dict[str, Any]
    status: str
    reason: str
    round: int
    attempts: int
    at: str | None
    delay: list[Any] | None
    waited: list[list[str | int]]
    first_start: float | None
    last_action_end: float | None
    flight: FlightRow | None
    carrier: str | None
    carries: ItemFacts | None
    judged: int
    interrupted: bool
    ended: bool
    paused: float | None
    question: str | None
    held: str | None
    answer: str | None
    accepted: str | None
    promises: dict[str, Any]
    late: bool
    replanned: bool
    changed: bool


class TripRow(TypedDict):
    """How a trip stands."""

    name: str
    action: str
    target: Metres
    index: int
    number: int
    rank: int
    source: NotRequired[Metres]
    fields: NotRequired[dict[str, Any]]
    parameters: NotRequired[dict[str, Any]]
    item: NotRequired[ItemFacts]
    added: NotRequired[bool]
    attempt: NotRequired[int]
    status: NotRequired[str]
    reason: NotRequired[str]
    start_time: NotRequired[float]
    end_time: NotRequired[float]
    round: NotRequired[int]
    drone: NotRequired[str]


class LossRow(TypedDict):
    """Why a drone is lost, and where."""

    reason: str
    at: Metres | None


class DroneRow(TypedDict):
    """How a drone stands; of one that has not been seen yet only what earlier flights know."""

    status: NotRequired[str]
    at: NotRequired[Metres]
    battery: NotRequired[float]
    trips: NotRequired[int]
    retired: NotRequired[bool]
    mended: NotRequired[bool]
    lost: NotRequired[LossRow | None]


class ResultRow(TypedDict):
    """What came of an action."""

    mission: str
    trip: str | None
    number: int | None
    round: int
    attempt: int
    value: Any
    time: float
    place: Metres | None


class OccurrenceFacts(TypedDict):
    """What is known of an event that was raised, beside its own fields."""

    id: str
    name: str
    time: float
    at: NotRequired[Metres]
    track: NotRequired[str]
    mission: NotRequired[str]
    trip: NotRequired[str]
    drone: NotRequired[str]


class HappeningRow(TypedDict):
    """An event that was raised, and what has come of it."""

    event: dict[str, Any]
    """What is known of it: OccurrenceFacts, and its own fields."""
    open: list[str]
    made: NotRequired[list[str]]
    why: NotRequired[str]


class KeptRow(TypedDict):
    """An event that was raised while everything was stopped, with what was given, and until when it counts."""

    event: str
    given: dict[str, Any]
    since: float
    keep: float


class TrackFacts(TypedDict):
    """Where something was that moves; `kind` the first time, and how many seconds `ago` where that is not now."""

    at: Point
    kind: NotRequired[str]
    ago: NotRequired[float]


class ClockRow(TypedDict):
    """When the app first began, and how far the clock of the hours has drifted since."""

    began: float | None
    drift: float


_MISSION = {"mission": str}
_TRIP = {**_MISSION, "trip": str}
_FLIGHT = {**_TRIP, "drone": str, "round": int, "attempt": int}
_BECAUSE = {**_MISSION, "reason": str}
_DRONE = {"drone": str, "at?": Point | None, "battery?": float | None, "reason?": str}

BEGUN = "journal.begun"
"""The event of the first row."""
SHOWN = "shown"
"""The event of what pages are shown differently than before (`station/shown.py`)."""
SAID = "said"
"""The event of a line of the console that nothing else tells."""
TRACKED = "tracked"
"""The event of what moves beside the drones: where it was reported."""
DRAINED = "drone.drained"
"""The event of a drone that has come home with less than its reserve."""

_FACTS: Mapping[str, Mapping[str, Any]] = {
    BEGUN: {
        "app?": str,
        "takes?": dict[str, TakesFacts],
        "missions?": str,
        "fleet?": str | None,
        "sim?": bool,
        "crtp_sim?": int | None,
        "mavlink_sim?": int | None,
        "seed?": int,
        "faults?": dict[str, float],
        "lost?": dict[str, LossFacts],
        "mended?": list[str],
        "retired?": list[str],
        "joined?": list[dict[str, Any]],
    },
    "brain.began": {"epoch": int},
    "stopped": {"how": str},
    "commanded": {"id": str, "command?": str},
    "log": {"text": str, "mission?": str | None},
    SAID: {"text": str, "kind": Literal["good", "bad", "info", "hook"]},
    SHOWN: {
        "state?": dict[str, Any],
        "missions?": dict[str, dict[str, Any]],
        "drones?": dict[str, dict[str, Any]],
        "alerts?": dict[str, dict[str, Any]],
    },
    "mission.promised": {**_MISSION, "plan": PlanFacts},
    "mission.created": {**_MISSION, "plan": PlanFacts, "trips": list[str]},
    "mission.late": _MISSION,
    "mission.changed": {
        **_MISSION,
        "fields": dict[str, Any],
        "done": list[TripFacts],
        "at": int,
        "gone": list[str],
        "put": list[TripFacts],
    },
    "mission.replanned": {**_MISSION, "todo": list[TripFacts]},
    "mission.extended": {
        **_MISSION,
        "redo": list[str],
        "add": list[str],
        "trips": list[TripFacts],
        "reason?": str | None,
    },
    "mission.repeated": {**_MISSION, "round": int},
    "mission.modified": {**_BECAUSE, "status": Status},
    "mission.judged": _BECAUSE,
    "mission.ended": {**_BECAUSE, "status": Status},
    "mission.paused": _MISSION,
    "mission.resumed": {**_MISSION, "status": Status},
    "mission.uncertain": _BECAUSE,
    "mission.held": _BECAUSE,
    "mission.decided": {**_MISSION, "answer": str},
    "trip.delayed": {
        **_TRIP,
        "block": str,
        "over": float,
        "begins": float,
        "until": float,
        "resumes_at": str | None,
    },
    "trip.allocated": {**_TRIP, "drone": str, "why": str, "resumes_at": str | None},
    "trip.launched": _FLIGHT,
    ACTS_BESIDE: {**_TRIP, "drone": str, "at": Point},
    "action.begun": {**_TRIP, "drone": str},
    "action.result": {
        **_FLIGHT,
        "result": Any,
        "at?": Point | None,
        "action?": str,
        "parameters?": dict[str, Any],
    },
    "trip.relieving": {**_TRIP, "drone": str},
    "trip.handed_over": {**_FLIGHT, "of?": str | None, "away?": float, "reach?": float},
    "event.raised": {
        "id": str,
        "kind": str,
        "raised": float,
        **dict.fromkeys(("track?", "mission?", "trip?", "drone?"), str),
        "at?": Point,
        "fields?": dict[str, Any],
    },
    "event.over": {"id": str, "made?": str, "why?": str, "fault?": bool},
    "event.kept": {"id": str, "kind": str, "keep": float},
    "event.dropped": {"id": str, "kind": str, "why": str},
    "trip.completed": {**_FLIGHT, "result": Any, "did": TripFacts, "found_out?": bool},
    "trip.failed": {**_TRIP, "drone": str, "reason": str},
    "trip.reset": {**_TRIP, "attempt": int, "fields": dict[str, Any]},
    "trip.interrupted": {**_TRIP, "reason?": str, "by?": str},
    "trip.skipped": _TRIP,
    "trip.prioritised": {**_TRIP, "priority": float},
    **dict.fromkeys(
        (
            *("drone.free", "drone.busy", "drone.returning", "drone.charging"),
            *("drone.recovering", "drone.offline", "drone.lost", "drone.retired"),
        ),
        _DRONE,
    ),
    DRAINED: {"drone": str, "level": float},
    "drone.not_ready": {"drone": str, "reason": str},
    "drone.offered": {"drone": str},
    "drone.brought_back": {**_DRONE, "lost?": bool},
    "drone.joined": {"drone": str, "entry": dict[str, Any]},
    "drone.mishap": {"drone": str, "kind": str},
    TRACKED: {"tracks": dict[str, TrackFacts]},
    FLEW: {
        "drone": str,
        "battery?": tuple[float, float] | float | None,
        "at?": Point | None,
    },
}
"""What each event must say; what has a `?` may be left out. Of any other event nothing follows."""

_MEASURED: Mapping[str, Any] = {
    "what": str,
    "ended": str,
    "from": Point,
    "to": Point,
    "battery": tuple[float, float],
}
"""What a measurement says beside that, of a command that has taken `seconds`."""


LONGEST_TEXT = 100_000
"""Characters of a name, a reason, or a line."""


def _tests(facts: Mapping[str, Any]) -> list[tuple[str, bool, Test]]:
    return [
        (
            name.rstrip("?"),
            name[-1] != "?",
            _is_short if hint is str and name != "missions?" else fits(hint),
        )
        for name, hint in facts.items()
    ]


def _is_short(value: object) -> bool:
    return isinstance(value, str) and len(value) <= LONGEST_TEXT


_TESTS = {kind: _tests(facts) for kind, facts in _FACTS.items()}
_MEASUREMENT = _tests(_MEASURED)
_OF_A_DRONE = _tests(_DRONE)
_SECONDS = fits(float)
_MARKED: Mapping[str, Test] = {
    "$photo": fits(PhotoFacts),
    "$number": fits(Literal["nan", "inf", "-inf"]),
    "$tuple": fits(list[Any]),
    "$text": fits(str),
}
"""What stands under the reserved keys of results."""


def events_of(text: str) -> list[Event]:
    """Return the events of a row; raise `ValueError` if it has none."""
    events = parsed(text)
    if type(events) is not list:
        raise ValueError(_NO_EVENTS)
    for event in events:
        if type(event) is not dict or type(event.get("event")) is not str:
            raise ValueError(_NO_EVENTS)
    return events


_NO_EVENTS = "it is no list of events"


def header_of(text: str) -> Event:
    """Return the event of the first row; raise `ValueError` if it is none of a header."""
    match parsed(text):
        case [dict(header), *_]:
            check({"t": 0.0, **header, "event": BEGUN})
            return header
    raise ValueError("it is no header")


def check(event: Mapping[str, Any]) -> None:
    """Raise `ValueError` if an event does not say what it must."""
    kind = event["event"]
    t = event.get("t")
    if not isinstance(t, (float, int)) or not 0 <= t <= LATEST:
        raise ValueError(_unfit(kind, "t", t))
    _hold(event, _TESTS.get(kind) or (_OF_A_DRONE if kind.startswith("drone.") else ()))
    if kind in ("trip.completed", "action.result") and not _is_value(event["result"]):
        raise ValueError(_unfit(kind, "result", event["result"]))
    if kind == FLEW and "seconds" in event:
        if not _SECONDS(event["seconds"]) or not 0 <= event["seconds"] <= LATEST:
            raise ValueError(_unfit(kind, "seconds", event["seconds"]))
        _hold(event, _MEASUREMENT)


def _hold(event: Mapping[str, Any], tests: Any) -> None:
    for name, needed, test in tests:
        value = event.get(name, _MISSING)
        if value is not _MISSING:
            if not test(value):
                raise ValueError(_unfit(event["event"], name, value))
        elif needed:
            raise ValueError(f"{printable(bounded(event['event'], _LONGEST))} lacks {name}")


def _is_value(value: object) -> bool:
    """Whether a result is written as one; it is not deep."""
    if isinstance(value, dict):
        marked = all(test(value[key]) for key, test in _MARKED.items() if key in value)
        return marked and all(map(_is_value, value.values()))
    return not isinstance(value, list) or all(map(_is_value, value))


_MISSING = object()


def _unfit(kind: str, name: str, value: object) -> str:
    part = value[:_LONGEST] if isinstance(value, (str, list)) else value
    told = printable(bounded(repr(part), _LONGEST))
    return f"{printable(bounded(kind, _LONGEST))} has {told} as {name}"


_LONGEST = 80
"""Characters of what is quoted."""


_ROWS: Mapping[str, Decoder[Any]] = {
    "mission": Decoder(MissionRow),
    "trip": Decoder(TripRow),
    "drone": Decoder(DroneRow),
    "result": Decoder(ResultRow),
    "happening": Decoder(HappeningRow),
}
_APP: Mapping[str, Decoder[Any]] = {
    "epoch": Decoder(dict[Literal["is"], int]),
    "clock": Decoder(dict[Literal["is"], ClockRow]),
    "stopped": Decoder(dict[Literal["is"], float | None]),
    "commands": Decoder(dict[Literal["is"], list[str]]),
    "joined": Decoder(dict[Literal["is"], list[dict[str, Any]]]),
    "kept": Decoder(dict[Literal["is"], list[KeptRow]]),
}
_DELAY = fits(tuple[Place, float, float])
_WAITED = fits(Place)
_PROMISES = fits(PromiseFacts)
_STATUSES = {status.value for status in Status}
_TRIPS = {status.value for status in TripStatus}


def row_of(table: str, key: Sequence[object], text: str) -> dict[str, Any]:
    """Return what a row holds; raise `ValueError` if it is not as this version writes it."""
    decoder = _APP.get(str(key[0])) if table == "app" else _ROWS[table]
    try:
        row: dict[str, Any] = {} if decoder is None else decoder.decode(text)
        sound = _is_sound(table, row)
    except (MsgspecError, RecursionError, TypeError):
        sound = False
    if not sound:
        name = printable(bounded(" ".join(map(str, key)), _LONGEST))
        raise ValueError(f"the row of {table} {name} is not as this version knows it")
    return row


def _is_sound(table: str, row: Mapping[str, Any]) -> bool:
    """Return whether a row of the right type says what can be."""
    match table:
        case "mission":
            flight = row["flight"]
            delay = row["delay"]
            return (
                row["status"] in _STATUSES
                and (flight is None or flight["outcome"] in {*_STATUSES, None})
                and (delay is None or _DELAY(delay))
                and all(map(_WAITED, row["waited"]))
                and _PROMISES(row["promises"])
            )
        case "trip":
            return row.get("status", "WAITING") in _TRIPS
        case "result":
            return _is_value(row["value"])
        case "happening":
            convert(row["event"], OccurrenceFacts)  # raises what is caught
        case "app":
            return "is" in row
    return True
