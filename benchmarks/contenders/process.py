"""A contender as a process of its own: it does the work, is checked, and prints one line of JSON."""

from __future__ import annotations

import argparse
import gc
import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import TypedDict

from .work import Done, Work, expected

STATUS = Path("/proc/self/status")
MARK = os.getppid
"""Costs next to nothing, and is called nowhere else: valgrind counts between two calls of it."""


@dataclass(slots=True, kw_only=True)
class Notes:
    """What a contender notes while it flies, besides what came of it."""

    threads: int = 1
    """The most that there were at once."""
    down: dict[int | str, float] = field(default_factory=dict)
    """Since when each drone is down that has flown; noted only of flights that take time."""
    gaps: list[float] = field(default_factory=list)
    """Seconds from each landing to the drone's next launch."""

    def launched(self, drone: int | str, now: float) -> None:
        """A drone leaves."""
        if drone in self.down:
            self.gaps.append(now - self.down.pop(drone))

    def landed(self, drone: int | str, now: float) -> None:
        """A drone has landed, which is not reported yet."""
        self.down[drone] = now


Ask = Callable[[], Done]
"""Returns what came of the work, which is asked once nothing is measured any more."""

Fly = Callable[[Work, Notes], Done | Ask]


class Said(TypedDict):
    """The line that a contender prints."""

    flights: int
    """Of one run."""
    cpu: list[float]
    """Seconds, of each run."""
    wall: list[float]
    on_the_ground: list[float]
    """Seconds from a landing to the drone's next launch, the median of each run.

    Of one drone: all the time that it did not fly, the start and the end of the run included, by
    flights.
    """
    threads: int
    """The most that there were at once."""
    peak_mib: float
    """The most memory that the process held, up to the end of the last run."""


def kernel_says(key: str) -> int:
    """Return what the kernel knows of this process; 0 where it does not tell (Linux does)."""
    if STATUS.exists():
        for line in STATUS.read_text().splitlines():
            name, _, value = line.partition(":")
            if name == key:
                return int(value.split()[0])
    return 0


def measure(fly: Fly, work: Work, repeat: int) -> Said:
    """Do the work a number of times; every time is checked, and every time is told."""
    cpu, wall = [], []
    ground: list[float] = []
    wanted, threads, peak = expected(work), 1, 0.0
    for _ in range(repeat):
        gc.collect()
        notes = Notes()
        wall_before, cpu_before = time.perf_counter(), time.process_time()
        MARK()
        done = fly(work, notes)
        MARK()
        cpu.append(time.process_time() - cpu_before)
        wall.append(time.perf_counter() - wall_before)
        peak = kernel_says("VmHWM") / 1024
        if callable(done):
            done = done()
        if done != wanted:
            raise SystemExit(f"what came of it is {done}, and must be {wanted}")
        threads = max(threads, notes.threads, kernel_says("Threads"))
        if work.drones == 1 and work.flight:
            ground.append(wall[-1] / wanted.flights - work.flight)
        elif notes.gaps:
            ground.append(median(notes.gaps))
    return {
        "flights": wanted.flights,
        "cpu": cpu,
        "wall": wall,
        "on_the_ground": ground,
        "threads": threads,
        "peak_mib": peak,
    }


def parser() -> argparse.ArgumentParser:
    """Return the arguments that all contenders take."""
    made, usual = argparse.ArgumentParser(), Work()
    made.add_argument("--missions", type=int, default=usual.missions)
    made.add_argument("--trips", type=int, default=usual.trips)
    made.add_argument("--drones", type=int, default=usual.drones)
    made.add_argument("--flight", type=float, default=usual.flight)
    made.add_argument("--repeat", type=int, default=1)
    return made


def report(fly: Fly, given: argparse.Namespace) -> None:
    """Measure, and print the line."""
    work = Work(
        missions=given.missions, trips=given.trips, drones=given.drones, flight=given.flight
    )
    print(json.dumps(measure(fly, work, given.repeat)))


def main(fly: Fly) -> None:
    """Be the program of a contender that takes no arguments of its own."""
    report(fly, parser().parse_args())
