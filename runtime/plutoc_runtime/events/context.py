"""What hooks of an app with events can do beside: raise them, and in a creator, look at all missions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..hooks.context import Context

if TYPE_CHECKING:
    from ..domain.model import Mission, Point
    from .raising import Events


class EventContext(Context):
    """The running app, for a hook that may raise events."""

    __slots__ = ("_events",)

    def __init__(self, events: Events, *given: Any) -> None:
        super().__init__(*given)
        self._events = events

    @property
    def missions(self) -> tuple[Mission[Any], ...]:
        """All missions that have not ended, in their order; a hook changes none but its own."""
        return self._events.living

    def emit(
        self,
        event: str,
        *,
        id: str | None = None,
        at: Point | None = None,
        track: str | None = None,
        **fields: Any,
    ) -> None:
        """Raise an event, once for each `id`; without an `id`, each call is an occurrence of its own.

        Raises `ValueError` for an event, or a field, that the app does not declare.
        """
        request = {"id": id, "at": at, "track": track, "fields": fields, **self._origin()}
        given = {name: value for name, value in request.items() if value is not None}
        self._kernel.post(self._events.happen, event, given, ValueError)

    def store(self, value: object) -> None:
        """Keep a result of the trip in flight, as what an action returns is kept."""
        flight: Any = self._latest()
        if flight is None or flight.is_set:
            raise RuntimeError("a result is kept of a trip that is in flight")
        self._kernel.post(self._events.store, flight, value)

    def _origin(self) -> dict[str, Any]:
        flight: Any = self._latest()
        origin: dict[str, Any] = {"mission": self._mission.name}
        if flight is not None and not flight.is_set:
            origin.update(trip=flight.trip.name, drone=flight.drone)
        return origin


class CreatorContext(EventContext):
    """The running app, for a creator: it may look at all missions, and cancel them."""

    __slots__ = ("_cancel",)

    def __init__(
        self, cancel: Callable[[Mission[Any], str], object], events: Events, *given: Any
    ) -> None:
        super().__init__(events, *given)
        self._cancel = cancel

    def cancel(self, mission: Mission[Any], why: str) -> None:
        """End a mission as CANCELLED, wherever it is; one that has ended stays as it is."""
        self._kernel.post(self._cancel, mission, why)

    def _origin(self) -> dict[str, Any]:
        return {}
