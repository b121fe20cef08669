"""A replay of a flight that was not recorded, made of its journal's events: what they do not tell is
shown as unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ...flight.control import PRIORITY
from ...flight.lives import fleet_in
from ...flight.mission_status import aside
from ...gateway.sightings import Sighting
from ...journal import errors
from ...journal.facts import BROKEN
from ...shared.domain.errors import BadInput
from ...shared.domain.status import IN_THE_AIR
from ..rows import drone_at, living_row, recorded_row
from .frames import Frame
from .reading import JournalText
from .told import Told
from .tracks import Tracks

if TYPE_CHECKING:
    from ...app import App
    from ...journal.standing import Record
    from .reading import Event

STEP = 0.5
"""Seconds between two frames in which drones only move."""

MOST_STEPS = 50_000
"""The most frames in which drones only move: in a flight of over seven hours they are further apart."""

NOT_TOLD = "not known: this flight was not recorded"

_STATUS = {
    "drone.free": "FREE",
    "drone.busy": "BUSY",
    "drone.returning": "RETURNING",
    "drone.charging": "CHARGING",
    "drone.recovering": "RECOVERING",
    "drone.offline": "OFFLINE",
    "drone.lost": "LOST",
    "drone.brought_back": "UNKNOWN",
    "trip.launched": "BUSY",
}
"""The status of its drone after an event."""

_ALOFT = {status.value for status in IN_THE_AIR}


def folded_frames(app: App, read: Callable[[], JournalText]) -> Iterator[Frame]:
    """Yield what the events of a journal tell of each instant; the first frame has every row.

    The journal is read twice: a place is known only once a command has ended.
    """
    tracks = Tracks()
    last = 0.0
    for _, events in read().instants():
        for event in events:
            tracks.take(event)
            last = max(last, float(event["t"]))
    return _Folding(app, read(), tracks, max(STEP, last / MOST_STEPS)).frames()


class _Folding:
    def __init__(self, app: App, journal: JournalText, tracks: Tracks, step: float) -> None:
        self._app, self._journal, self._tracks = app, journal, tracks
        self._told = Told()
        self._step = step
        self._statuses: dict[str, str] = {}
        """By drone."""
        self._missions: dict[str, Mapping[str, Any]] = {}
        self._drones: dict[str, Mapping[str, Any]] = {}
        self._state: dict[str, Any] = {
            "phase": "flying",
            "plan": 0,
            "map": 0,
            "said": "",
            "how": None,
            "busy": "connecting",
        }
        self._priority = next((one.default for one in app.fields if one.name == PRIORITY), None)

    def frames(self) -> Iterator[Frame]:
        """Yield the frames."""
        last, epoch = 0.0, 0
        for instant, events in self._journal.instants():
            t = max(last, float(events[-1]["t"]))
            yield from self._on_the_way(last, t)
            if instant.epoch != epoch and self._missions:
                yield self._left(last)
            try:
                for event in events:
                    self._take(event)
            except BROKEN:
                self._journal.damaged = (
                    f"{self._journal.path}: {errors.does_not_follow(instant.seq)}"
                )
                break
            last, epoch = t, instant.epoch
            yield self._changed(t)
        yield self._left(last)

    def _take(self, event: Event) -> None:
        self._told.take(event)
        match event["event"]:
            case "journal.begun":
                try:
                    drones = fleet_in(self._app, self._journal.path, event).drones
                except (BadInput, *BROKEN):  # those that it mentions are shown all the same
                    drones = ()
                self._statuses = {drone.id: "UNKNOWN" for drone in drones}
            case "brain.began":
                self._state = {**self._state, "phase": "flying", "busy": "", "how": None}
            case "stopped":
                self._state = {**self._state, "phase": "stopping", "how": event["how"]}
        status = _STATUS.get(event["event"])
        if status is not None:
            self._statuses[event["drone"]] = status

    def _left(self, t: float) -> Frame:
        """Return the frame of a run that has ended: all that it knew of flights is not known now."""
        missions = self._told.missions.values()
        is_over = bool(missions) and all(record["ended"] for record in missions)
        was_stopped = self._state["phase"] == "stopping"
        phase = "over" if is_over else "stopped" if was_stopped else "interrupted"
        self._state = {**self._state, "phase": phase, "busy": "", "how": None}
        for drone, status in self._statuses.items():
            if status in _ALOFT:
                self._statuses[drone] = "UNKNOWN"
        return self._changed(t)

    def _changed(self, t: float) -> Frame:
        """Return a frame of what is another now."""
        known = sorted(self._told.missions.items(), key=lambda item: int(item[1]["index"]))
        rows = [self._mission(*one, t) for one in known]
        missions = [row for row in rows if self._missions.get(row["name"]) != row]
        self._missions.update((row["name"], row) for row in missions)
        return self._frame(t, missions, [self._drone(id, t) for id in self._statuses])

    def _on_the_way(self, since: float, until: float) -> Iterator[Frame]:
        """Yield frames of drones that move between two instants."""
        steps = int((until - since) / self._step)
        for step in range(1, steps + 1):
            t = since + step * self._step
            if t < until:
                frame = self._frame(t, [], [self._drone(id, t) for id in self._statuses])
                if frame["drones"]:
                    yield frame

    def _frame(self, t: float, missions: list[Any], drones: list[Any]) -> Frame:
        new = [row for row in drones if self._drones.get(row["id"]) != row]
        self._drones.update((row["id"], row) for row in new)
        return {
            "t": t,
            "state": {**self._state, "time": t},
            "missions": missions,
            "drones": new,
            "alerts": [],
        }

    def _mission(self, name: str, record: Record, t: float) -> Any:
        if record["ended"] or aside(record) is not None:
            return recorded_row(name, record, lives=not record["ended"])
        if self._state["phase"] not in ("flying", "stopping"):
            return recorded_row(name, record)
        flight = record["flight"]
        flies = flight is not None and flight["outcome"] is None
        where = {
            "block": "" if flies else record["at"] or "",
            "until": None,
            "drone": flight["drone"] if flies else record["carrier"],
            "flies": flies,
            "allocated": False,
        }
        first = [
            one
            for one in record["promises"].get("after", ())
            if not self._told.missions.get(one, record)["ended"]
        ]
        return living_row(
            name, record, where, self._app.resumes, self._priority, t, lambda *_: None, first
        )

    def _drone(self, id: str, t: float) -> Any:
        told = self._told
        known = self._tracks.at(id, t)
        why = told.lost.get(id, "" if known.at else NOT_TOLD)
        seen = None
        if known.at is not None:
            # `when` is any time at all: that is told by the frame, and taken out of the row below
            seen = Sighting(at=known.at, battery=known.battery or 0.0, landed=False, when=1.0)
        row: Any = drone_at(
            id,
            self._statuses[id],
            seen,
            told.flown.get(id, 0),
            id in told.retired,
            why,
        )
        row = {**row, "mission": self._work(id)}
        if known.battery is None:
            row["battery"] = None
        for field in ("seen", "seen_at"):
            if field in row:
                row[field] = None
        return row

    def _work(self, drone: str) -> str | None:
        """Return the mission for which a drone flies."""
        for name, record in self._told.missions.items():
            flight = record["flight"]
            if flight is not None and flight["drone"] == drone and flight["outcome"] is None:
                return name
            if record["carrier"] == drone:
                return name
        return None
