"""Frames: what was shown from an instant on, and the rows that are shown after some of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .lines import NAMED_BY
from .recording import changed

Frame = dict[str, Any]
"""A `Frame` of `wire.py`; its rows are whatever pages were shown."""


class Shown:
    """What is shown at an instant: the state, and every row."""

    def __init__(self) -> None:
        self.t: float | None = None
        """The instant; None: nothing has been shown yet."""
        self.state: dict[str, Any] = {}
        self.rows: dict[str, dict[str, dict[str, Any]]] = {kind: {} for kind in NAMED_BY}
        """By kind and name."""

    def take(self, line: Mapping[str, Any]) -> Frame:
        """Take a line of a recording; return the frame that it stands for."""
        self.t = float(line["t"])
        self.state = line.get("state", self.state)
        if "key" in line:
            for kind, by in NAMED_BY.items():
                self.rows[kind] = {row[by]: row for row in line.get(kind, ())}
            return self.whole()
        return self._frame({kind: self._touched(kind, line.get(kind, {})) for kind in NAMED_BY})

    def take_frame(self, frame: Frame) -> None:
        """Take a frame."""
        self.t, self.state = frame["t"], frame["state"]
        for kind, by in NAMED_BY.items():
            self.rows[kind].update((row[by], row) for row in frame.get(kind, ()))

    def whole(self) -> Frame:
        """Return a keyframe of it."""
        return self._frame({kind: list(named.values()) for kind, named in self.rows.items()})

    def _touched(self, kind: str, changes: Mapping[str, Any]) -> list[dict[str, Any]]:
        named = self.rows[kind]
        for name, change in changes.items():
            named[name] = {**changed(named.get(name), change), NAMED_BY[kind]: name}
        return [named[name] for name in changes]

    def _frame(self, rows: Mapping[str, list[dict[str, Any]]]) -> Frame:
        return {"t": self.t, "state": {**self.state, "time": self.t}, **rows}


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
