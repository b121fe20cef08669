"""Flies an app in real time, with the world in the same process and without a journal."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.flight.simulation import Simulation
from pluto_fleet.process.hook_runner import RealHooks
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.domain.trace import Event
from tests.kit import apps


def fly(
    app: App,
    missions: Sequence[apps.Mission],
    fleet: FleetFile,
    listener: Callable[[Event], object],
) -> SimulationResult:
    """Return what came of the missions."""

    async def flown() -> SimulationResult:
        kernel = RealTime()
        events: list[Event] = []

        def hear(event: Event) -> None:
            events.append(event)
            listener(event)

        simulation = Simulation(app, fleet, kernel, 0, Faults(), hear, hooks=RealHooks(kernel))
        try:
            ended = await kernel.run(simulation.start(missions))
        finally:
            simulation.close()
        return simulation.outcome(missions, events, ended, "")

    return asyncio.run(flown())
