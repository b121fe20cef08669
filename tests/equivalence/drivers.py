"""The driver of real flights without their time: an asyncio loop that jumps to what comes next."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from contextvars import Context
from heapq import heappop, heappush
from typing import TYPE_CHECKING, Any, TypeVarTuple

from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.drones import TURN, JumpingLoop
from tests.kit.in_real_time import flown

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.files.fleet import FleetFile
    from pluto_fleet.shared.alone.world import Faults
    from pluto_fleet.shared.domain.model import Mission
    from pluto_fleet.shared.domain.trace import Event
    from tests.equivalence.fly import Record
    from tests.equivalence.worlds import World

Arguments = TypeVarTuple("Arguments")


MOST_TURNS = 10_000
"""Turns at one time; after that asyncio takes for due, again and again, what is due a rounding later."""


class _ToTheLastBit(JumpingLoop):
    """A loop that comes to each time that was asked for exactly: no difference of two is rounded."""

    def __init__(self) -> None:
        self.whens: list[float] = []
        self._turns = 0  # since the time went on
        super().__init__()
        self.now = 0.0

    def call_at(
        self,
        when: float,
        callback: Callable[[*Arguments], object],
        *args: *Arguments,
        context: Context | None = None,
    ) -> asyncio.TimerHandle:
        heappush(self.whens, when)
        return super().call_at(when, callback, *args, context=context)

    def advance(self, seconds: float) -> None:
        self._turns += 1
        if seconds <= TURN and self._turns < MOST_TURNS:
            return
        self._turns = 0
        while self.whens and self.whens[0] <= self.now:
            heappop(self.whens)
        if self.whens:
            self.now = self.whens[0]


def in_real_time(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    *,
    seed: int,
    faults: Faults,
    until: float | None,
    on_event: Callable[[Event], None] | None,
) -> SimulationResult:
    """Fly missions by the kernel of real flights; raise `BadInput` where they wait for ever."""

    loop = _ToTheLastBit()
    heard = on_event or (lambda _: None)
    try:
        task = loop.create_task(flown(RealTime, app, missions, fleet, heard, seed, faults, until))
        try:
            return loop.run_until_complete(task)
        except RuntimeError:  # nothing is left to wait for
            if task.done():
                raise
            task.cancel()
            return loop.run_until_complete(task)
    except asyncio.CancelledError:
        raise BadInput("missions wait for ever") from None
    finally:
        loop.close()


def seen(record: Record, world: World, whole: bool) -> list[str]:
    """What was seen before the end of time, and how all ended if it came before that."""
    events = [event for event in record.events if float(str(event["t"])) < world.until]
    seen = [repr([(name, _told(fact)) for name, fact in event.items()]) for event in events]
    seen += [line for line in record.diary if float(line.split()[0]) < world.until]
    if whole:
        seen += record.ends
    return seen


def _told(fact: object) -> object:
    """Leave out of a traceback which driver called the hook."""
    if isinstance(fact, str) and fact.startswith("Traceback"):
        return fact.splitlines()[-1]
    return fact
