"""Simulation of an app in virtual time, with drones that a gateway keeps apart."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.simulate import Bound, SimulationResult, see_through
from plutoc_runtime.alone.world import World
from plutoc_runtime.domain.model import Mission
from plutoc_runtime.domain.trace import Event
from plutoc_runtime.flow.engine import Listener, Session
from plutoc_runtime.time.kernel import Kernel
from plutoc_runtime.time.virtual import VirtualTime

from ..gateway.gateway import Gateway
from ..process.signal_guard import guard_hooks
from ..simulation.body import simulated
from ..simulation.drones import SimulatedNavigation
from .live_engine import LiveEngine
from .live_fleet import LiveFleet

if TYPE_CHECKING:
    from plutoc_runtime.alone.faults import Faults
    from plutoc_runtime.domain.app import App

    from ..files.fleet import FleetFile
    from ..jobs.controls import Controls

Around = Callable[["Kernel", "Controls"], "Controls"]


class Simulation:
    """A session with simulated drones, which collects all events."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        seed: int,
        faults: Faults,
        listener: Listener | None,
        around: Around | None = None,
        slack: float = 0.0,
    ) -> None:
        drones = simulated(app, fleet)
        world = World(seed, fleet.airspace, fleet.world)
        self._navigation = SimulatedNavigation(kernel, drones, world, faults, seed, fleet.airspace)
        gateway = Gateway(
            kernel,
            self._navigation if around is None else around(kernel, self._navigation),
            drones,
            fleet.airspace,
            apart=fleet.apart,
            slack=slack,
            max_airborne=fleet.max_airborne,
        )
        self._events: list[Event] = []
        listeners = [self._events.append, *([listener] if listener else [])]
        self.session = Session(
            app,
            fleet,
            kernel,
            gateway.link(1),
            listeners,
            kind_of_fleet=LiveFleet,
            kind_of_engine=LiveEngine,
        )

    def outcome(
        self, missions: Sequence[Mission[Any]], ended: float, given_up: str = ""
    ) -> SimulationResult:
        """Return the outcome of the missions."""
        drones = self.session.drones
        return SimulationResult(
            duration=ended,
            missions=tuple(missions),
            drones=drones,
            flown={drone.id: self._navigation.flown(drone.id) for drone in drones},
            events=tuple(self._events),
            given_up=given_up,
        )


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
    slack: float = 0.0,
) -> SimulationResult:
    """Fly the missions in virtual time, until the last one has ended or a time is reached.

    Without such a time it is given up if missions fly again and again without success.
    `around` wraps the drones' controls for the gateway; `slack` keeps drones further apart.
    """
    guard_hooks()
    kernel, bound = VirtualTime(), Bound(missions)

    def listen(event: Event) -> None:
        if on_event is not None:
            on_event(event)
        if until is None and (enough := bound.look(event)) is not None:
            kernel.crash(enough)

    simulation = Simulation(app, fleet, kernel, seed, faults, listen, around, slack)
    ended, given_up = see_through(simulation.session, kernel, missions, bound, until)
    return simulation.outcome(missions, ended, given_up)
