"""What the events of a run must say so that another run can go on from them."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..domain.fields import Entity
from ..hooks.plain_data import Data, fields_of, mission_data, trip_data, value_data
from ..time.future import Future

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import ResultStore
    from ..domain.trace import Event
    from .mission import MissionState


class Recording:
    """Adds to events what a later run must know, and waits until they are durable."""

    def __init__(
        self,
        app: App,
        states: Mapping[str, MissionState],
        results: ResultStore,
        events: list[Event],
    ) -> None:
        self._app, self._states, self._results, self._events = app, states, results, events
        self._said = self._durable = 0
        """How many events there were, and how many of them are durable."""
        self._waiting: deque[tuple[int, Future[None]]] = deque()

    def hear(self, event: Event) -> None:
        """Keep an event, with what is added to it."""
        self._said += 1
        add = _ADDED.get(str(event["event"]))
        self._events.append(event if add is None else {**event, **add(self, event)})

    async def on_record(self) -> None:
        """Wait until everything up to now is durable."""
        if self._durable < self._said:
            durable: Future[None] = Future()
            self._waiting.append((self._said, durable))
            await durable

    def durable(self, message: Mapping[str, int]) -> None:
        """Called when so many events are durable."""
        self._durable = max(self._durable, message["durable"])
        while self._waiting and self._waiting[0][0] <= self._durable:
            self._waiting.popleft()[1].set(None)

    def _plan(self, event: Event) -> Data:
        return {"plan": mission_data(self._app, self._states[str(event["mission"])].mission)}

    def _result(self, _: Event) -> Data:
        return {"result": value_data(self._results.newest)}

    def _fields(self, event: Event) -> Data:
        trip = self._states[str(event["mission"])].mission.current
        return {"fields": fields_of(self._app, Entity.TRIP, trip)}

    def _trips(self, event: Event) -> Data:
        names, trips = event["add"], self._states[str(event["mission"])].mission.trips
        assert isinstance(names, list)
        return {"trips": [trip_data(self._app, trip) for trip in trips if trip.name in names]}


_ADDED: dict[str, Callable[[Recording, Event], dict[str, Any]]] = {
    "mission.created": Recording._plan,
    "trip.completed": Recording._result,
    "trip.reset": Recording._fields,
    "mission.extended": Recording._trips,
}
