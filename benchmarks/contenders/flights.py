"""The navigations that our own package flies with: no drone moves, and every flight is reported.

Each looks into the flight that it gets for the numbers of mission, trip and attempt, as the
navigations of the other contenders do.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from .process import Notes
from .work import Work, fails

if TYPE_CHECKING:
    from plutoc_runtime.flight import Flight
    from plutoc_runtime.kernel import Kernel, Kind
    from plutoc_runtime.model import Point

HOME: Point = (1.0, 1.0, 0.0)
"""Where all drones stand."""
CRASHED = "the hash says so"

Report = Callable[[object], None]
Fault = Callable[[str], Exception]
"""Makes what is reported of a flight that failed."""


class Standing:
    """What is known of a drone that never moves."""

    location, battery_level, landed = HOME, 1.0, True


class Still:
    """What all of them have in common: drones that stand where they shall be."""

    def __init__(self, fault: Fault, kernel: Kernel) -> None:
        self.fault, self.kernel, self.standing = fault, kernel, Standing()

    def telemetry(self, drone: str) -> Standing:
        """Return the same of every drone."""
        return self.standing

    def result(self, flight: Flight) -> Exception | None:
        """Return what is reported of a flight."""
        trip = flight.trip
        if fails(flight.state.mission.index, trip.index, trip.attempt - 1):
            return self.fault(CRASHED)
        return None

    def break_off(self, drone: str) -> None:
        """Nothing has to be stopped: no flight is given up here."""

    async def land(self, drone: str) -> None:
        """It stands already."""

    async def recover(self, drone: str) -> bool:
        """It stands at home already."""
        return True


class FromTheLoop(Still):
    """Reports from asyncio's loop, at once or after a while."""

    def __init__(self, fault: Fault, kernel: Kernel, work: Work, notes: Notes) -> None:
        super().__init__(fault, kernel)
        self.loop, self.flight, self.notes = asyncio.get_running_loop(), work.flight, notes

    def fly(self, job: Flight, report: Report) -> None:
        """Fly, then report."""
        if self.flight:
            self.notes.launched(job.drone, self.loop.time())
            self.loop.call_later(self.flight, self.kernel.post, report, self.result(job))
        else:
            self.loop.call_soon(self.kernel.post, report, self.result(job))


class AllTogether(Still):
    """Reports once every mission that is not over is in the air, then of all of them."""

    def __init__(self, fault: Fault, kernel: Kernel, work: Work, notes: Notes) -> None:
        super().__init__(fault, kernel)
        self.loop = asyncio.get_running_loop()
        self.left, self.ending, self.last = work.missions, 0, work.trips - 1
        self.up: list[tuple[Report, Exception | None]] = []

    def fly(self, job: Flight, report: Report) -> None:
        """Wait for the others."""
        result = self.result(job)
        self.up.append((report, result))
        self.ending += result is None and job.trip.index == self.last
        if len(self.up) == self.left:
            self.loop.call_soon(self.land_all, self.up)
            self.up, self.left, self.ending = [], self.left - self.ending, 0

    def land_all(self, landing: list[tuple[Report, Exception | None]]) -> None:
        """All come down."""
        for report, result in landing:
            self.kernel.post(report, result)


class ThroughTheKernel(Still):
    """Reports in virtual time: at this instant, when its turn comes."""

    def __init__(self, fault: Fault, kernel: Kernel, kind: Kind) -> None:
        super().__init__(fault, kernel)
        self.kind = kind

    def fly(self, job: Flight, report: Report) -> None:
        """Fly, then report."""
        kernel = self.kernel
        key = (job.state.mission.index,)
        kernel.at(kernel.now, self.kind, key, partial(report, self.result(job)))
