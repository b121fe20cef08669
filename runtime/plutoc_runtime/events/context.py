"""What hooks of an app with events can do beside: raise them, and in a creator, look at all missions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from ..hooks import context as without_events

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..domain.model import Mission, Point
    from ..flow.flight import Flight


class Raises(Protocol):
    """The events of a running app."""

    @property
    def living(self) -> tuple[Mission[Any], ...]:
        """The missions that have not ended, in their order."""

    def emit(self, name: str, given: Mapping[str, Any]) -> None:
        """Note an occurrence that a hook raises, and let come of it what comes."""

    def cancel(self, mission: Mission[Any], why: str) -> None:
        """End a mission as CANCELLED."""

    def store(self, flight: Flight, value: object) -> None:
        """Keep a result of a trip in flight."""


@dataclass(frozen=True, slots=True)
class Outside:
    """Stands for the mission of a hook that is called for none."""

    index: int
    name: str | None = None


class Context(without_events.Context):
    """The running app, for a hook of an app with events. Times are seconds since the start."""

    __slots__ = ("_events",)

    def __init__(self, events: Raises, *given: Any) -> None:
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
        self._kernel.post(self._events.emit, event, given)

    def cancel(self, mission: Mission[Any], why: str) -> None:
        """End a mission as CANCELLED, wherever it is; for creators alone. One that has ended stays as it is."""
        if not isinstance(self._mission, Outside):
            raise RuntimeError("only a creator cancels missions")  # noqa: TRY004 - of no argument
        self._kernel.post(self._events.cancel, mission, why)

    def store(self, value: object) -> None:
        """Keep a result of the trip in flight, as what an action returns is kept."""
        flight: Any = self._latest()
        if flight is None or flight.is_set:
            raise RuntimeError("a result is kept of a trip that is in flight")
        self._kernel.post(self._events.store, flight, value)

    def _origin(self) -> dict[str, Any]:
        if isinstance(self._mission, Outside):
            return {}
        flight: Any = self._latest()
        origin: dict[str, Any] = {"mission": self._mission.name}
        if flight is not None and not flight.is_set:
            origin.update(trip=flight.trip.name, drone=flight.drone)
        return origin
