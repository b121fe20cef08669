"""What tests of hooks are written with in an app with events, beside `alone/testing.py`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Generic, NamedTuple

from ..alone import testing as without_events
from ..alone.testing import Given, M, T
from ..domain.model import Mission, Point, Sighting
from ..domain.values import point
from .declared import FACTS, Event, EventType, read_occurrence
from .raising import BUILT_IN, EventsOf


class Emitted(NamedTuple):
    """An event that a hook has raised."""

    event: str
    facts: dict[str, Any]


class KitContext(without_events.KitContext):
    """A hook's context, with what a test gives to it and reads back."""

    def __init__(self, types: Mapping[str, EventType], *given: Any) -> None:
        super().__init__(*given)
        self._types = types
        self.emitted: list[Emitted] = []
        """The events that the hook has raised."""
        self.stored: list[object] = []
        """The results that it has kept."""
        self.missions: tuple[Mission[Any], ...] = ()
        """The missions that it can look at."""
        self.cancelled: list[tuple[Mission[Any], str]] = []
        """The missions that a creator has cancelled, with its reasons."""
        self._sights: list[Sighting] = []

    def see(self, track: str, *, kind: str = "", at: Point = (0.0, 0.0, 0.0)) -> None:
        """Have something move in the view of the drone's camera from now on."""
        self._sights.append(Sighting(track, kind, at))

    def emit(self, event: str, **facts: Any) -> None:
        """Raise an event; one that the app does not declare, or with wrong fields, is a `ValueError`, as in a flight."""
        _read(self._types, event, facts)
        self.emitted.append(Emitted(event, facts))

    def store(self, value: object) -> None:
        """Keep a result of the trip in flight."""
        self.stored.append(value)

    def cancel(self, mission: Mission[Any], why: str) -> None:
        """End a mission."""
        self.cancelled.append((mission, why))

    def live(self, drone: Any) -> Any:
        """Return the drone of this action, whose sensors can be read while it flies."""
        return _SeeingDrone(super().live(drone), self._sights)


class _SeeingDrone:
    """A live drone whose camera sees what the test says."""

    def __init__(self, live: Any, sights: list[Sighting]) -> None:
        self._live = live
        self._sights = sights

    def __getattr__(self, name: str) -> Any:
        return getattr(self._live, name)

    async def sees(self) -> list[Sighting]:
        """Return what moves in the view of its camera."""
        return [*self._sights]


class AppKit(without_events.AppKit[M, T, Given], Generic[M, T, Given]):
    """What the hooks of an app with events are given, for one test."""

    def context(self) -> KitContext:
        """Return a context, for the hooks that it is handed to."""
        return KitContext(self._types(), self.clock, self._store, self._none)

    def event(self, name: str, *, at: Point | None = None, **facts: Any) -> Event:
        """Return an occurrence of an event, for a creator; raise `ValueError` if there is no such."""
        types = self._types()
        time = facts.pop("time", self.clock.now)
        read = _read(types, name, facts if at is None else {**facts, "at": at})
        return types[name].type(**{"id": f"{name}-1", "name": name, "time": time, **read})

    def _types(self) -> dict[str, EventType]:
        events = [part for part in self._app.parts if isinstance(part, EventsOf)]
        return {kind.name: kind for part in events for kind in (*part.types, *BUILT_IN)}


def _read(types: Mapping[str, EventType], name: str, facts: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is said of an occurrence, read as in a flight, on a map without an end."""
    of_all = {key: one for key, one in facts.items() if key in (*FACTS, "at") and one is not None}
    fields = {key: one for key, one in facts.items() if key not in (*FACTS, "at")}
    return read_occurrence(types, name, {**of_all, "fields": fields}, _place, ValueError)


def _place(value: object) -> Point:
    x, y, z = [*point(value), 0.0][:3]
    return x, y, z
