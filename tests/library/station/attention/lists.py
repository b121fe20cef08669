"""Rows as a station makes them, and a list of alerts beside them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pluto_fleet.station.attention.attention import Attention
from pluto_fleet.station.attention.causes import Cause
from pluto_fleet.station.wire import Alert, DroneRow, MissionRow, Result, Words
from pluto_fleet.station.words import words


def drone(
    id: str,
    status: str,
    why: str = "",
    ready_in: float | None = None,
    retired: bool = False,
) -> DroneRow:
    row: DroneRow = {
        "id": id,
        "status": status,
        "x": 1.0,
        "y": 2.0,
        "z": 0.0,
        "seen_at": None,
        "battery": 0.4,
        "mission": None,
        "trips": 0,
        "retired": retired,
        "why": why,
    }
    if ready_in is not None:
        row["ready_in"] = ready_in
    return row


def mission(
    name: str,
    status: str = "STANDBY",
    reason: str = "",
    *,
    wait: Words | None = None,
    late: bool = False,
    answers: list[str] | None = None,
    at: str = "allocate",
) -> MissionRow:
    return {
        "name": name,
        "index": 0,
        "status": status,
        "reason": reason,
        "trips": [
            {"name": "A", "status": "WAITING", "x": 3.0, "y": 4.0, "priority": None, "action": "m"}
        ],
        "current": 0,
        "done": 0,
        "total": 1,
        "drone": None,
        "at": [at],
        "wait": wait,
        "until": None,
        "attempt": 1,
        "attempts": 0,
        "round": 0,
        "question": (
            None
            if answers is None
            else {"said": words("question.other", reason, question=reason), "answers": answers}
        ),
        "due": 30.0 if late else None,
        "late": late,
        "fields": {},
    }


def result(number: int, *tags: str) -> Result:
    return {
        "number": number,
        "time": 1.0,
        "mission": "North",
        "trip": "A",
        "round": 0,
        "attempt": 1,
        "drone": "cf1",
        "kind": "photo",
        "action": "take_photo",
        "parameters": {},
        "target": [5.0, 6.0, 1.0],
        "at": None,
        "place": "Bed 3",
        "value": None,
        "values": [],
        "tags": [*tags],
        "layers": [],
    }


class Listed:
    """A list of alerts, and a clock that goes on by a second with every look."""

    def __init__(self, file: Path) -> None:
        self.file, self.time, self.version = file, 0.0, 0
        self.attention = Attention(file, lambda: self.time)

    def again(self) -> None:
        """Begin anew from what was kept, as a station does that was started again."""
        self.attention, self.version = Attention(self.file, lambda: self.time), 0

    def look(self, causes: Iterable[Cause], flight: str = "f") -> list[Alert]:
        """Return the alerts that are not over."""
        self.time += 1
        self.version += 1
        self.attention.look(flight, causes, self.version)
        return [one for one in self.attention.rows if not one["over"]]
