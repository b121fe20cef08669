"""Incremental updates for pages: console lines, results, and changed rows."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ..jobs.flown import ACTS_BESIDE
from ..report.sentences import line_of, sentence_of
from ..shared.domain.actions import MEASURE, PICK, RELEASE
from ..shared.domain.text import bounded

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.trace import Event


class VersionedRows:
    """Rows by name, each as JSON with the version of its last change."""

    def __init__(self) -> None:
        self._rows: dict[str, tuple[int, object, str]] = {}

    def put(self, name: str, row: object, number: int) -> bool:
        """Store a row; return whether it has changed."""
        known = self._rows.get(name)
        if known is not None and known[1] == row:
            return False
        self._rows[name] = number, row, json.dumps(row)
        return True

    def rows(self) -> list[Any]:
        """Return all rows; one that has not changed is the same object as before."""
        return [row for _, row, _ in self._rows.values()]

    def since(self, number: int) -> Iterator[str]:
        """Yield the rows that have changed after a version."""
        return (text for changed, _, text in self._rows.values() if changed > number)


UNITS: Mapping[str, str] = {"temperature": "°C", "pm10": "µg/m³"}
"""What the numbers of a simulated world mean; any other quantity has the unit that its author had
in mind."""

LINES_KEPT = 20_000
"""The number of lines, and of results, that are kept; older ones are only in the journal."""

LINES_A_MESSAGE = 500
"""The most lines in one message: the newest ones."""

LONGEST_VALUE = 1_000
"""Characters of an action's result on pages; all of it is in the results' file."""

LARGEST_ROUNDED = 1_000_000
"""Pages show six digits of a number; larger whole numbers are sent as text, in full."""


class Tail:
    """The newest entries of an append-only list, numbered from 1."""

    def __init__(self) -> None:
        self.last = 0
        self._texts: deque[str] = deque(maxlen=LINES_KEPT)

    def add(self, *facts: object) -> None:
        """Append an entry with these facts."""
        self.last += 1
        self._texts.append(json.dumps([self.last, *facts]))

    def since(self, number: int) -> Iterator[str]:
        """Yield the entries after a number, up to the most in one message."""
        new = min(self.last - number, LINES_A_MESSAGE, len(self._texts))
        return (self._texts[place] for place in range(-new, 0))

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)


class Feed:
    """The console and the results of one flight."""

    def __init__(self, app: App, units: Mapping[str, str]) -> None:
        """`units` are those of the quantities that `measure` measures, if known."""
        self._app, self._units = app, units
        self.log, self.results = Tail(), Tail()
        self._lines: deque[str] = deque(maxlen=LINES_KEPT)
        self._whole: deque[object] = deque(maxlen=LINES_KEPT)
        """The full values of results that pages get shortened."""
        self._beside: dict[tuple[object, object], object] = {}
        """Where actions are done that are done beside their targets, by mission and trip."""

    def take(self, event: Event) -> None:
        """Process a durable event."""
        said = sentence_of(event)
        if said is not None:
            self._lines.append(line_of(event) or "")
            self.log.add(event["t"], event.get("mission"), said, kind_of(event))
        verdict = _VERDICTS.get(str(event["event"]))
        if event["event"] == ACTS_BESIDE:
            self._beside[event["mission"], event["trip"]] = event["at"]
        elif event["event"] == "trip.failed":
            self._beside.pop((event["mission"], event["trip"]), None)
        elif event["event"] == "trip.completed":
            self._completed(event)
        elif verdict is not None:
            self._result(event, "verdict", f"{verdict}: {event.get('reason') or said}")

    def say(self, time: float, text: str, kind: str = "info") -> None:
        """Add a line that is not an event of the flight."""
        self._lines.append(f"{time:>8.1f} s  {text}")
        self.log.add(time, None, text, kind)

    def console(self) -> str:
        """Return all kept lines as text."""
        return "".join(f"{line}\n" for line in self._lines)

    def brought(self) -> list[object]:
        """Return the kept results, each as a mapping."""
        return [
            dict(zip(FACTS, json.loads(text), strict=False)) | {"value": value}
            for text, value in zip(self.results, self._whole, strict=True)
        ]

    def _completed(self, event: Event) -> None:
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
        at = self._beside.pop((event["mission"], event["trip"]), None)
        facts = [trip["target"], given, quantity, unit, *([] if at is None else [at])]
        self._result(event, kind, value, action.name, *facts)

    def _result(
        self, event: Event, kind: str, value: object, action: str | None = None, *more: object
    ) -> None:
        facts = (event.get(fact) for fact in ("t", "mission", "trip", "round", "attempt", "drone"))
        said = value if kind == "photo" or action in (PICK, RELEASE) else _in_words(value)
        self.results.add(*facts, kind, said, *([action, *more] if action is not None else []))
        self._whole.append(value)


FACTS = (
    *("number", "time", "mission", "trip", "round", "attempt", "drone", "kind", "value"),
    *("action", "target", "parameters", "quantity", "unit", "at"),
)
"""The facts of a result, in this order; of a verdict only those in the first line.

The last is there only where the action was not done at its target.
"""


def _value(data: Any) -> tuple[str, object]:
    """Return the kind of a result for pages, and its value."""
    return "photo" if isinstance(data, dict) and "$photo" in data else "result", _plain(data)


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


def _in_words(value: object) -> object:
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


def kind_of(event: Event) -> str:
    """Return the style of a line: `good`, `bad`, `hook` (the app's own text), or `info`."""
    kind = event["event"]
    if kind == "log":
        return "hook"
    if kind in _BAD or event.get("status") == "FAILED":
        return "bad"
    return "good" if kind == "mission.ended" and event["status"] == "COMPLETED" else "info"
