"""Parts of a replay, which a page fetches one after the other, or from where it is scrubbed to."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...shared.domain.text import counted
from ..results.rows import NameOf, nowhere
from .folded import folded_frames
from .frames import Frame, opened_at
from .logbook import logbook

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...app import App
    from ..wire import Replay
    from .digest import Digest
    from .reading import JournalText
    from .recorded import Recorded

LARGEST_PART = 1_000_000
"""Characters of a part's frames as JSON, about; the frames of one instant are never parted."""

LINES, RESULTS = 5_000, 2_000
"""The most lines of the console and results in a replay, the last ones: the files have all."""

SOON = 1.0
"""Seconds from the beginning of a flight within which a recording of it begins."""

NOT_RECORDED = (
    "what was seen of this flight was not recorded: this is what its journal tells,"
    " and the drones' ways are straight from one measurement to the next"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Past:
    """One flight of the past, or a rehearsal, which has no journal."""

    id: str
    app: App
    read: Callable[[], JournalText] | None
    """Begins to read its journal."""
    digest: Digest | None
    """That of its journal."""
    recorded: Recorded | None
    trouble: str = ""
    """What is wrong with its recording; empty: nothing."""
    name_of: NameOf = nowhere
    """What a place of the map is called."""

    def frames(self, start: float = 0.0) -> Iterator[Frame]:
        """Yield a keyframe of what was shown at `start`, and what changed since."""
        begins = None if self.recorded is None else self.recorded.begins
        unrecorded = self.read is not None and (
            begins is None or (start < begins and begins > SOON)
        )
        if unrecorded and self.read is not None:
            folded = opened_at(folded_frames(self.app, self.read), start)
            for frame in folded:
                if begins is not None and frame["t"] >= begins:
                    break
                yield frame
        if self.recorded is not None and begins is not None:
            yield from self.recorded.frames(max(start, begins) if unrecorded else start)

    @property
    def seconds(self) -> float:
        """The length of the replay."""
        recorded = self.recorded.seconds if self.recorded is not None else 0.0
        if recorded or self.digest is None:
            return recorded
        return self.digest.summary["seconds"]

    @property
    def said(self) -> str:
        """What is missing of it; empty: nothing."""
        said = [self.trouble] if self.trouble else []
        begins = None if self.recorded is None else self.recorded.begins
        if begins is None:
            said.append(NOT_RECORDED)
        elif begins > SOON and self.read is not None:
            said.append(f"up to {begins:.0f} s {NOT_RECORDED}")
        if self.recorded is not None and self.recorded.holes:
            places = ", ".join(f"{t:.0f} s" for t in self.recorded.holes)
            said.append(f"a part of the recording is damaged, and left out, after {places}")
        if self.recorded is not None and self.recorded.left_out:
            lines = counted(self.recorded.left_out, "line")
            said.append(f"{lines} of the recording say nothing that can be shown, and are left out")
        if self.digest is not None and self.digest.summary["said"]:
            said.append(self.digest.summary["said"])
        return "; ".join(said)

    def part(self, start: float) -> Replay:
        """Return the part that begins with what was shown at `start`."""
        frames: list[Any] = []
        size, following = 0, None
        for frame in self.frames(start):
            size += len(json.dumps(frame, separators=(",", ":"), default=str))
            if frames and size > LARGEST_PART and frame["t"] > frames[-1]["t"]:
                following = frame["t"]
                break
            frames.append(frame)
        whole: Replay = {
            "flight": self.id,
            "begun_at": self.begun_at,
            "recorded": self.recorded is not None and self.recorded.begins is not None,
            "said": self.said,
            "seconds": self.seconds,
            "frames": frames,
            "next": following,
            "log": [],
            "results": [],
            "alerts": [],
            "batteries": {},
        }
        if start <= 0:
            self._add_whole_flight(whole)
        return whole

    def _add_whole_flight(self, whole: Replay) -> None:
        """Add what only the first part has."""
        recorded = self.recorded
        said = recorded.said if recorded is not None else ()
        if self.read is not None:
            book = logbook(self.app, self.read(), said, self.name_of)
            log, results = book.lines, book.results
            if book.said and book.said not in whole["said"]:
                whole["said"] = "; ".join(filter(None, (whole["said"], book.said)))
        else:
            log, results = [line for line, _ in said], [*recorded.results] if recorded else []
        whole["log"], whole["results"] = log[-LINES:], results[-RESULTS:]
        if recorded is not None and recorded.begins is not None:
            alerts: list[Any] = [*recorded.alerts]
            whole["alerts"], whole["batteries"] = alerts, recorded.batteries
        elif self.read is not None:
            whole["batteries"] = measured_levels(self.read())

    @property
    def begun_at(self) -> int | None:
        """When the instant 0 was, in milliseconds since 1970, if that is known."""
        if self.digest is not None and self.digest.summary["begun_at"] is not None:
            return self.digest.summary["begun_at"]
        return self.recorded.begun_at if self.recorded is not None else None


def measured_levels(journal: JournalText) -> dict[str, list[list[float]]]:
    """Return pairs of time and level of each drone, at the ends of its commands."""
    found: dict[str, list[list[float]]] = {}
    for _, events in journal.instants():
        for event in events:
            level = event.get("battery") if event["event"].startswith("drone.") else None
            if isinstance(level, list):
                level = level[-1]
            if isinstance(level, (int, float)) and "drone" in event:
                found.setdefault(event["drone"], []).append([event["t"], level])
    return found
