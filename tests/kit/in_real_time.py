"""Flies an app by the kernel of real flights, with the world in the same process and without a journal."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.flight.simulation import Simulation
from pluto_fleet.process.hook_runner import RealHooks
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.trace import Event
from tests.kit import apps


def fly(
    app: App,
    missions: Sequence[apps.Mission],
    fleet: FleetFile,
    listener: Callable[[Event], object],
) -> SimulationResult:
    """Return what came of the missions."""
    return asyncio.run(flown(RealTime, app, missions, fleet, listener))


async def flown(
    time: type[RealTime],
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    listener: Callable[[Event], object],
    seed: int = 0,
    faults: Faults = apps.NO_FAULTS,
    until: float | None = None,
) -> SimulationResult:
    """Fly them in the loop that runs."""
    kernel, events = time(), list[Event]()

    def hear(event: Event) -> None:
        events.append(event)
        listener(event)

    simulation = Simulation(app, fleet, kernel, seed, faults, hear, hooks=RealHooks(kernel))
    try:
        async with asyncio.timeout(until):
            ended = await kernel.run(simulation.start(missions))
    except TimeoutError:
        ended = kernel.now
    finally:
        simulation.close()
    return simulation.outcome(missions, events, ended, "")
