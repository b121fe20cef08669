"""Simulation of an app in virtual time, with drones that a gateway keeps apart."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..app import App
from ..gateway.gateway import Gateway
from ..shared.alone.simulate import Bound, Outcome, see_through
from ..shared.alone.simulate import simulate as without_traffic
from ..shared.alone.world import World
from ..shared.domain.app import moving
from ..shared.fleet.telemetry import KnownState
from ..shared.flow.standing import fleet_data
from ..shared.time.virtual import VirtualTime
from ..simulation.body import simulated
from ..simulation.drones import SimulatedNavigation
from .driver import Driver, begun
from .orders import Dispatcher
from .outcome import SimulationResult, result_of

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from ..jobs.controls import Controls
    from ..process.hook_runner import RealHooks
    from ..shared.alone.faults import Faults
    from ..shared.domain.model import Mission, Telemetry
    from ..shared.domain.trace import Event
    from ..shared.time.future import Future
    from ..shared.time.kernel import Kernel

_LEGS = (3, 1)
"""The first seam whose brains are told several legs at once."""

Listener = Callable[["Event"], object]
Around = Callable[["Kernel", "Controls"], "Controls"]


class Simulation:
    """A brain, and simulated drones with a gateway, on any kernel."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        seed: int,
        faults: Faults,
        listener: Listener,
        around: Around | None = None,
        hooks: RealHooks | None = None,
    ) -> None:
        """`hooks` runs hooks in real time; without it they are called at once."""
        app = moving(app, fleet.motion)
        self._app, self._fleet, self._kernel = app, fleet, kernel
        self._drones = simulated(app, fleet)
        world = World(seed, fleet.airspace, fleet.world)
        self._navigation = SimulatedNavigation(
            kernel, self._drones, world, faults, seed, fleet.airspace
        )
        gateway = Gateway(
            kernel,
            self._navigation if around is None else around(kernel, self._navigation),
            self._drones,
            fleet.airspace,
            apart=fleet.apart,
            slack=fleet.motion.slack,
            max_airborne=fleet.max_airborne,
        )
        bodies = self._navigation.bodies
        self._changed = dict.fromkeys(bodies)
        """The drones whose motion has changed since the brain was told."""
        for drone, body in bodies.items():
            body.on_change = partial(self._changed.__setitem__, drone, None)
        keys = {drone: body.key for drone, body in bodies.items()}
        self.brain = app.new_brain(fleet_data(fleet), space=fleet.airspace, hooks=hooks)
        dispatcher = Dispatcher(kernel, gateway.link(1), keys)
        self._driver = driver = Driver(
            kernel, self.brain, obey=dispatcher.obey, motions=self._motions, hear=listener
        )
        dispatcher.tell = driver.tell
        if hooks is not None:
            hooks.ended = lambda number: driver.tell({"hook": number})
            hooks.stir = driver.pump

    def start(self, missions: Iterable[Mission[Any]]) -> Future[float]:
        """Begin missions at this instant; return what is set when all has ended."""
        self._driver.call(partial(self.brain.begin, begun(self._app, missions)))
        return self._driver.done

    def close(self) -> None:
        """End everything where it is."""
        self.brain.close()
        self._kernel.close()

    def _motions(self) -> Mapping[str, object]:
        if not self._changed:
            return _NOTHING
        bodies = self._navigation.bodies
        motions = {drone: bodies[drone].motion for drone in self._changed}
        self._changed.clear()
        return motions

    def outcome(
        self, missions: Sequence[Mission[Any]], events: Sequence[Event], ended: float, given_up: str
    ) -> SimulationResult:
        """Return the outcome of the missions, which are brought up to date."""
        bodies, standing = self._navigation.bodies, self.brain.standing()
        for drone, stands in standing["drones"].items():
            stands["battery"] = bodies[drone].battery_level  # the brain was told of it earlier
        outcome = Outcome(
            duration=ended,
            standing=standing,
            flown={one.id: self._navigation.flown(one.id) for one in self._drones},
            events=tuple(events),
            given_up=given_up,
        )
        return result_of(self._app, missions, self._fleet, outcome, bodies.__getitem__)


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


_NOTHING: Mapping[str, object] = {}
