"""Recording events in the journal before they have any effect outside (write-ahead).

It listens to the trace, adds to an event what a later run must know and a reader of the trace need not,
and appends the events of each instant to the journal as one row: all or none. A command to a drone waits
until its row is durable.
"""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.mission_data import change_data, fields_of, trip_data
from plutoc_runtime.time.future import Future

from .event_line import exact
from .fold import Record, Records
from .values import mission_data, value_data

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission, ResultStore
    from plutoc_runtime.domain.trace import Event, Trace
    from plutoc_runtime.time.kernel import Kernel

Facts = dict[str, Any]


class Sink(Protocol):
    """Receives rows."""

    def add(self, row: str) -> int:
        """Add a row and return its number; `Recorder.durable` is called with that number, or a higher one."""
        ...


class Recorder:
    """Records one run of an app."""

    def __init__(self, app: App, kernel: Kernel, sink: Sink, records: Records) -> None:
        self._app, self._kernel, self._sink = app, kernel, sink
        self.records = records
        self.missions: dict[str, Mission[Any]] = {}
        """The missions by name, from their creation on."""
        self.results: ResultStore | None = None
        self.trace: Trace | None = None
        self._lines: list[str] = []
        """The events of this instant."""
        self._waiting: deque[tuple[int, Callable[[], object]]] = deque()
        """The calls that wait for a row to be durable, in order."""
        self._added = self._durable = 0
        self._due: list[Callable[[], object]] = []
        """The calls that wait for this instant's row."""
        kernel.settled = self._settle

    def take(self, event: Event) -> None:
        """Add an event to those of its instant."""
        add = _ADDED.get(str(event["event"]))
        if add is not None:
            event = {**event, **add(self, event)}
        written = exact(event)
        self._lines.append(written)
        if event["event"] in _SHARED:
            event = json.loads(written)  # a copy, independent of the mission and its hooks
        self.records.take(event)

    def when_durable(self, call: Callable[[], object]) -> None:
        """Call this as soon as all that has happened up to now is durable; not before this instant
        is over."""
        self._due.append(call)

    async def on_record(self) -> None:
        """Wait until everything up to now is durable."""
        durable: Future[None] = Future()
        self.when_durable(lambda: durable.set(None))
        await durable

    def durable(self, number: int) -> None:
        """Called within the kernel when the rows up to this number are durable."""
        self._durable = max(self._durable, number)
        waiting = self._waiting
        while waiting and waiting[0][0] <= self._durable:
            waiting.popleft()[1]()

    def look(self, mission: Mission[Any]) -> None:
        """Record it as an event if a hook that was given this mission has changed its trips."""
        app, record = self._app, self.records.missions[mission.name]
        todo = [trip_data(app, trip) for trip in mission.trips]
        fields = fields_of(app, Entity.MISSION, mission)
        forgotten = len(mission.completed_trips) != len(record["done"])
        same = not forgotten and todo == [_as_new(trip) for trip in record["todo"]]
        if not same or fields != record["fields"]:
            assert self.trace is not None
            self.trace.note("mission.changed", **change_data(app, mission))

    def _settle(self) -> None:
        """Append the row of an instant that has ended, with the calls that wait for it."""
        if self._lines:
            row = "[" + ",\n".join(self._lines) + "]"
            self._lines.clear()
            self._added = self._sink.add(row)
        if self._due:
            due, self._due = self._due, []
            for call in due:
                self._waiting.append((self._added, call))
            self.durable(self._durable)


def _as_new(trip: Record) -> Record:
    """Return a trip's record as `trip_data` writes it."""
    data = {fact: value for fact, value in trip.items() if fact not in _OF_FLIGHTS}
    if data.get("attempt") == 1:
        del data["attempt"]
    if not data.get("fields", True):
        del data["fields"]
    return data


_OF_FLIGHTS = ("start_time", "end_time", "reason")


def _plan(recorder: Recorder, event: Event) -> Facts:
    mission = recorder.missions[str(event["mission"])]
    return {"plan": mission_data(recorder._app, mission)}


def _result(recorder: Recorder, _: Event) -> Facts:
    assert recorder.results is not None
    return {"result": value_data(recorder.results.newest)}


def _fields(recorder: Recorder, event: Event) -> Facts:
    trip = recorder.missions[str(event["mission"])].current
    return {"fields": fields_of(recorder._app, Entity.TRIP, trip)}


def _added(recorder: Recorder, event: Event) -> Facts:
    names, trips = event["add"], recorder.missions[str(event["mission"])].trips
    assert isinstance(names, list)
    return {"trips": [trip_data(recorder._app, trip) for trip in trips if trip.name in names]}


_SHARED = ("mission.created", "mission.changed", "mission.extended", "trip.reset")
"""The events with parts that a hook may still change."""

_ADDED: dict[str, Callable[[Recorder, Event], Facts]] = {
    "mission.created": _plan,
    "trip.completed": _result,
    "trip.reset": _fields,
    "mission.extended": _added,
}
"""What a later run must know of an event, beside what is in the trace."""
