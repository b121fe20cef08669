"""From the events of a flight to the rows of what has happened in it, and what came of that."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ..shared.domain.text import cut_off
from .results.rows import plain

if TYPE_CHECKING:
    from ..shared.domain.trace import Event
    from .wire import EventRow

KEPT = 500
"""How many are known, the newest; all are in the journal."""

CHANGES_KEPT = 2 * KEPT
"""How many changes of them are known; most change once, when it is decided what comes of them."""

LONGEST = 200
"""Characters of a field, and of why nothing came of it; the full text is in the journal."""


class EventRows:
    """What has happened in one flight."""

    def __init__(self) -> None:
        self._rows: dict[str, EventRow] = {}
        self._fresh: dict[str, EventRow] = {}
        """Those of which pages were not told yet how they are now."""
        self._told: deque[tuple[int, str]] = deque(maxlen=CHANGES_KEPT)
        """How pages were told that they are, by the version of that."""

    def take(self, event: Event) -> None:
        """Process a durable event."""
        fact: Any = event.get
        match event["event"]:
            case "event.raised":
                self._put(_raised(event))
            case "event.dropped":  # it was raised while everything was stopped, and for too long
                self._put(
                    {**_raised(event), "why": cut_off(fact("why"), LONGEST), "over": fact("t")}
                )
            case "event.over" if (row := self._rows.get(fact("id"))) is not None:
                made = [*row["made"], fact("made")] if fact("made") else row["made"]
                why = cut_off(fact("why", row["why"]), LONGEST)
                self._put({**row, "made": made, "why": why, "over": fact("t")})
            case "trip.interrupted" if (row := self._rows.get(fact("by"))) is not None:
                self._put({**row, "broke_off": [*row["broke_off"], fact("mission")]})

    def _put(self, row: EventRow) -> None:
        self._rows[row["id"]] = self._fresh[row["id"]] = row
        if len(self._rows) > KEPT:
            del self._rows[next(iter(self._rows))]

    def __iter__(self) -> Iterator[EventRow]:
        """Yield them, the oldest first."""
        return iter(self._rows.values())

    def look(self, version: int) -> bool:
        """Tell pages with this version of those that have changed; return whether any has."""
        self._told.extend((version, json.dumps(row)) for row in self._fresh.values())
        changed = bool(self._fresh)
        self._fresh.clear()
        return changed

    def since(self, version: int) -> Iterator[str]:
        """Yield those that have changed after a version, as JSON."""
        return (text for changed, text in self._told if changed > version)


def _raised(event: Event) -> EventRow:
    fact: Any = event.get
    fields = {name: plain(value) for name, value in fact("fields", {}).items()}
    return {
        "id": fact("id"),
        "name": fact("kind"),
        "time": fact("t"),
        "at": fact("at"),
        "track": fact("track"),
        "mission": fact("mission"),
        "trip": fact("trip"),
        "drone": fact("drone"),
        "fields": {
            name: cut_off(value, LONGEST) if isinstance(value, str) else value
            for name, value in fields.items()
        },
        "made": [],
        "broke_off": [],
        "why": "",
        "over": None,
    }
