"""Real time: the same session as in a simulation, on asyncio's clock."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .kernel import FLEET
from .realtime import RealTime
from .session import Listener, Outcome, Simulation

if TYPE_CHECKING:
    from .app import App
    from .files.fleet import FleetFile
    from .model import Mission
    from .simulation.faults import Faults


async def fly_simulated(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    *,
    seed: int,
    faults: Faults,
    on_event: Listener | None,
) -> Outcome:
    """Fly the missions with simulated drones in real time; when cancelled, land them all first."""
    kernel = RealTime()
    simulation = Simulation(app, fleet, kernel, seed, faults, on_event)
    session = simulation.session
    try:
        ended = await kernel.run(session.start(missions))
    except asyncio.CancelledError:
        session.engine.halt()
        landing = kernel.spawn(session.core.fleet.land_all(), FLEET, "land all")
        await kernel.run(landing)
        raise
    finally:
        kernel.close()
    return simulation.outcome(missions, ended)
