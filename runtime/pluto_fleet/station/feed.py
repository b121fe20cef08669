"""Incremental updates for pages: console lines, results, and changed rows."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ..jobs.flown import ACTS_BESIDE
from ..report.sentences import line_of, sentence_of
from ..shared.domain.actions import MEASURE, PICK, RELEASE
from ..shared.domain.text import bounded

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.trace import Event
    from .wire import LineKind, LogLine, Result, ResultKind

Row = TypeVar("Row", bound=Mapping[str, object])


class VersionedRows(Generic[Row]):
    """Rows by name, each as JSON with the version of its last change."""

    def __init__(self) -> None:
        self._rows: dict[str, tuple[int, Row, str]] = {}

    def put(self, name: str, row: Row, number: int) -> bool:
        """Store a row; return whether it has changed."""
        known = self._rows.get(name)
        if known is not None and known[1] == row:
            return False
        self._rows[name] = number, row, json.dumps(row)
        return True

    def drop(self, name: str) -> None:
        """Forget a row; pages that have it keep it."""
        self._rows.pop(name, None)

    def __iter__(self) -> Iterator[Row]:
        return (row for _, row, _ in self._rows.values())

    def since(self, number: int) -> Iterator[str]:
        """Yield the rows that have changed after a version."""
        return (text for changed, _, text in self._rows.values() if changed > number)


UNITS: Mapping[str, str] = {"temperature": "°C", "pm10": "µg/m³"}
"""What the numbers of a simulated world mean; any other quantity has the unit that its author had
in mind."""

LINES_KEPT = 20_000
"""The number of lines, and of results, that are kept; older ones are only in the journal."""

FINDINGS_KEPT = 100
"""The number of results with findings of which pages are alerted."""

LINES_A_MESSAGE = 500
"""The most lines in one message: the newest ones."""

LONGEST_VALUE = 1_000
"""Characters of an action's result on pages; all of it is in the results' file."""

LARGEST_ROUNDED = 1_000_000
"""Pages show six digits of a number; larger whole numbers are sent as text, in full."""


class Tail(Generic[Row]):
    """The newest entries of an append-only list, numbered from 1."""

    def __init__(self) -> None:
        self.last = 0
        self._texts: deque[str] = deque(maxlen=LINES_KEPT)

    @property
    def next(self) -> int:
        """The number that the next entry has."""
        return self.last + 1

    def add(self, entry: Row) -> None:
        """Append an entry."""
        self.last += 1
        self._texts.append(json.dumps(entry))

    def since(self, number: int) -> Iterator[str]:
        """Yield the entries after a number, up to the most in one message."""
        new = min(self.last - number, LINES_A_MESSAGE, len(self._texts))
        return (self._texts[place] for place in range(-new, 0))


class Feed:
    """The console and the results of one flight."""

    def __init__(self, app: App, units: Mapping[str, str]) -> None:
        """`units` are those of the quantities that `measure` measures, if known."""
        self._app, self._units = app, units
        self.log: Tail[LogLine] = Tail()
        self.results: Tail[Result] = Tail()
        self.findings: deque[Result] = deque(maxlen=FINDINGS_KEPT)
        """The newest results in which something was found."""
        self._lines: deque[str] = deque(maxlen=LINES_KEPT)
        self._brought: deque[object] = deque(maxlen=LINES_KEPT)
        """The results as they are downloaded, with the full values that pages get shortened."""
        self._beside: dict[tuple[object, object], object] = {}
        """Where actions are done that are done beside their targets, by mission and trip."""

    def take(self, event: Mapping[str, Any]) -> None:
        """Process a durable event."""
        said = sentence_of(event)
        if said is not None:
            self._lines.append(line_of(event) or "")
            self._line(event["t"], event.get("mission"), said, _kind(event))
        verdict = _VERDICTS.get(str(event["event"]))
        if event["event"] == ACTS_BESIDE:
            self._beside[event["mission"], event["trip"]] = event["at"]
        elif event["event"] == "trip.failed":
            self._beside.pop((event["mission"], event["trip"]), None)
        elif event["event"] == "trip.completed":
            self._completed(event)
        elif verdict is not None:
            self._result(event, "verdict", f"{verdict}: {event.get('reason') or said}")

    def say(self, time: float, text: str, kind: LineKind = "info") -> None:
        """Add a line that is not an event of the flight."""
        self._lines.append(f"{time:>8.1f} s  {text}")
        self._line(time, None, text, kind)

    def _line(self, time: float, mission: str | None, text: str, kind: LineKind) -> None:
        number = self.log.next
        self.log.add(
            {"number": number, "time": time, "mission": mission, "text": text, "kind": kind}
        )

    def console(self) -> str:
        """Return all kept lines as text."""
        return "".join(f"{line}\n" for line in self._lines)

    def brought(self) -> list[object]:
        """Return the kept results, each as a mapping."""
        return list(self._brought)

    def _completed(self, event: Mapping[str, Any]) -> None:
        """Add the result of a trip's action, with its quantity and place."""
        trip: Any = event["did"]
        action = self._app.actions[trip["action"]]
        usual = {one.name: one.default for one in action.parameters}
        given = {**usual, **trip.get("parameters", {})}
        kind, value = _value(event.get("result"))
        quantity = None
        if action.name == MEASURE and kind != "photo":
            kind, quantity = "measurement", given.pop("quantity")
        unit = self._units.get(str(quantity))
        done: dict[str, Any] = {"action": action.name, "target": trip["target"]}
        done["parameters"] = given
        if at := self._beside.pop((event["mission"], event["trip"]), None):
            done["at"] = at
        self._result(event, kind, value, done, quantity, unit)

    def _result(
        self,
        event: Mapping[str, Any],
        kind: ResultKind,
        value: Any,
        done: Mapping[str, Any] = MappingProxyType({}),
        quantity: str | None = None,
        unit: str | None = None,
    ) -> None:
        """Add a result; `done` is what was done for it, and where."""
        said = (
            value if kind == "photo" or done.get("action") in (PICK, RELEASE) else _in_words(value)
        )
        result: Result = {
            "number": self.results.next,
            "time": event["t"],
            "mission": event["mission"],
            "trip": event.get("trip"),
            "round": event.get("round"),
            "attempt": event.get("attempt"),
            "drone": event.get("drone"),
            "kind": kind,
            "action": done.get("action"),
            "parameters": done.get("parameters", {}),
            "target": done.get("target"),
            "at": done.get("at"),
            "place": None,
            "value": said,
            "values": [],
            "tags": [],
        }
        if quantity is not None and isinstance(value, (int, float)):
            result["values"] = [{"quantity": quantity, "value": value, "unit": unit}]
        self.results.add(result)
        if result["tags"]:
            self.findings.append(result)
        facts = {key: fact for key, fact in result.items() if key in _FILED}
        asked = {"quantity": quantity, "unit": unit} if done else {}
        self._brought.append({**facts, "value": value, **done, **asked})


_FILED = ("number", "time", "mission", "trip", "round", "attempt", "drone", "kind")
"""What the results' file has of every result; of a verdict nothing more than its value."""


def _value(data: Any) -> tuple[ResultKind, Any]:
    """Return the kind of a result for pages, and its value."""
    if isinstance(data, dict) and "$photo" in data:
        return "photo", {**data["$photo"], "picture": None}
    return "result", _plain(data)


def _plain(data: Any) -> object:
    """Return a value of the journal without the journal's reserved keys."""
    match data:
        case {"$photo": inside} | {"$text": inside} | {"$number": inside}:
            return inside
        case {"$tuple": list(parts)} | list(parts):
            return [_plain(part) for part in parts]
        case dict():
            return {name: _plain(part) for name, part in data.items()}
        case _:
            return data


def _in_words(value: Any) -> Any:
    """Return an action's result as text for a page."""
    match value:
        case None:
            return "nothing"
        case int() if abs(value) >= LARGEST_ROUNDED:
            return str(value)
        case list() | dict():
            value = json.dumps(value, ensure_ascii=False)
    return bounded(value, LONGEST_VALUE) if isinstance(value, str) else value


_VERDICTS = {"mission.judged": "not accepted", "mission.extended": "more to do"}

_BAD = (
    *("trip.failed", "mission.judged", "mission.late", "mission.uncertain", "mission.held"),
    "drone.lost",
)


def _kind(event: Event) -> LineKind:
    """Return the style of a line: `good`, `bad`, `hook` (the app's own text), or `info`."""
    kind = event["event"]
    if kind == "log":
        return "hook"
    if kind in _BAD or event.get("status") == "FAILED":
        return "bad"
    return "good" if kind == "mission.ended" and event["status"] == "COMPLETED" else "info"
