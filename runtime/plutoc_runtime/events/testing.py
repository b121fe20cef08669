"""What tests of hooks are written with in an app with events, beside `alone/testing.py`."""

from __future__ import annotations

from typing import Any, Generic, NamedTuple

from ..alone import testing as without_events
from ..alone.testing import Given, M, T
from ..domain.model import Mission, Point, Sighting
from .declared import Event
from .raising import BUILT_IN, EventsOf


class Emitted(NamedTuple):
    """An event that a hook has raised."""

    event: str
    facts: dict[str, Any]


class KitContext(without_events.KitContext):
    """A hook's context, with what a test gives to it and reads back."""

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
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
        """Raise an event."""
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
        return KitContext(self.clock, self._store, self._none)

    def event(self, name: str, *, at: Point | None = None, **facts: Any) -> Event:
        """Return an occurrence of an event, for a creator."""
        types = {
            kind.name: kind
            for part in self._app.parts
            if isinstance(part, EventsOf)
            for kind in (*part.types, *BUILT_IN)
        }
        given = {"id": f"{name}-1", "time": self.clock.now, **facts}
        return types[name].type(name=name, at=at, **given)
