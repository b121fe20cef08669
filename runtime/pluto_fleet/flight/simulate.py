"""Simulation of an app in virtual time."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..app import App
from ..shared.alone.simulate import Bound, Outcome, see_through
from ..shared.alone.simulate import simulate as without_traffic
from ..shared.fleet.telemetry import KnownState
from ..shared.time.virtual import VirtualTime
from .outcome import SimulationResult, result_of

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from ..shared.alone.faults import Faults
    from ..shared.domain.model import Mission, Telemetry
    from ..shared.domain.trace import Event
    from .simulation import Around, Listener

_LEGS = (3, 1)
"""The first seam whose brains are told several legs at once."""


def simulate(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    *,
    seed: int,
    faults: Faults,
    until: float | None,
    on_event: Listener | None,
    around: Around | None = None,
) -> SimulationResult:
    """Fly the missions in virtual time, until the last one has ended or a time is reached.

    Without such a time it is given up if missions fly again and again without success.
    Drones that are not kept apart fly in the brain's own world, as each has the air to itself there.
    `around` wraps the drones' controls for the gateway.
    """
    if not fleet.apart and around is None and app.seam >= _LEGS:
        outcome = without_traffic(
            app,
            missions,
            fleet,
            seed=seed,
            faults=faults,
            until=until,
            on_event=on_event,
            new_brain=App.new_brain,
        )
        return result_of(app, missions, fleet, outcome, partial(_known, fleet, outcome))
    from .simulation import Simulation  # with all that keeps drones apart

    bound, events = Bound(missions), list[Any]()

    def listen(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)
        if until is None and (enough := bound.look(event)) is not None:
            raise enough

    kernel = VirtualTime()
    simulation = Simulation(app, fleet, kernel, seed, faults, listen, around)
    with closing(simulation):
        run = partial(kernel.run, simulation.start(missions))
        ended, given_up = see_through(simulation.brain, kernel, run, app.name, bound, until)
        return simulation.outcome(missions, events, ended, given_up)


@dataclass(slots=True)
class _End:
    now: float


def _known(fleet: FleetFile, outcome: Outcome, drone: str) -> Telemetry:
    """Return how a drone is at the end."""
    stand = outcome.standing["drones"][drone]
    known = KnownState(_End(outcome.duration), stand["at"], fleet.motion)
    known.take(stand)
    return known
