"""What pages are shown of a flight, as events of its journal: rows, and in what they have changed.

A drone's place and battery are no part of it: what it flew tells them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..process.untrusted import fields_of, fits
from .wire import Alert, DroneRow, MissionRow, State, TripRow

Row = Mapping[str, Any]

Frame = dict[str, Any]
"""A `Frame` of `wire.py`; its rows are those that pages were shown."""

NAMED_BY = {"missions": "name", "drones": "id", "alerts": "id"}
"""The kinds of rows, and the field by which one is known."""

MOVING = frozenset({"x", "y", "z", "battery", "seen_at", "ready_in"})
"""The fields of drones that always change in flight."""

_ROWS = {"missions": MissionRow, "drones": DroneRow, "alerts": Alert}
_GONE = fits(list[str])


class Noted:
    """What was shown last, by which it is known what has changed."""

    def __init__(self, without: frozenset[str] = frozenset()) -> None:
        """`without` are fields of drones that do not count."""
        self._without = without
        self._state: Row = {}
        self._rows: dict[str, dict[str, Row]] = {kind: {} for kind in NAMED_BY}

    def changes(self, state: Row, rows: Mapping[str, Iterable[Row]]) -> dict[str, Any]:
        """Return what has changed; a row that is the same object as before costs nothing."""
        found: dict[str, Any] = {}
        stands = {name: value for name, value in state.items() if name != "time"}
        if stands != self._state:
            found["state"] = self._state = stands
        for kind, some in rows.items():
            changes = self._changes(kind, some)
            if changes:
                found[kind] = changes
        return found

    def _changes(self, kind: str, rows: Iterable[Row]) -> dict[str, Any]:
        known = self._rows[kind]
        changes = {}
        for row in rows:
            name = row[NAMED_BY[kind]]
            before = known.get(name)
            if row is before:
                continue
            if kind == "drones":
                row = {key: value for key, value in row.items() if key not in self._without}
            known[name] = row
            change = change_of(before, row)
            if change:
                changes[name] = change
        return changes


class Shown:
    """What is shown at an instant: the state, and every row."""

    def __init__(self) -> None:
        self.t: float | None = None
        """The instant; None: nothing has been shown yet."""
        self.state: dict[str, Any] = {}
        self.rows: dict[str, dict[str, dict[str, Any]]] = {kind: {} for kind in NAMED_BY}
        """By kind and name."""

    def take(self, event: Row) -> Frame:
        """Take an event; return what changes. Raises an error of any kind if it says nothing of rows."""
        state = event.get("state", self.state)
        if not _suits(state, State) or "phase" not in state:
            raise ValueError("no state is like that")
        self.state = state
        frame: Frame = {}
        for kind, by in NAMED_BY.items():
            changes = event.get(kind, {})
            if not all(_suits(change, _ROWS[kind]) for change in changes.values()):
                raise ValueError(f"no {kind} are like that")
            named = self.rows[kind]
            for name, change in changes.items():
                named[name] = {**changed(named.get(name), change), by: name}
            frame[kind] = [named[name] for name in changes]
        return frame

    def take_frame(self, frame: Frame) -> None:
        """Take a frame."""
        self.t = frame["t"]
        self.state = frame["state"]
        for kind, by in NAMED_BY.items():
            self.rows[kind].update((row[by], row) for row in frame.get(kind, ()))

    def whole(self) -> Frame:
        """Return a keyframe of it."""
        rows = {kind: list(named.values()) for kind, named in self.rows.items()}
        return {"t": self.t, "state": {**self.state, "time": self.t}, **rows}


def change_of(before: Row | None, row: Row) -> dict[str, Any]:
    """Return the fields of a row that are others than before; `-` has those that are gone."""
    if before is None:
        return dict(row)
    change = {
        name: _trips(before.get(name), value) if name == "trips" else value
        for name, value in row.items()
        if name not in before or (before[name] is not value and before[name] != value)
    }
    gone = [name for name in before if name not in row]
    return {**change, "-": gone} if gone else change


def _trips(before: Any, trips: Any) -> Any:
    """Return of as many trips as before those that have changed, by their places, and else all."""
    if not (isinstance(before, list) and isinstance(trips, list) and len(before) == len(trips)):
        return trips
    pairs = enumerate(zip(before, trips, strict=True))
    return {str(place): change_of(one, other) for place, (one, other) in pairs if one != other}


def changed(before: Row | None, change: Row) -> dict[str, Any]:
    """Return a row with such a change made."""
    row = dict(before or {})
    for name, value in change.items():
        if name == "-":
            for gone in value:
                row.pop(gone, None)
        elif name == "trips" and isinstance(value, dict):
            parts = list(row["trips"])
            for place, part in value.items():
                parts[int(place)] = {**parts[int(place)], **part}
            row["trips"] = parts
        else:
            row[name] = value
    return row


def _suits(change: object, hint: Any) -> bool:
    """Return whether all that is said of a row is of its type."""
    if not isinstance(change, dict):
        return False
    tests = fields_of(hint)
    for name, value in change.items():
        if name == "trips" and isinstance(value, dict):
            if not all(_suits(part, TripRow) for part in value.values()):
                return False
        elif not (_GONE if name == "-" else tests.get(name, _unknown))(value):
            return False
    return True


def _unknown(_: object) -> bool:
    """Accept what no page reads."""
    return True
