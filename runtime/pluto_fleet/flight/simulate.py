"""Simulation of an app in virtual time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..app import App
from ..shared.alone.simulate import Alone, Bound, Outcome, Run, see_through
from ..shared.alone.simulate import simulate as without_traffic
from ..shared.fleet.telemetry import KnownState
from ..shared.time.told import VirtualTime
from .driver import take_up
from .outcome import SimulationResult, result_of

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from ..shared.alone.world import Faults
    from ..shared.brain import Brain
    from ..shared.domain.model import Mission, Telemetry
    from ..shared.domain.trace import Clock, Event
    from .driver import Stands
    from .simulation import Around, Listener

Look = Callable[["Brain", float, Mapping[str, "Telemetry"]], object]
"""Called with a brain, the time, and the drones as they are then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sampling:
    """How a simulation is looked at while it runs."""

    every: float
    """Seconds of virtual time."""
    look: Look


def has_traffic(fleet: FleetFile) -> bool:
    """Return whether drones are kept apart in a simulation: else each has the air to itself."""
    return bool(fleet.apart)


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
    stands: Stands | None = None,
    sampling: Sampling | None = None,
) -> SimulationResult:
    """Fly the missions in virtual time, until the last one has ended or a time is reached.

    Without such a time it is given up if missions fly again and again without success.
    Drones that are not kept apart fly in the brain's own world, as each has the air to itself there.
    `around` wraps the drones' controls for the gateway. `stands` says where each drone stands at first;
    without it all are in their docks, fully charged.
    """
    if not has_traffic(fleet) and around is None:

        def prepare(world: Alone) -> Run:
            drones = world.drones.drones
            for drone, (at, level) in (stands or {}).items():
                drones[drone].stand(at, level)
            if stands:
                world.brain.tell({"telemetry": world.drones.news()}, world.now)
                take_up(world.brain, stands, world.now)
            return _looked_at(world.run, world, world.brain, drones, sampling)

        outcome = without_traffic(
            app,
            missions,
            fleet,
            seed=seed,
            faults=faults,
            until=until,
            on_event=on_event,
            new_brain=App.new_brain,
            prepare=prepare,
        )
        return result_of(app, missions, fleet, outcome, partial(_known, fleet, outcome))
    from .simulation import Simulation  # with all that keeps drones apart

    bound, events = Bound(missions), list[Any]()

    def listen(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)
        if until is None:
            bound.look(event)

    kernel = VirtualTime()
    simulation = Simulation(app, fleet, kernel, seed, faults, listen, around, stands=stands)
    with closing(simulation):
        run = partial(kernel.run, simulation.start(missions))
        seen = _looked_at(run, kernel, simulation.brain, simulation.bodies, sampling)
        ended, given_up = see_through(simulation.brain, kernel, seen, bound, until)
        return simulation.outcome(missions, events, ended, given_up)


def _looked_at(
    run: Run,
    clock: Clock,
    brain: Brain,
    drones: Mapping[str, Telemetry],
    sampling: Sampling | None,
) -> Run:
    """Return what runs a simulation until a time, and has it looked at on the way."""
    if sampling is None:
        return run
    every, look = sampling.every, sampling.look

    def in_steps(until: float | None) -> bool:
        over = False
        while not over and (until is None or clock.now < until):
            step = clock.now + every
            over = run(step if until is None else min(step, until))
            look(brain, clock.now, drones)
        return over

    return in_steps


@dataclass(slots=True)
class _End:
    now: float


def _known(fleet: FleetFile, outcome: Outcome, drone: str) -> Telemetry:
    """Return how a drone is at the end."""
    stand = outcome.standing["drones"][drone]
    known = KnownState(_End(outcome.duration), stand["at"], fleet.motion)
    known.take(stand)
    return known
