"""Parts of a replay, which a page fetches one after the other, or from where it is scrubbed to."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...journal.facts import SHOWN
from ..results.rows import NameOf, nowhere
from ..shown import changed
from .frames import frames_of, opened_at
from .logbook import logbook
from .ways import Ways

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...app import App
    from ..shown import Frame
    from ..wire import FlightSummary, Replay, TrackWay
    from .reading import Event, JournalText

BATTERY_STEP = 0.01
BATTERY_EVERY = 60.0
"""A level is told that differs by so much from the one before, or is so many seconds later."""

LARGEST_PART = 1_000_000
"""Characters of a part's frames as JSON, about; the frames of one instant are never parted."""

LINES, RESULTS = 5_000, 2_000
"""The most lines of the console and results in a replay, the last ones: the files have all."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Past:
    """One flight of the past, or a rehearsal."""

    id: str
    app: App
    read: Callable[[], JournalText]
    """Begins to read its journal."""
    summary: FlightSummary | None
    """None: it is a rehearsal."""
    name_of: NameOf = nowhere
    """What a place of the map is called."""

    def frames(self, start: float = 0.0) -> Iterator[Frame]:
        """Yield a keyframe of what was shown at `start`, and what changed since."""
        return self._frames(self.read, start)

    def _frames(self, read: Callable[[], JournalText], start: float) -> Iterator[Frame]:
        end = None if self.summary is None else self.summary["end"]
        phase = end if end in ("over", "stopped", "interrupted") else None
        return opened_at(frames_of(read, phase), start)

    def part(self, start: float) -> Replay:
        """Return the part that begins with what was shown at `start`."""
        frames: list[Any] = []
        size, following = 0, None
        texts: list[JournalText] = []

        def read() -> JournalText:
            texts.append(self.read())
            return texts[-1]

        for frame in self._frames(read, start):
            size += len(json.dumps(frame, separators=(",", ":"), default=str))
            if frames and size > LARGEST_PART and frame["t"] > frames[-1]["t"]:
                following = frame["t"]
                break
            frames.append(frame)
        summary = self.summary
        said = [text.damaged for text in texts] + ([summary["said"]] if summary else [])
        whole: Replay = {
            "flight": self.id,
            "begun_at": self.begun_at,
            "said": "; ".join(dict.fromkeys(filter(None, said))),
            "seconds": summary["seconds"] if summary is not None else _seconds(self.read()),
            "frames": frames,
            "next": following,
            "log": [],
            "results": [],
            "alerts": [],
            "events": [],
            "tracks": [],
            "batteries": {},
        }
        if start <= 0:
            self._add_whole_flight(whole)
        return whole

    def _add_whole_flight(self, whole: Replay) -> None:
        """Add what only the first part has."""
        book = logbook(self.app, self.read(), self.name_of)
        if book.said and book.said not in whole["said"]:
            whole["said"] = "; ".join(filter(None, (whole["said"], book.said)))
        whole["log"] = book.lines[-LINES:]
        whole["results"] = book.results[-RESULTS:]
        whole["events"] = book.events
        ways = Ways()
        alerts: dict[str, Any] = {}
        for _, events in self.read().instants():
            for event in events:
                ways.take(event)
                for id, change in (
                    event.get("alerts", {}).items() if event["event"] == SHOWN else ()
                ):
                    alerts[id] = {**changed(alerts.get(id), change), "id": id}
                for drone, level in _levels(event):
                    _add_level(whole["batteries"].setdefault(drone, []), event["t"], level)
        whole["alerts"] = [*alerts.values()]
        whole["tracks"] = ways.all()

    def ways(self) -> list[TrackWay]:
        """Return where all was that moved beside the drones."""
        ways = Ways(most=None)
        for _, events in self.read().instants():
            for event in events:
                ways.take(event)
        return ways.all()

    @property
    def begun_at(self) -> int | None:
        """When the instant 0 was, in milliseconds since 1970, if that is known."""
        if self.summary is not None:
            return self.summary["begun_at"]
        return round(self.read().path.stat().st_mtime * 1000)


def _seconds(rehearsal: JournalText) -> float:
    return max((float(event["t"]) for _, some in rehearsal.instants() for event in some), default=0)


def _levels(event: Event) -> Iterator[tuple[str, float]]:
    """Yield the drones of whose batteries an event tells, with their levels."""
    level = event.get("battery") if event["event"].startswith("drone.") else None
    if isinstance(level, list):
        level = level[-1]
    if isinstance(level, (int, float)) and "drone" in event:
        yield event["drone"], level
    if event["event"] == SHOWN:
        for drone, row in event.get("drones", {}).items():
            if isinstance(level := row.get("battery"), (int, float)):
                yield drone, level


def _add_level(pairs: list[list[float]], t: float, level: float) -> None:
    """Add a level to those of a drone, if it tells more than the last one."""
    if pairs and abs(level - pairs[-1][1]) < BATTERY_STEP and t - pairs[-1][0] < BATTERY_EVERY:
        return
    pairs.append([t, level])
