"""Incremental updates for pages: console lines, results, and changed rows."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ..journal.facts import DRAINED, SAID
from ..report.sentences import line_of, sentence_of
from .happened import EventRows
from .results.meaning import Meanings
from .results.rows import NameOf, ResultRows, nowhere

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.trace import Event
    from .wire import LineKind, LogLine, Result

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
        """Yield all rows; one that has not changed is the same object as before."""
        return (row for _, row, _ in self._rows.values())

    def since(self, number: int) -> Iterator[str]:
        """Yield the rows that have changed after a version."""
        return (text for changed, _, text in self._rows.values() if changed > number)


LINES_KEPT = 20_000
"""The number of lines, and of results, that are kept; older ones are only in the journal."""

ALERTED = 100
"""The number of results with findings, and of broken reserves, of which pages are alerted."""

AMENDED_KEPT = 100
"""The number of results of which pages are told what has become known later."""

LINES_A_MESSAGE = 500
"""The most lines in one message: the newest ones."""


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

    def amend(self, number: int, entry: Row) -> None:
        """Replace the entry of this number, if it is still kept."""
        place = number - self.last - 1
        if -len(self._texts) <= place:
            self._texts[place] = json.dumps(entry)

    def since(self, number: int) -> Iterator[str]:
        """Yield the entries after a number, up to the most in one message."""
        new = min(self.last - number, LINES_A_MESSAGE, len(self._texts))
        return (self._texts[place] for place in range(-new, 0))

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)


class Feed:
    """The console and the results of one flight."""

    def __init__(
        self,
        app: App,
        units: Mapping[str, str],
        flight: str = "",
        name_of: NameOf = nowhere,
    ) -> None:
        """`units` are those of quantities of which the app says none; `flight` is for its pictures."""
        meanings = Meanings(app.results, app.actions, units)
        self._rows = ResultRows(flight, app.actions, meanings, name_of)
        self.log: Tail[LogLine] = Tail()
        self.results: Tail[Result] = Tail()
        self.events = EventRows()
        """What has happened."""
        self.findings: deque[Result] = deque(maxlen=ALERTED)
        """The newest results in which something was found."""
        self.drained: deque[tuple[int, Event]] = deque(maxlen=ALERTED)
        """The newest events of broken reserves, numbered from 1."""
        self._reserves = 0
        self._fresh: list[str] = []
        """Results of which more is known than pages were told."""
        self._amended: deque[tuple[int, str]] = deque(maxlen=AMENDED_KEPT)
        """Results of which pages were told more, by the version of that."""
        self._lines: deque[str] = deque(maxlen=LINES_KEPT)
        self._whole: deque[object] = deque(maxlen=LINES_KEPT)
        """The full values of results that pages get shortened."""

    def take(self, event: Mapping[str, Any]) -> None:
        """Process a durable event."""
        said = sentence_of(event)
        if said is not None:
            self._lines.append(line_of(event) or "")
            self._line(event["t"], event.get("mission"), said, kind_of(event))
        self.events.take(event)
        if event["event"] == DRAINED:
            self._reserves += 1
            self.drained.append((self._reserves, event))
        brought = self._rows.take(event)
        if brought is None:
            return
        row, value = brought
        if row["number"] <= self.results.last:
            self._amend(row)
            return
        self.results.add(row)
        if row["tags"]:
            self.findings.append(row)
        self._whole.append(value)

    def _amend(self, row: Result) -> None:
        self.results.amend(row["number"], row)
        self._fresh.append(json.dumps(row))

    def look(self, version: int) -> bool:
        """Tell pages with this version of results that say more, and of events; return whether there are any."""
        fresh, self._fresh = self._fresh, []
        self._amended.extend((version, text) for text in fresh)
        return self.events.look(version) or bool(fresh)

    def amended_since(self, version: int) -> Iterator[str]:
        """Yield the results that say more since a version."""
        return (text for changed, text in self._amended if changed > version)

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

    @property
    def pictures(self) -> Mapping[int, str]:
        """The files of photos, by the numbers of their results."""
        return self._rows.pictures

    def brought(self) -> list[object]:
        """Return the kept results, each as a mapping, with their values in full."""
        return [
            json.loads(text) | {"value": value}
            for text, value in zip(self.results, self._whole, strict=True)
        ]


_BAD = (
    *("trip.failed", "mission.judged", "mission.late", "mission.uncertain", "mission.held"),
    *("drone.lost", "drone.drained"),
)


def kind_of(event: Event) -> LineKind:
    """Return the style of a line: `good`, `bad`, `hook` (the app's own text), or `info`."""
    kind = event["event"]
    if kind == "log":
        return "hook"
    if kind == SAID:
        said: LineKind = event["kind"]
        return said
    if kind in _BAD or event.get("status") == "FAILED":
        return "bad"
    return "good" if kind == "mission.ended" and event["status"] == "COMPLETED" else "info"
