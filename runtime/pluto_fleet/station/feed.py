"""What pages are sent once and no more: lines of the console, results, and the rows that have changed."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import MEASURE, PICK, RELEASE
from plutoc_runtime.domain.text import bounded

from ..report.sentences import line_of, sentence_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.trace import Event


class VersionedRows:
    """Rows by their names, each as JSON with the number of its last change."""

    def __init__(self) -> None:
        self._rows: dict[str, tuple[int, object, str]] = {}

    def put(self, name: str, row: object, number: int) -> bool:
        """Keep a row; say whether it is another than it was."""
        known = self._rows.get(name)
        if known is not None and known[1] == row:
            return False
        self._rows[name] = number, row, json.dumps(row)
        return True

    def since(self, number: int) -> Iterator[str]:
        """Yield the rows that have changed after that number."""
        return (text for changed, _, text in self._rows.values() if changed > number)


LINES_KEPT = 20_000
"""Lines, and results; older ones are in the journal alone."""

LINES_A_MESSAGE = 500
"""Lines that a page gets in one message: the newest."""

LONGEST_VALUE = 1_000
"""Characters of what an action returned that pages get; all of it is among the results."""

LARGEST_ROUNDED = 1_000_000
"""Pages show six digits of a number: of a whole number that has more, they get all."""


class Tail:
    """The newest entries of a list that only grows; each has a number, from 1 on."""

    def __init__(self) -> None:
        self.last = 0
        self._texts: deque[str] = deque(maxlen=LINES_KEPT)

    def add(self, *facts: object) -> None:
        """Add an entry: its number, and these facts."""
        self.last += 1
        self._texts.append(json.dumps([self.last, *facts]))

    def since(self, number: int) -> Iterator[str]:
        """Yield those after that number, no more than a page can show."""
        new = min(self.last - number, LINES_A_MESSAGE, len(self._texts))
        return (self._texts[place] for place in range(-new, 0))

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)


class Feed:
    """What is told of one flight."""

    def __init__(self, app: App, units: Mapping[str, str]) -> None:
        """Begin; `units` are those of the quantities that `measure` measures, where they are known."""
        self._app, self._units = app, units
        self.log, self.results = Tail(), Tail()
        self._lines: deque[str] = deque(maxlen=LINES_KEPT)
        self._whole: deque[object] = deque(maxlen=LINES_KEPT)
        """What each of the results is, where pages get it in words."""

    def take(self, event: Event) -> None:
        """Something happened, and is on record."""
        said = sentence_of(event)
        if said is not None:
            self._lines.append(line_of(event) or "")
            self.log.add(event["t"], event.get("mission"), said, _kind(event))
        verdict = _VERDICTS.get(str(event["event"]))
        if event["event"] == "trip.completed":
            self._completed(event)
        elif verdict is not None:
            self._result(event, "verdict", f"{verdict}: {event.get('reason') or said}")

    def say(self, time: float, text: str, kind: str = "info") -> None:
        """Tell what is no event of the flight's."""
        self._lines.append(f"{time:>8.1f} s  {text}")
        self.log.add(time, None, text, kind)

    def console(self) -> str:
        """Return all lines that are kept, as a text."""
        return "".join(f"{line}\n" for line in self._lines)

    def brought(self) -> list[object]:
        """Return the results that are kept, each with names for its facts."""
        return [
            dict(zip(FACTS, json.loads(text), strict=False)) | {"value": value}
            for text, value in zip(self.results, self._whole, strict=True)
        ]

    def _completed(self, event: Event) -> None:
        """A trip's action was done: tell what it gave, of what, and where."""
        trip: Any = event["did"]
        action = self._app.actions[trip["action"]]
        usual = {one.name: one.default for one in action.parameters}
        given = {**usual, **trip.get("parameters", {})}
        kind, value = _value(event.get("result"))
        quantity = None
        if action.name == MEASURE and kind != "photo":
            kind, quantity = "measurement", given.pop("quantity")
        unit = self._units.get(str(quantity))
        self._result(event, kind, value, action.name, trip["target"], given, quantity, unit)

    def _result(
        self, event: Event, kind: str, value: object, action: str | None = None, *more: object
    ) -> None:
        facts = (event.get(fact) for fact in ("t", "mission", "trip", "round", "attempt", "drone"))
        said = value if kind == "photo" or action in (PICK, RELEASE) else _in_words(value)
        self.results.add(*facts, kind, said, *([action, *more] if action is not None else []))
        self._whole.append(value)


FACTS = (
    *("number", "time", "mission", "trip", "round", "attempt", "drone", "kind", "value"),
    *("action", "target", "parameters", "quantity", "unit"),
)
"""What is told of a result, in this order: of a verdict only what stands in the first line."""


def _value(data: Any) -> tuple[str, object]:
    """Return what kind of result a page must show, and what it is."""
    return "photo" if isinstance(data, dict) and "$photo" in data else "result", _plain(data)


def _plain(data: Any) -> object:
    """Return what is in the journal without the journal's own words."""
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
    """Return what came of an action as a page shows it."""
    match value:
        case None:
            return "nothing"
        case int() if abs(value) >= LARGEST_ROUNDED:
            return str(value)
        case list() | dict():
            value = json.dumps(value, ensure_ascii=False)
    return bounded(value, LONGEST_VALUE) if isinstance(value, str) else value


_VERDICTS = {"mission.judged": "not accepted", "mission.extended": "more to do"}

_BAD = ("trip.failed", "mission.judged", "mission.uncertain", "mission.held", "drone.lost")


def _kind(event: Event) -> str:
    """Return how a line is to be shown: `good`, `bad`, `hook` (the app's own words), or `info`."""
    kind = event["event"]
    if kind == "log":
        return "hook"
    if kind in _BAD or event.get("status") == "FAILED":
        return "bad"
    return "good" if kind == "mission.ended" and event["status"] == "COMPLETED" else "info"
