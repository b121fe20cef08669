"""The schema of a plan as pages send it: a plan that fits is stored, complete or not.

Whether it can be flown is checked in `problems`: a plan is drawn step by step, and a name typed letter by
letter.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec
from msgspec import Meta

from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity, FieldType
from ...shared.domain.text import quoted
from ..operation import in_words

if TYPE_CHECKING:
    from ...app import App

Shape = dict[str, Any]
"""A mission or a trip as JSON."""

MOST_MISSIONS, MOST_TRIPS = 1_000, 10_000
COMPLETED = "COMPLETED"
BROKEN_OFF = "BROKEN_OFF"
MOMENTS = ("opens", "deadline")
"""When a mission may begin, and when it is due: in a file they are its window, or its deadline."""

_KEY = r"\A[A-Za-z0-9_-]{8,32}\Z"
_WHOLE = r"\A[^\ud800-\udfff]*\Z"
_PATTERNS = {_KEY: "of 8 to 32 letters, digits, - and _", _WHOLE: "without half a character"}
"""What a text must be that matches, in words."""

Key = Annotated[str, Meta(pattern=_KEY)]
Text = Annotated[str, Meta(max_length=1_000, pattern=_WHOLE)]
Number = Annotated[int, Meta(ge=-(10**15), le=10**15)] | Annotated[float, Meta(ge=-1e15, le=1e15)]
Scalar = bool | Number | Text
Place = Annotated[list[Number], Meta(min_length=2, max_length=3)]
End = Literal["COMPLETED", "FAILED", "CANCELLED", "BROKEN_OFF"]
"""The final status of a mission's last flight, if it has not changed since."""


class _Item(msgspec.Struct, forbid_unknown_fields=True):
    """What a drone carries."""

    name: Scalar | None = None
    mass: Scalar | None = None


class _Along(msgspec.Struct, forbid_unknown_fields=True):
    """What is done on the way, and how often."""

    action: Text
    every: Text | None = None
    parameters: Annotated[dict[Text, Scalar | None], Meta(max_length=64)] | None = None


_TRIP: Mapping[str, Any] = {
    "key": Key,
    "name": Text | None,
    "action": Text,
    "target": Place | None,
    "source": Place | None,
    "parameters": Annotated[dict[Text, Scalar | None], Meta(max_length=64)] | None,
    "item": _Item | None,
}
_MISSION: Mapping[str, Any] = {
    "key": Key,
    "name": Text,
    "launched": bool | None,
    "ended": End | None,
    "done": list[Text] | None,
    **dict.fromkeys(MOMENTS, Scalar | None),
}
TRIP_KEYS = tuple(_TRIP)
"""The keys of every app's trips; the graph adds more."""
_NEEDED = {"key", "action", "trips"}


@cache
def _kinds(
    on_missions: tuple[str, ...], on_trips: tuple[str, ...], along: tuple[str, ...]
) -> tuple[Any, Any]:
    """Return the types of a mission and of a trip, in an app with these fields; `along` are also on trips."""
    fields = {
        **dict.fromkeys(on_trips, Scalar | None),
        **dict.fromkeys(along, _Along | Text | None),
    }
    trip = _struct("Trip", {**_TRIP, **fields}, _NEEDED)
    fields = {**_MISSION, **dict.fromkeys(on_missions, Scalar | None)}
    fields |= {"after": list[Text] | None, "trips": list[trip]}  # type: ignore[valid-type]
    return _struct("Mission", fields, _NEEDED | {"name"}), trip


def _struct(name: str, kinds: Mapping[str, Any], needed: Collection[str]) -> type[msgspec.Struct]:
    fields = [(key, kind) if key in needed else (key, kind, None) for key, kind in kinds.items()]
    return msgspec.defstruct(name, fields, kw_only=True, forbid_unknown_fields=True)


def _kinds_of(app: App) -> tuple[Any, Any]:
    along = tuple(field.name for field in app.fields if field.type is FieldType.ALONG)
    return _kinds(tuple(fields_of(app, Entity.MISSION)), tuple(fields_of(app, Entity.TRIP)), along)


def missions_from(given: object, app: App) -> list[Shape]:
    """Return missions in a normal form; raise `BadInput` if they do not fit the schema."""
    missions = [_mission(one) for one in _read(given, app, "mission")]
    check_together(missions)
    return missions


def trips_from(given: object, app: App) -> list[Shape]:
    """Return a mission's trips in a normal form; raise `BadInput` if they do not fit the schema."""
    return [_trip(one) for one in _read(given, app, "trip")]


def without_unknown(missions: Sequence[Shape], app: App) -> tuple[Sequence[Shape], list[str]]:
    """Return missions without the fields that this app does not have, and the names of those."""
    gone: dict[str, None] = {}

    def known(one: Shape, kind: Any) -> Shape:
        keys = kind.__struct_fields__
        gone.update(dict.fromkeys(key for key in one if key not in keys))
        return {key: value for key, value in one.items() if key in keys}

    of_mission, of_trip = _kinds_of(app)
    found = []
    for one in missions:
        trips = msgspec.convert(one.get("trips", []), list[dict[str, Any]])
        mission = known(one, of_mission)
        if "trips" in one:
            mission["trips"] = [known(trip, of_trip) for trip in trips]
        found.append(mission)
    return found, list(gone)


def check_together(missions: Sequence[Shape]) -> None:
    """Raise `BadInput` if there are too many, or two have the same key."""
    keys = [one["key"] for mission in missions for one in (mission, *mission["trips"])]
    if len(missions) > MOST_MISSIONS:
        raise BadInput(f"a plan has at most {MOST_MISSIONS} missions")
    if len(keys) - len(missions) > MOST_TRIPS:
        raise BadInput(f"a plan has at most {MOST_TRIPS} trips")
    seen: set[str] = set()
    for key in keys:
        if key in seen:
            raise BadInput(f"two missions or trips have the key {quoted(key)}")
        seen.add(key)


def fields_of(app: App, entity: Entity) -> list[str]:
    """Return the names of the fields that the graph adds."""
    return [field.name for field in app.fields if field.on is entity]


def _read(given: object, app: App, what: Literal["mission", "trip"]) -> list[Any]:
    """Return the structs of missions or trips."""
    kinds = _kinds_of(app)
    kind = kinds[0] if what == "mission" else kinds[1]
    try:
        found: list[Any] = msgspec.convert(given, list[kind])  # type: ignore[valid-type]
    except msgspec.ValidationError as error:
        raise BadInput(_sentence(str(error), what, kinds)) from None
    return found


_PLACE = re.compile(r"`\$(?=[\[.])(?:\[(\d+)\])?(?:\.trips\[(\d+)\])?\.?(.*)`\Z")


def _sentence(error: str, what: str, kinds: tuple[Any, Any]) -> str:
    """Return what is wrong, with the mission and the trip in which it is."""
    for pattern, words in _PATTERNS.items():
        error = error.replace(f"matching regex {pattern!r}", words)
    within = kinds[0] if what == "mission" and ".trips[" not in error else kinds[1]
    known = _Item if ".item`" in error else _Along if ".along`" in error else within

    def place(match: re.Match[str]) -> str:
        first, trip, rest = match.groups()
        where = f"{what} {int(first) + 1}" if first is not None else f"{what}s"
        where += f", trip {int(trip) + 1}" if trip is not None else ""
        return f"`${where}: {rest}`" if rest else f"`${where}`"

    fields = {one.name: one.type for one in msgspec.structs.fields(known)}
    if " - at `" not in error:
        error += f" - at `${what}s`"
    return in_words(_PLACE.sub(place, error), fields)


def _written(one: msgspec.Struct, kept: Collection[str] = ()) -> Shape:
    """Return what is said, and what is kept though nothing is said of it."""
    fields = msgspec.structs.asdict(one).items()
    return {
        name: _written(value) if isinstance(value, _Along) else value
        for name, value in fields
        if value is not None or name in kept
    }


def _mission(read: Any) -> Shape:
    found = _written(read, ("launched", "ended"))
    found.pop("done", None)
    found |= {"launched": False, "ended": None}  # neither can be set by pages, nor what was done
    if not read.after:
        found.pop("after", None)
    return {**found, "trips": [_trip(one) for one in read.trips]}


def _trip(read: Any) -> Shape:
    found = _written(read, ("target", "parameters", "item"))
    given = (read.parameters or {}).items()
    found["parameters"] = {name: value for name, value in given if value is not None}
    found["item"] = None if read.item is None else _written(read.item)
    return found
