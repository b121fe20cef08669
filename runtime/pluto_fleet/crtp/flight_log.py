"""The log of commands and positions, for tests to check flights against."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple, TextIO

Point = tuple[float, float, float]

COMMANDS, TRACE = "crtp-commands.jsonl", "crtp-trace.csv"
"""A line for each command; fifty lines a second of each drone that is above the ground."""

_LARGEST = 200_000_000
"""Bytes of a trace, after which no more is written."""


class CommandRecord(NamedTuple):
    """One command to a drone, or another event."""

    time: float
    drone: str
    what: str
    flying: bool
    """Whether it was above the ground, or its motors turned."""
    at: Point
    values: Mapping[str, float]


class PositionRecord(NamedTuple):
    """A drone's position."""

    time: float
    drone: str
    at: Point


class FlightLog:
    """A log in memory; times are those of `time.monotonic`."""

    def __init__(self) -> None:
        self.commands: list[CommandRecord] = []
        self.positions: list[PositionRecord] = []

    def command(self, command: CommandRecord) -> None:
        self.commands.append(command)

    def position(self, place: PositionRecord) -> None:
        self.positions.append(place)


class FileLog(FlightLog):
    """A log in two files of a folder, which are continued if they exist."""

    def __init__(self, folder: Path) -> None:
        self._commands: TextIO = (folder / COMMANDS).open("a", encoding="utf-8")
        self._trace: TextIO = (folder / TRACE).open("a", encoding="utf-8")
        self._size = self._trace.tell()

    def command(self, command: CommandRecord) -> None:
        with suppress(OSError):  # a full disk must not stop drones
            self._commands.write(json.dumps(command._asdict()) + "\n")
            self._commands.flush()

    def position(self, place: PositionRecord) -> None:
        if self._size > _LARGEST:
            return
        x, y, z = place.at
        with suppress(OSError):
            written = f"{place.time:.3f},{place.drone},{x:.4f},{y:.4f},{z:.4f}\n"
            self._size += self._trace.write(written)

    def flush(self) -> None:
        with suppress(OSError):
            self._trace.flush()

    def close(self) -> None:
        with suppress(OSError):
            self._commands.close()
            self._trace.close()
