"""Rows as a station makes them, and a list of alerts beside them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, cast

from pluto_fleet.station.attention.attention import Attention
from pluto_fleet.station.attention.causes import Cause
from pluto_fleet.station.wire import Alert, DroneRow, MissionRow, Result, Words
from pluto_fleet.station.words import words


def drone(
    id: str, status: str, why: str = "", ready_in: float | None = None, retired: bool = False
) -> DroneRow:
    row = {"id": id, "status": status, "x": 1.0, "y": 2.0, "battery": 0.4, "retired": retired}
    charges = {} if ready_in is None else {"ready_in": ready_in}
    return cast(DroneRow, {**row, "why": why, **charges})


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
    row: dict[str, Any] = {
        "name": name,
        "status": status,
        "reason": reason,
        "at": [at],
        "wait": wait,
    }
    row |= {
        "trips": [{"name": "A", "x": 3.0, "y": 4.0}],
        "current": 0,
        "drone": None,
        "question": None,
    }
    if answers is not None:
        said = words("question.other", reason, question=reason)
        row["question"] = {"said": said, "answers": answers}
    return cast(MissionRow, {**row, "due": 30.0 if late else None, "late": late})


def result(number: int, *tags: str) -> Result:
    row = {"number": number, "mission": "North", "trip": "A", "drone": "cf1", "place": "Bed 3"}
    return cast(Result, {**row, "target": [5.0, 6.0, 1.0], "at": None, "tags": [*tags]})


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
