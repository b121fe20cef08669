"""The navigations that our own package flies with: no drone moves, and every flight is reported.

Each looks into the flight that it gets for the numbers of mission, trip and attempt, as the
navigations of the other contenders do.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from .process import Notes, kernel_says
from .work import Work, fails

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point
    from plutoc_runtime.time.kernel import EventKind, Kernel
    from plutoc_runtime.trips.flight import Flight

HOME: Point = (1.0, 1.0, 0.0)
"""Where all drones stand."""

Report = Callable[[object], None]
Result = Exception | None
"""What is reported: the flight went well, or why not."""


class Standing:
    """What is known of a drone that stands at home."""

    __slots__ = ("location",)

    battery_level, landed = 1.0, True

    def __init__(self, location: Point) -> None:
        self.location = location


class Still:
    """What all of them have in common: drones that stand where they shall be."""

    def __init__(self, crash: Exception, kernel: Kernel) -> None:
        self.crash, self.kernel = crash, kernel

    def telemetry(self, drone: str) -> Standing:
        """Return what stays true of a drone."""
        return Standing(HOME)

    async def recover(self, drone: str) -> bool:
        """It stands at home already."""
        return True


class FromTheLoop(Still):
    """Reports from asyncio's loop, at once or after a while."""

    def __init__(self, crash: Exception, kernel: Kernel, work: Work, notes: Notes) -> None:
        super().__init__(crash, kernel)
        self.loop, self.flight, self.notes = asyncio.get_running_loop(), work.flight, notes

    def fly(self, job: Flight, report: Report) -> None:
        """Fly, then report."""
        trip = job.trip
        failed = fails(job.mission.index, trip.index, trip.attempt - 1)
        result = self.crash if failed else None
        if self.flight:
            self.notes.launched(job.drone, self.loop.time())
            self.loop.call_later(self.flight, self.land, job.drone, report, result)
        else:
            self.loop.call_soon(self.kernel.post, report, result)

    def land(self, drone: str, report: Report, result: Result) -> None:
        """A flight that took time is over."""
        self.notes.landed(drone, self.loop.time())
        self.kernel.post(report, result)


class AllTogether(Still):
    """Reports once every mission that is not over is in the air, then of all of them."""

    def __init__(self, crash: Exception, kernel: Kernel, work: Work, notes: Notes) -> None:
        super().__init__(crash, kernel)
        self.loop, self.notes = asyncio.get_running_loop(), notes
        self.left, self.last = work.missions, work.trips - 1
        self.flying = self.ending = 0
        self.up: deque[Report] = deque()
        self.results: deque[Result] = deque()

    def fly(self, job: Flight, report: Report) -> None:
        """Wait for the others."""
        trip = job.trip
        failed = fails(job.mission.index, trip.index, trip.attempt - 1)
        self.up.append(report)
        self.results.append(self.crash if failed else None)
        self.flying += 1
        self.ending += trip.index == self.last and not failed
        if self.flying == self.left:
            self.loop.call_soon(self.land, self.flying)
            self.left -= self.ending
            self.flying = self.ending = 0

    def land(self, count: int) -> None:
        """All come down, while those that were first take off again."""
        self.notes.threads = max(self.notes.threads, kernel_says("Threads"))
        for _ in range(count):
            self.kernel.post(self.up.popleft(), self.results.popleft())


class ThroughTheKernel(Still):
    """Reports in virtual time: at this instant, when its turn comes."""

    def __init__(
        self, crash: Exception, kernel: Kernel, kind: EventKind, key: Callable[[int], int]
    ) -> None:
        super().__init__(crash, kernel)
        self.kind, self.key = kind, key

    def fly(self, job: Flight, report: Report) -> None:
        """Fly, then report."""
        trip, kernel, mission = job.trip, self.kernel, job.mission.index
        result = self.crash if fails(mission, trip.index, trip.attempt - 1) else None
        kernel.schedule(kernel.now, self.kind, self.key(mission), partial(report, result))
