"""What an app declares of events and of what moves: all that a library knows of it, and hooks see."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from functools import partial
from typing import TYPE_CHECKING, Any, Required, TypedDict, cast

from ..domain import values
from ..domain.actions import Action, Parameter, Plain
from ..domain.app import parameters_data
from ..domain.errors import BadInput
from ..domain.fields import Entity, Field, FieldType
from ..domain.keeper import put, read_only
from ..domain.plain import number_of, plain_of
from ..domain.quantities import Type
from ..domain.text import quoted
from ..domain.values import Quantity, Table, one_of, read_parameters
from .part import PartOf
from .world import Mover, read_movers

if TYPE_CHECKING:
    from ..alone.drones import IdealDrones
    from ..domain.app import App
    from ..domain.model import Point, Trip

LATE = "late"
"""Happens when a promise of a mission is broken."""
LOST = "lost"
"""Happens when a drone is lost."""
FOLLOWING = "follow"
"""The name of the built-in action that follows."""
LONGEST = 60.0
"""Seconds of following that the battery of one drone must hold before it sets out."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """One occurrence of an event; what is not known of it is None."""

    id: str
    """With the same one it happens only once."""
    name: str
    time: float
    """When it was raised, in seconds since the app started."""
    at: Point | None = None
    """Where it happened: metres in the map's frame."""
    track: str | None = None
    """The moving object that it is about."""
    mission: str | None = None
    """The mission whose hook or drone has raised it."""
    trip: str | None = None
    """That mission's trip."""
    drone: str | None = None
    """That trip's drone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EventType:
    """An event that an app declares, or a built-in one."""

    name: str
    type: type[Event] = Event
    fields: tuple[Parameter, ...] = ()
    """Those of its own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Creator:
    """What makes a mission of an event, and the block at which that mission begins."""

    event: str
    block: str
    hook: Callable[..., Any]


def facts_of(event: Event) -> dict[str, Any]:
    """Return an occurrence as plain data."""
    facts = ((field.name, getattr(event, field.name)) for field in fields(event))
    return {name: value for name, value in facts if value is not None}


def event_of(kind: EventType, facts: Mapping[str, Any]) -> Event:
    """Return an occurrence from its plain data."""
    at = facts.get("at")
    return kind.type(**{**facts, "at": None if at is None else tuple(at)})


FACTS = ("id", "track", "mission", "trip", "drone")
"""What may be said of each occurrence, beside where it was, and the fields that its event declares."""


def read_occurrence(
    types: Mapping[str, EventType],
    name: str,
    given: Mapping[str, Any],
    place: Callable[[object], Any],
    wrong: Callable[[str], Exception] = BadInput,
) -> dict[str, Any]:
    """Return what is said of an occurrence, checked; raise what is `wrong` with it.

    `given` may have FACTS, `at`, which `place` reads, and the event's own `fields`.
    """
    kind = types.get(name)
    if kind is None:
        raise wrong(f"there is no event {quoted(str(name))}; there are: {', '.join(types)}")
    table = Table(given, who=f"event {name}")

    def read_place(value: object) -> Any:
        return place(list(value) if isinstance(value, tuple) else value)

    facts = table.read({}, {**dict.fromkeys(FACTS, values.name), "at": read_place, "fields": None})
    fields = {each: plain_of(one) for each, one in given.get("fields", {}).items()}
    own = Table(fields, who=table.who)
    own.problems = table.problems
    facts.update(read_parameters(own, kind.fields))
    if table.problems:
        raise wrong(table.problems[0].sentence)
    return facts


@dataclass(frozen=True, slots=True)
class EventsDeclared(PartOf):
    """The events of an app: those that it declares, and the built-in ones that it uses."""

    types: tuple[EventType, ...] = ()
    """Those that the app declares."""
    creators: tuple[Creator, ...] = ()
    """In the order in which they are asked."""

    def happens(self, world: Table) -> tuple[Mapping[str, Any], ...]:
        """Return the `[[world.event]]` of a fleet file: what happens in the simulated world, and when."""
        types = {one.name: one for one in self.types}
        found = []
        keys = (*FACTS, "at", "fields")
        for number, table in enumerate(world.tables("event"), 1):
            when = table.read({"name": values.name, "after": values.TIME}, dict.fromkeys(keys))
            facts = {key: table.data[key] for key in keys if key in table.data}
            if not (name := when.get("name")):
                continue
            try:
                read_occurrence(types, name, facts, values.point)
            except BadInput as error:
                table.problem(str(error).removeprefix(f"event {name}: "))
            found.append({"id": f"world/{number}", **facts, **when})
        return tuple(found)

    def entries(self) -> tuple[str, ...]:
        """Return the blocks of creators: a mission that one has made begins there."""
        return tuple(one.block for one in self.creators)

    def about(self) -> dict[str, Any]:
        """Return them as plain data: all that a library knows of them."""
        events = [
            {
                "name": one.name,
                "parameters": parameters_data(one.fields),
            }
            for one in self.types
        ]
        creators = [{"event": one.event, "block": one.block} for one in self.creators]
        return {"events": events, "creators": creators}


class TracksDeclared(PartOf):
    """What an app follows that moves."""

    def drones(self) -> type[IdealDrones]:
        """Return simulated drones that see it."""
        from .alone import EventDrones  # of who simulates alone

        return EventDrones

    def movers(self, world: Table) -> tuple[Mover, ...]:
        """Return what moves in the simulated world."""
        return read_movers(world)

    def about(self) -> dict[str, Any]:
        """Return what a library knows of them: that there are any."""
        return {"tracks": True}


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackField(Field):
    """A field of a trip about what it follows: the track, or a limit."""

    def wanted(self, value: object, evaluators: Container[str]) -> str:
        """Return what a value must be that a hook has set, if it is not that."""
        if self.type is Type.TEXT:
            return "" if value is None or type(value) is str else "the id of a track"
        number = number_of(value)
        return "" if number is not None and number > 0.0 else "a number above 0"


TRIP_FIELDS = (
    TrackField(
        name="track",
        on=Entity.TRIP,
        type=Type.TEXT,
        label="Follows the track",
        doc="What moves, and it follows; None: its target stands.",
    ),
    TrackField(
        name="reach",
        on=Entity.TRIP,
        type=Type.LENGTH,
        label="Within",
        default=0.5,
        doc="Metres within which what it follows is reached.",
    ),
    TrackField(
        name="lost_after",
        on=Entity.TRIP,
        type=Type.TIME,
        label="Lost after",
        default=2.0,
        doc="Seconds without news after which what it follows is lost.",
    ),
)
"""What trips have that may follow what moves."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FollowDeclared(Action):
    """Stays within reach of the trip's target for a time, and takes a picture each time that so much has passed."""

    def lasts(self, parameters: Mapping[str, Plain]) -> float:
        """Return how many seconds plans reckon with: what is longer is for several drones, one after the other."""
        return min(LONGEST, Action.lasts(self, parameters))


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongAction(Action):
    """An action of the app's own that goes on while a drone flies, and not at the end of its way."""

    returns: type[object] | None = None
    """The type of what its hook gives; None: the app does not say."""


class Along(TypedDict, total=False):
    """What is done on the way: one of the app's own actions once, a built-in one every so often."""

    action: Required[str]
    parameters: Mapping[str, Plain]
    metres: float
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongField(Field):
    """The field of a trip with the action along its way."""

    actions: tuple[str, ...] = ()
    """Those that can be."""

    def wanted(self, value: object, evaluators: Container[str]) -> str:
        """Return what a value must be that a hook has set, if it is not that."""
        if value is None or (isinstance(value, Mapping) and value.get("action") in self.actions):
            return ""
        return f'an Along, such as {{"action": "{self.actions[0]}"}}'

    def kept(self, value: object) -> object:
        """Return a value as it is kept that a hook has set: a copy, which is read when its trip is taken over."""
        return read_only(value) if isinstance(value, Mapping) else None


@dataclass(frozen=True, slots=True)
class CompanyDeclared(PartOf):
    """What may go on beside the flights of an app."""

    own: tuple[AlongAction, ...] = ()
    """The app's own actions on the way."""

    def about(self) -> dict[str, Any]:
        """Return the actions along the way, for the library."""
        actions = [
            {"name": one.name, "parameters": parameters_data(one.parameters)} for one in self.own
        ]
        return {"along": actions}

    def readers(self, app: App) -> Mapping[FieldType | Type, Callable[[Any], Any]]:
        """Return how the action along a trip's way is read."""
        return {FieldType.ALONG: partial(_read_along, self.actions(app))}

    def actions(self, app: App) -> Mapping[str, Action]:
        """Return what can be done along a trip's way."""
        named = [field for field in app.fields if isinstance(field, AlongField)]
        known = {**app.actions, **{action.name: action for action in self.own}}
        return {name: known[name] for field in named for name in field.actions if name in known}

    def wrong(self, app: App, trip: Trip) -> str | None:
        """Return what is wrong with what a hook wants done along a trip's way; else it is kept as it is read."""
        along = along_of(trip)
        if along is None:
            return None
        try:
            put(trip, along=read_only(read_again(self.actions(app), along)))
        except ValueError as error:
            return f"its along {error}"
        return None

    def prepared(self, trip: Mapping[str, Any]) -> Mapping[str, Any]:
        """Take a target that moves apart: `target = { track = "t7" }`; where it is, is known later."""
        target = trip.get("target")
        if not isinstance(target, dict) or "track" not in target:
            return trip
        of_target = {name: one for name, one in target.items() if name in OF_TARGET}
        unknown = {name: one for name, one in target.items() if name not in OF_TARGET}
        return {**trip, **of_target, "target": unknown or [0.0, 0.0]}


OF_TARGET = ("track", "reach", "lost_after")
"""What a target says that moves, which are fields of its trip."""


def along_of(trip: Trip) -> Along | None:
    """Return what is done along a trip's way."""
    along: Along | None = getattr(trip, "along", None)  # not every app has this field
    return along


def read_again(actions: Mapping[str, Action], along: Mapping[Any, Any]) -> Along:
    """Return what is done on the way, read as a hook has written it; raise `ValueError`."""
    given = {str(name): one for name, one in along.items() if one is not None}
    for name, one in given.items():
        is_several = isinstance(one, Mapping)
        given[name] = _plain_by_name(one) if is_several else plain_of(one)
    table = Table(given)
    keys = {"action": partial(one_of, actions)}
    read = table.read(keys, {**SPACINGS, "metres": OF_LINES, "parameters": None})
    return _complete(actions, table, read, "metres or seconds")


def _plain_by_name(values: Mapping[Any, Any]) -> dict[str, Any]:
    return {str(name): plain_of(one) for name, one in values.items()}


def _read_along(actions: Mapping[str, Action], value: object) -> Along:
    """Read `"look"`, or `{ action = "take_photo", every = "2 m" }`; raise `ValueError`."""
    table = Table(value if isinstance(value, dict) else {"action": value})
    read = table.read({"action": partial(one_of, actions)}, {"every": _spacing, "parameters": None})
    every = read.pop("every", {})
    wanted = 'every, such as every = "2 m" or every = "1 s"'
    return _complete(actions, table, {**read, **every}, wanted)


def _complete(
    actions: Mapping[str, Action], table: Table, read: dict[str, Any], spacing: str
) -> Along:
    """Return what is done on the way with its parameters; raise `ValueError` with what is wrong.

    `spacing` says how one writes that.
    """
    action = actions.get(str(read.get("action")))
    if action is not None:
        read["parameters"] = read_parameters(table.table("parameters"), action.parameters)
        goes_on = isinstance(action, AlongAction)
        is_spaced = not {"every", *SPACINGS}.isdisjoint(table.data)
        if goes_on and is_spaced:
            table.problem(f"{action.name} goes on all the way, and takes no every")
        elif not goes_on and not is_spaced:
            table.problem(f"{action.name} needs {spacing}")
    if table.problems:
        raise ValueError(f"is wrong: {table.problems[0].sentence}")
    found: Any = read
    return cast("Along", found)


SPACINGS = {
    "metres": Quantity(Type.LENGTH, 0.1, 1000.0),
    "seconds": Quantity(Type.TIME, 0.1, 3600.0),
}
"""How far apart something is done on the way."""
OF_LINES = Quantity(Type.LENGTH, 0.001, 10_000.0)
"""The same in metres, of the lines of an area, whose overlap says it."""


def _spacing(value: object) -> dict[str, float]:
    """Read how far apart, in metres or in seconds, something is done."""
    for name, read in SPACINGS.items():
        with suppress(ValueError):
            if isinstance(value, str):
                return {name: read(value)}
    raise ValueError('is no spacing: write a length or a time, such as "2 m" or "1 s"')
