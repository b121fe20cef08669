"""Stands for the library of a drone, the Wren, and for the Wren itself: it is simulated here.

Like most such libraries, it counts in centimetres and degrees, calls back from a thread of its own,
and says nothing when a command is over. An address is where the drone stands: `wren:100,50`.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import dist
from threading import Event, Thread

TICK = 0.02
"""Seconds between two states."""


@dataclass(frozen=True)
class State:
    """What a Wren sends: centimetres, degrees, volts, percent."""

    x: float
    y: float
    z: float
    heading: float
    volts: float
    percent: float
    mode: str
    """standing, moving, hovering or crashed"""


class Radio:
    """The link to one Wren."""

    def __init__(self, address: str) -> None:
        kind, _, place = address.partition(":")
        x, _, y = place.partition(",")
        self.at = (float(x), float(y), 0.0) if kind == "wren" else None
        self.goal, self.speed, self.mode = self.at, 0.0, "standing"
        self.silent, self._shut = False, Event()

    def open(self, hear: Callable[[State], object]) -> None:
        """Listen to it: from now on `hear` alone is called, by a thread of the library's own."""
        self.close()
        self._shut = Event()
        Thread(target=self._run, args=(hear, self._shut), daemon=True, name="wren").start()

    def close(self) -> None:
        """Listen no longer."""
        self._shut.set()

    def send(self, command: str, *values: float) -> None:
        """Send `up CM CM/S`, `go X Y Z CM/S`, `down CM/S`, `stop` or `off`; it does not answer."""
        if self.at is None or self.silent or self.mode == "crashed":
            return
        x, y, z = self.at
        flies = self.mode in ("moving", "hovering")
        match command, values:
            case "up", (height, speed):
                self.goal, self.speed, self.mode = (x, y, height), speed, "moving"
            case "go", (x, y, z, speed) if flies:
                self.goal, self.speed, self.mode = (x, y, z), speed, "moving"
            case "down", (speed,) if flies:
                self.goal, self.speed, self.mode = (x, y, 0.0), speed, "moving"
            case "stop", () if flies:
                self.goal = self.at
            case "off", ():
                self.goal, self.mode = (x, y, 0.0), "crashed" if flies else "standing"

    def _run(self, hear: Callable[[State], object], shut: Event) -> None:
        then = time.monotonic()
        while self.at is not None and not shut.wait(TICK):
            now = time.monotonic()
            self._fly(now - then)
            then = now
            if not self.silent:
                hear(State(*self.at, heading=90.0, volts=3.9, percent=88.0, mode=self.mode))

    def _fly(self, seconds: float) -> None:
        assert self.at is not None and self.goal is not None
        left = dist(self.at, self.goal)
        share = min(1.0, self.speed * seconds / left) if left else 1.0
        if self.mode == "crashed":
            self.at = self.goal
        elif self.mode == "moving":
            x, y, z = (a + (b - a) * share for a, b in zip(self.at, self.goal, strict=True))
            self.at = x, y, z
            if share == 1.0:
                self.mode = "hovering" if z > 0 else "standing"
