"""What hooks may write, decided where they write it; names, statuses and counts are the runtime's.

A mission and its trips have one keeper. A hook runs in a context of its own, from which the keeper
knows whether it is one of the mission's. What a hook has written is taken over as a whole, or not at
all (flow/asking.py).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import Context, ContextVar, copy_context
from dataclasses import fields
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from .errors import MissionFailed
from .text import bounded, class_of, shown

if TYPE_CHECKING:
    from .fields import Field

T = TypeVar("T")
K = TypeVar("K", bound="Kept")

FieldsOf = Mapping[tuple[type, str], "Field"]
"""The fields of an app's missions and trips, by class and name."""


_set = object.__setattr__


def put(of: Kept, **facts: object) -> None:
    """Set attributes as the runtime does, without the checks of what hooks write."""
    for name, value in facts.items():
        _set(of, name, value)


def put_anew(of: Kept) -> None:
    """Put what a new one has of the runtime: what a hook has written there before it gave it away counts for nothing."""
    put(of, **{each.name: each.default for each in fields(of) if not each.init})


def settled(of: K) -> K:
    """Return one without what a hook has written of it that runs still."""
    keeper = of._keeper
    if keeper is None or not keeper.before:
        return of
    was = {name: value for (one, name), value in keeper.before.items() if one is of}
    copy = type(of).__new__(type(of))
    put(copy, **{each.name: getattr(of, each.name) for each in fields(of)})
    put(copy, **was)
    return copy


def read_only(values: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a copy of values by name that hooks can only read, what is inside included."""
    return MappingProxyType({name: _read_only(one) for name, one in values.items()})


def _read_only(value: Any) -> Any:
    if type(value) is list:
        return tuple(value)
    return read_only(value) if type(value) is dict else value


def plain_again(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the same as plain data."""
    return {name: _plain_again(one) for name, one in values.items()}


def _plain_again(value: Any) -> Any:
    if type(value) is tuple:
        return list(value)
    return plain_again(value) if type(value) is MappingProxyType else value


def hand_to(keeper: Keeper, of: Kept) -> None:
    """Have a keeper say what hooks may write of this one."""
    put(of, _keeper=keeper)


def keep(keeper: Keeper, mission: Any, trips: Iterable[Any]) -> None:
    """Have a keeper keep a mission, and trips of it."""
    hand_to(keeper, mission)
    put(mission, promises=read_only(mission.promises))
    mission.trips._keeper = keeper
    for trip in trips:
        hand_to(keeper, trip)
        put(trip, parameters=read_only(trip.parameters))
        keeper.names.setdefault(trip.name, 1)


def keeper_of(of: object) -> Keeper | None:
    """Return the keeper of a mission, a trip or a drone; None: it has none yet."""
    found: Keeper | None = getattr(of, "_keeper", None)
    return found


class Kept:
    """A mission, a trip or a drone. As long as it has no keeper, anything may be written."""

    __slots__ = ("_keeper",)

    __dataclass_fields__: ClassVar[dict[str, Any]]
    _keeper: Keeper | None
    _called: ClassVar[str]
    """What it is to a person."""
    _edited: ClassVar[frozenset[str]] = frozenset()
    """What a modifier may write, beside the fields of the app."""

    def __new__(cls, *_: object, **__: object) -> Self:
        """Make one without a keeper."""
        made = object.__new__(cls)
        _set(made, "_keeper", None)
        return made

    if not TYPE_CHECKING:  # else a type checker takes any name for an attribute

        def __setattr__(self, name: str, value: object) -> None:
            if self._keeper is not None and hasattr(type(self), name):
                value = self._keeper.written(self, name, value)
            _set(self, name, value)

        def __delattr__(self, name: str) -> None:
            raise AttributeError(f"{self._called}.{name} cannot be deleted")

    def _closed(self) -> str:
        """Return why even a modifier may not write it now; empty: it may."""
        return ""


class Writer:
    """A hook that runs, as the keeper of what it may write knows it."""

    __slots__ = ("edits", "of")

    def __init__(self, of: Keeper, edits: bool) -> None:
        self.of: Keeper | None = of  # None: it has ended, and nobody may write in its name
        self.edits = edits


_writer: ContextVar[Writer | None] = ContextVar("writer", default=None)
"""The hook that runs in this context."""


def reading() -> Context:
    """Return a context for a hook that may write nothing."""
    context = copy_context()
    context.run(_writer.set, None)
    return context


class Keeper:
    """What hooks may write of one mission and its trips."""

    __slots__ = ("_evaluators", "_fields", "before", "changed", "names", "time")

    def __init__(
        self,
        time: Callable[[], float] = float,
        fields: FieldsOf | None = None,
        evaluators: Iterable[str] = (),
    ) -> None:
        """`time` is the clock of the app; only what runs in a context of `opened` writes."""
        self.time = time
        self._fields = fields or {}
        self._evaluators = frozenset(evaluators)
        self.names: dict[str, int] = {}
        """Of all trips that the mission has had in this round; with how many wanted each."""
        self.before: dict[tuple[Any, str], object] = {}
        """What attributes were before hooks wrote them."""
        self.changed = False  # whether a hook has ever changed the mission

    @contextmanager
    def opened(self, *, edits: bool = False) -> Iterator[Context]:
        """Give a context in which a hook may write fields of the app, and if it `edits`, trips."""
        writer = Writer(self, edits)
        context = copy_context()
        context.run(_writer.set, writer)
        try:
            yield context
        finally:
            writer.of = None

    def _writer(self) -> Writer | None:
        """Return the hook that runs here, if it is one of the mission's."""
        writer = _writer.get()
        return writer if writer is not None and writer.of is self else None

    def must_edit(self, what: str) -> None:
        """Raise `AttributeError` unless it is a modifier of the mission that writes."""
        writer = self._writer()
        if writer is None or not writer.edits:
            raise AttributeError(f"{what}: that is for a modifier, while it runs{_ELSE}")

    def written(self, of: Kept, name: str, value: object) -> object:
        """Return a value, as it is kept, that a hook writes; raise if it may not, or not that."""
        what = f"{of._called}.{name}"
        field = self._fields.get((type(of), name))
        if field is not None:
            if self._writer() is None:
                who = "a modifier, an evaluator or an action of its mission"
                raise AttributeError(f"{what} cannot be set here: that is for {who}, while it runs")
            if wanted := field.wanted(value, self._evaluators):
                raise TypeError(f"{what} must be {wanted}, not {bounded(shown(value), 100)}")
            value = field.kept(value)
        elif name not in of._edited:
            raise AttributeError(f"{what} is set by the app alone{_INSTEAD.get(name, '')}")
        else:
            self.must_edit(f"{what} cannot be set here")
            if why := of._closed():
                raise AttributeError(f"{what} cannot be set: {why}")
        self.note(of, name)
        return value

    def note(self, of: Kept, *names: str) -> None:
        """Remember attributes before a hook changes them."""
        for name in names:
            self.before.setdefault((of, name), getattr(of, name))

    def undo(self) -> None:
        """Put back all that hooks have written since it was taken over last."""
        for (of, name), value in self.before.items():
            put(of, **{name: value})
        self.before.clear()


_ELSE = "; an evaluator has trips added or flown again by its Verdict"
_INSTEAD = {
    "name": ": a trip keeps the name with which it was made",
    "status": ": a modifier returns a status, and trip.reset() puts a trip back",
    "attempt": ": it counts flights, and trip.reset() begins the next one",
    "completed_trips": ": an evaluator has trips flown again by Verdict(redo=…)",
}


class Trips(list[T]):
    """The trips that a mission has to do: a list that only its modifiers may change."""

    __slots__ = ("_keeper", "_kept")

    def __init__(self, trips: Iterable[T] = ()) -> None:
        super().__init__(trips)
        self._keeper: Keeper | None = None
        self._kept: list[T] = [*self]
        """The trips for the runtime: without what a hook has changed that runs still."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Copy it without its keeper."""
        return Trips, ([*self],)


def trips_of(mission: Any) -> list[Any]:
    """Return a mission's trips to do for the runtime, to be read: without what a hook is changing."""
    kept: list[Any] = mission.trips._kept
    return kept


def current_of(mission: Any) -> Any:
    """Return the mission's trip that flies now or next, for the runtime."""
    return first_of(trips_of(mission), mission.completed_trips)


def first_of(trips: Sequence[Any], completed: Sequence[Any]) -> Any:
    """Return the first trip to do; when none is left, the one flown last."""
    if trips:
        return trips[0]
    if not completed:
        raise MissionFailed("no trip is left to fly")
    return completed[-1]


def put_trips(mission: Any, trips: Iterable[Any]) -> None:
    """Give a mission trips to do, as the runtime does, whatever a hook is changing."""
    kept = trips_of(mission)
    kept[:] = trips
    list.__setitem__(mission.trips, slice(None), kept)


def drop_trip(mission: Any, trip: object) -> None:
    """Take a trip away, as the runtime does."""
    for trips in mission.trips, trips_of(mission):
        if trip in trips:  # trips are equal only to themselves
            list.remove(trips, trip)


def _guarded(name: str) -> Callable[..., Any]:
    change = getattr(list, name)

    def guarded(trips: Trips[Any], *given: Any, **named: Any) -> Any:
        if (keeper := keeper_of(trips)) is not None:
            keeper.must_edit("mission.trips cannot be changed here")
        returned = change(trips, *given, **named)
        if keeper is None:
            trips._kept[:] = trips
        return returned

    return guarded


for _name in (
    *("append", "clear", "extend", "insert", "pop", "remove", "reverse", "sort"),
    *("__delitem__", "__iadd__", "__imul__", "__setitem__"),
):
    setattr(Trips, _name, _guarded(_name))


def list_of_trips(value: object) -> Iterable[Any]:
    """Return what a hook sets as a mission's trips, if it is a list or a tuple of something."""
    if not issubclass(type(value), (list, tuple)):
        raise TypeError(f"mission.trips must be a list of trips, not {class_of(value)}")
    return value  # type: ignore[return-value]  # `issubclass` of its type narrows nothing for mypy
