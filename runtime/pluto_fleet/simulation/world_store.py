"""Stores a simulated world on the disk, so that it survives its process.

Each action of a drone is one line of a file, written when it happens. The drones' states are another
file, rewritten at every change. Time passes also while no process runs: when it is read again, each
drone is where it has got to meanwhile.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ..process.whole_file import write_whole
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.hooks.plain_data import item_data, item_of, value_data, value_of
from .drones import SimulatedBody, WorldAction

_BOOT = Path("/proc/sys/kernel/random/boot_id")


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """A point in time, by the wall clock and since the machine was started."""

    wall: float
    """Seconds since 1970, as far as the clock is right."""
    boot: str
    """Identifies the start of the machine; empty: unknown."""
    up: float
    """Seconds since that start, including sleep, by a clock that cannot be set."""

    def since(self, other: Moment) -> float:
        """Return the seconds since another moment; never less than none."""
        if self.boot and self.boot == other.boot:
            return max(0.0, self.up - other.up)
        return max(0.0, self.wall - other.wall)


def this_moment() -> Moment:
    boot = _this_boot()
    up = time.clock_gettime(time.CLOCK_BOOTTIME) if boot else 0.0
    return Moment(wall=time.time(), boot=boot, up=up)


@cache
def _this_boot() -> str:
    with suppress(OSError):
        return _BOOT.read_text(encoding="ascii").strip()
    return ""


DEEDS, DRONES = "world.jsonl", "drones.json"
"""The names of the files with the actions and with the drones' states."""


def _saved(folder: Path) -> Mapping[str, Any]:
    """Return the drones' states as they were stored last, and when; nothing if they never were."""
    with suppress(OSError, ValueError):
        saved: Mapping[str, Any] = json.loads((folder / DRONES).read_bytes())
        return saved
    return {}


def time_in_world(folder: Path, speed: float, now: Moment) -> float:
    """Return what time it is in a stored world, in seconds since it first began."""
    saved = _saved(folder)
    if not saved:
        return 0.0
    passed = now.since(Moment(**saved["moment"])) * speed
    return float(saved["time"]) + passed


class WorldStore:
    """The files of one simulated world. The file of actions is append-only."""

    def __init__(
        self, folder: Path, clock: Callable[[], float], speed: float, moment: Callable[[], Moment]
    ) -> None:
        self._folder = folder
        self._clock = clock
        self._speed = speed
        self._moment = moment
        self._bodies: Mapping[str, SimulatedBody] = {}
        self._counts: dict[str, int] = {}
        """The number of recorded actions of each drone."""
        self._stale = False
        path = folder / DEEDS
        told = path.read_bytes() if path.exists() else b""
        self._end = told.rfind(b"\n") + 1
        """The end of the last complete line: an incomplete one is overwritten."""
        self._told = [json.loads(line) for line in told[: self._end].splitlines()]
        self._file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o600)
        os.ftruncate(self._file, self._end)

    def take_over(self, bodies: Mapping[str, SimulatedBody]) -> None:
        """Restore the drones, and record them from now on."""
        self._bodies = bodies
        saved = _saved(self._folder)
        now = self._moment()
        for id, data in saved.get("drones", {}).items():
            if id in bodies:
                passed = now.since(Moment(**saved["moment"])) * self._speed
                shift = self._clock() - saved["time"] - passed
                bodies[id].restore(data, shift)
                self._counts[id] = data["deeds"]
        self._catch_up()
        for body in bodies.values():
            body.on_change = self._changed
        self._changed()
        self.settled()

    def watch(self, drone: str) -> None:
        """Record a drone that has joined, too."""
        self._counts.setdefault(drone, 0)
        self._bodies[drone].on_change = self._changed
        self._changed()

    def _catch_up(self) -> None:
        """Restore the drones' memories of their actions, and apply those newer than the stored states."""
        seen = dict.fromkeys(self._bodies, 0)
        for deed in self._told:
            id = deed["drone"]
            body = self._bodies.get(id)
            if body is None:
                continue
            seen[id] += 1
            if deed["boot"] == body.boot and deed["job"] is not None:
                body.done[deed["job"]] = value_of(deed["value"])
            if seen[id] > self._counts.get(id, 0):
                body.carries = item_of(deed["aboard"])
        self._counts = seen
        self._told = []

    def record(self, deed: WorldAction) -> None:
        """Record an action, or make it fail."""
        body = self._bodies[deed.drone]
        data = {
            "time": self._moment().wall,
            "drone": deed.drone,
            "action": deed.action,
            "item": None if deed.item is None else deed.item.name,
            "job": deed.job,
            "at": list(body.location),
            "boot": deed.boot,
            "aboard": item_data(deed.aboard),
            "value": value_data(deed.value),
        }
        line = json.dumps(data).encode() + b"\n"
        try:
            if os.pwrite(self._file, line, self._end) < len(line):
                raise OSError("no space is left")
        except OSError as error:
            with suppress(OSError):
                os.ftruncate(self._file, self._end)
            reason = f"{deed.action} failed: the simulated world cannot be written down: {error}"
            raise FlightFailed(Failure.ACTION, reason) from error
        self._end += len(line)
        self._counts[deed.drone] += 1
        self._stale = True

    def _changed(self) -> None:
        self._stale = True

    def settled(self) -> None:
        """Store the drones' states if they have changed; called after each instant."""
        if not self._stale:
            return
        drones = {id: {**body.data, "deeds": self._counts[id]} for id, body in self._bodies.items()}
        text = json.dumps(
            {"moment": asdict(self._moment()), "time": self._clock(), "drones": drones}
        )
        with suppress(OSError):  # it is written again at the next change
            write_whole(self._folder / DRONES, text)
            self._stale = False
