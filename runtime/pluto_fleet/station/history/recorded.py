"""Reading a recording: what was shown at any instant, as frames."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .frames import Frame, Shown
from .lines import lines_of, time_of
from .members import Member, members
from .recording import VERSION, changed

BATTERY_STEP, BATTERY_EVERY = 0.01, 60.0
"""A level is kept that differs by so much from the one before, or is so many seconds later."""


MOST_HOLES = 100
MOST_LEFT_OUT = 10_000
"""A file with more damaged parts, or more lines that say nothing, is no recording."""


@dataclass(slots=True)
class Contents:
    """What members hold that is wanted of the whole recording."""

    seconds: float = 0.0
    """The time of the last line."""
    said: list[tuple[dict[str, Any], int]] = field(default_factory=list)
    """Lines of the console, each with how many of the journal's stood before it."""
    results: list[dict[str, Any]] = field(default_factory=list)
    batteries: dict[str, list[list[float]]] = field(default_factory=dict)
    """Of each drone pairs of time and level."""
    alerts: dict[str, dict[str, Any]] = field(default_factory=dict)


class Recorded:
    """A recording, as far as it was written when it was read last."""

    def __init__(self, path: Path) -> None:
        self.begun_at: int | None = None
        """When the instant 0 was, in milliseconds since 1970, if that is known."""
        self.holes: list[float] = []
        """The times from which on something cannot be read, up to the next keyframe."""
        self.left_out = 0
        """How many lines say nothing that pages can be shown."""
        self._path, self._whole = path, Contents()
        self._tail = Contents()
        """What is in a last member that is still being written, or was cut off."""
        self._next = 0
        """Where the first member begins that was not whole."""
        self._keys: list[float] = []
        self._begins: list[int] = []
        """The times of the keyframes, and where their members begin."""
        self.refresh()

    def refresh(self) -> None:
        """Read what has been added; raise `OSError` or `ValueError` if that cannot be read."""
        self._tail = Contents()
        with self._path.open("rb") as file:
            for member in members(file, self._next):
                if not member.sound:
                    self.holes.append(self._whole.seconds)
                    if len(self.holes) > MOST_HOLES:
                        raise ValueError(f"more than {MOST_HOLES} parts of it are damaged")
                if not member.torn:
                    self._next = member.ends
                self._take(member, self._tail if member.torn else self._whole)

    @property
    def begins(self) -> float | None:
        """The time of the first frame; None: there is none."""
        return self._keys[0] if self._keys else None

    @property
    def seconds(self) -> float:
        """The time of the last frame."""
        return max(self._whole.seconds, self._tail.seconds)

    @property
    def said(self) -> Sequence[tuple[dict[str, Any], int]]:
        """The lines of the console, each with how many of the journal's stood before it."""
        return [*self._whole.said, *self._tail.said]

    @property
    def results(self) -> Sequence[dict[str, Any]]:
        """The results, of a recording without a journal."""
        return [*self._whole.results, *self._tail.results]

    @property
    def alerts(self) -> Sequence[dict[str, Any]]:
        """The alerts, each as it was last."""
        return list({**self._whole.alerts, **self._tail.alerts}.values())

    @property
    def batteries(self) -> dict[str, list[list[float]]]:
        """Of each drone pairs of time and level."""
        found = {drone: list(pairs) for drone, pairs in self._whole.batteries.items()}
        for drone, pairs in self._tail.batteries.items():
            found.setdefault(drone, []).extend(pairs)
        return found

    def frames(self, start: float) -> Iterator[Frame]:
        """Yield a keyframe of what was shown at `start`, and all that changed since.

        Before the first frame nothing was shown: then that one is the keyframe.
        """
        shown, opened = Shown(), False
        for line in self._lines(start):
            if not opened and shown.t is not None and line["t"] > start:
                opened = True
                yield shown.whole()
            frame = shown.take(line)
            if opened:
                yield frame
        if not opened and shown.t is not None:
            yield shown.whole()

    def _lines(self, start: float) -> Iterator[dict[str, Any]]:
        """Yield the lines with a time, from the last keyframe that is not after `start`."""
        if not self._keys:
            return
        place = max(bisect_right(self._keys, start) - 1, 0)
        with self._path.open("rb") as file:
            last = 0.0
            for member in members(file, self._begins[place]):
                for line in lines_of(member):
                    time = time_of(line)
                    if line is not None and time is not None and time >= last:
                        last = time
                        yield line

    def _take(self, member: Member, contents: Contents) -> None:
        for line in lines_of(member):
            time = time_of(line)
            if line is None or (time is not None and time < self.seconds):
                self.left_out += 1
                if self.left_out > MOST_LEFT_OUT:
                    raise ValueError(
                        f"more than {MOST_LEFT_OUT} of its lines say nothing that is known"
                    )
            elif time is not None:
                self._shown(line, member, contents)
            elif "log" in line:
                contents.said.append((line["log"], line["after"]))
            elif "result" in line:
                contents.results.append(line["result"])
            elif "recording" in line:
                if line["recording"] != VERSION:
                    raise ValueError(f"its version is {line['recording']}, and not {VERSION}")
                self.begun_at = line["begun_at"]

    def _shown(self, line: dict[str, Any], member: Member, contents: Contents) -> None:
        t = contents.seconds = float(line["t"])
        if "key" in line and member.begins not in self._begins[-1:]:
            self._begins.append(member.begins)  # first: another thread may look one up by its time
            self._keys.append(t)
        rows = line.get("drones", {})
        named = {row["id"]: row for row in rows} if isinstance(rows, list) else rows
        for drone, row in named.items():
            if (level := row.get("battery")) is not None:
                _add_level(contents.batteries.setdefault(drone, []), t, level)
        alerts = line.get("alerts", {})
        if isinstance(alerts, list):
            contents.alerts.update((row["id"], row) for row in alerts)
        else:
            known = {**self._whole.alerts, **contents.alerts}
            for name, change in alerts.items():
                contents.alerts[name] = changed(known.get(name), change)


def _add_level(pairs: list[list[float]], t: float, level: float) -> None:
    """Add a level to those of a drone, if it tells more than the last one."""
    if pairs:
        before, last = pairs[-1]
        if abs(level - last) < BATTERY_STEP and t - before < BATTERY_EVERY:
            return
    pairs.append([t, level])
