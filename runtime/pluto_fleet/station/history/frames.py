"""What was shown of a flight at each instant, by its journal: rows as it was noted, and drones where they flew.

How it stands at its end its rows say.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from ...flight.mission_status import in_order
from ...journal import errors
from ...journal.facts import BEGUN, BROKEN, SHOWN
from ...shared.domain.status import IN_THE_AIR
from ..rows import recorded_row
from ..shown import Frame, Shown
from .reading import JournalText
from .tracks import Tracks

STEP = 0.5
"""Seconds between two frames in which drones only move."""

MOST_STEPS = 50_000
"""The most frames in which drones only move: in a flight of over seven hours they are further apart."""

_ALOFT = {status.value for status in IN_THE_AIR}

_CONNECTING = {
    "phase": "flying",
    "plan": 0,
    "map": 0,
    "fleet": 0,
    "said": "",
    "how": None,
    "busy": "connecting",
}


def frames_of(read: Callable[[], JournalText], phase: str | None) -> Iterator[Frame]:
    """Yield what was shown from each instant on; the first frame has every row.

    `phase` is how the flight has ended; None: it flies. The journal is read twice: where a drone was is known
    only once its command has ended.
    """
    tracks = Tracks()
    last = 0.0
    for _, events in read().instants():
        for event in events:
            tracks.take(event)
            last = max(last, float(event["t"]))
    yield from _Frames(read(), tracks, max(STEP, last / MOST_STEPS)).until(last, phase)


class _Frames:
    def __init__(self, journal: JournalText, tracks: Tracks, step: float) -> None:
        self._journal = journal
        self._tracks = tracks
        self._step = step
        self._shown = Shown()
        self._shown.state = _CONNECTING
        self._drones: dict[str, Any] = {}
        """Their rows as they were shown last, with where they were."""

    def until(self, ends: float, phase: str | None) -> Iterator[Frame]:
        """Yield the frames."""
        last = 0.0
        for instant, events in self._journal.instants():
            for event in events:
                t = max(last, float(event["t"]))
                if event["event"] == BEGUN:
                    yield self._frame(t, {})
                if event["event"] == "brain.began" and self._drones and self._flies:
                    yield from self._on_the_way(last, t)
                    yield self._left(t, "interrupted")
                    last = t
                if event["event"] != SHOWN:
                    continue
                yield from self._on_the_way(last, t)
                try:
                    rows = self._shown.take(event)
                except BROKEN:
                    self._journal.damaged = (
                        f"{self._journal.path}: {errors.does_not_follow(instant.seq)}"
                    )
                    return
                yield self._frame(t, rows)
                last = t
        yield from self._on_the_way(last, ends)
        if phase not in (None, self._shown.state["phase"]):
            records = self._journal.standing()
            known = in_order(records)
            self._shown.rows["missions"] = {
                name: recorded_row(name, record) for name, record in known  # type: ignore[misc]
            }
            yield self._left(max(last, ends), phase)

    @property
    def _flies(self) -> bool:
        return self._shown.state["phase"] in ("flying", "stopping")

    def _left(self, t: float, phase: str) -> Frame:
        """Return the frame of a run that has ended: of flights nothing is known now."""
        self._shown.state = {**self._shown.state, "phase": phase, "busy": "", "how": None}
        for row in self._shown.rows["drones"].values():
            aloft = row.get("status") in _ALOFT
            row.update(status="UNKNOWN" if aloft else row.get("status"), mission=None)
        return self._frame(t, {"missions": list(self._shown.rows["missions"].values())})

    def _on_the_way(self, since: float, until: float) -> Iterator[Frame]:
        """Yield frames of drones that move between two instants."""
        for step in range(1, int((until - since) / self._step) + 1):
            t = since + step * self._step
            if t < until:
                frame = self._frame(t, {})
                if frame["drones"]:
                    yield frame

    def _frame(self, t: float, rows: Frame) -> Frame:
        """Return a frame of these rows, and of the drones that are shown differently."""
        there = [self._placed(row, t) for row in self._shown.rows["drones"].values()]
        drones = [row for row in there if self._drones.get(row["id"]) != row]
        self._drones.update((row["id"], row) for row in drones)
        some = {kind: rows.get(kind, []) for kind in ("missions", "alerts")}
        return {"t": t, "state": {**self._shown.state, "time": t}, **some, "drones": drones}

    def _placed(self, row: dict[str, Any], t: float) -> dict[str, Any]:
        """Return a drone's row with where it was; a rehearsal says that itself."""
        if "x" in row:
            return row.copy()
        known = self._tracks.at(row["id"], t)
        x, y, z = (None, None, None) if known.at is None else (round(one, 2) for one in known.at)
        battery = None if known.battery is None else round(known.battery, 3)
        return {**row, "x": x, "y": y, "z": z, "battery": battery, "seen_at": None}


def opened_at(frames: Iterator[Frame], start: float) -> Iterator[Frame]:
    """Yield a keyframe of what was shown at `start`, and then the frames after it.

    The first of `frames` must have every row. Before that nothing was shown: then it is the keyframe.
    """
    shown, opened = Shown(), False
    for frame in frames:
        if not opened and shown.t is not None and frame["t"] > start:
            opened = True
            yield shown.whole()
        if opened:
            yield frame
        else:
            shown.take_frame(frame)
    if not opened and shown.t is not None:
        yield shown.whole()
