"""Simulation of an app in virtual time, with drones that a gateway keeps apart."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.simulate import Bound, SimulationResult, Stuck, see_through
from plutoc_runtime.alone.world import World
from plutoc_runtime.brain import Brain
from plutoc_runtime.flow.standing import drones_of, fleet_data, mission_data, take_over
from plutoc_runtime.time.virtual import VirtualTime

from ..gateway.gateway import Gateway
from ..process.signal_guard import guard_hooks
from ..simulation.body import simulated
from ..simulation.drones import SimulatedNavigation
from .orders import Dispatcher, Message

if TYPE_CHECKING:
    from plutoc_runtime.alone.faults import Faults
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.domain.trace import Event
    from plutoc_runtime.time.kernel import Kernel

    from ..files.fleet import FleetFile
    from ..jobs.controls import Controls

Listener = Callable[["Event"], object]
Around = Callable[["Kernel", "Controls"], "Controls"]


class Simulation:
    """A brain, and simulated drones with a gateway, in virtual time."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        seed: int,
        faults: Faults,
        listener: Listener,
        around: Around | None = None,
        slack: float = 0.0,
    ) -> None:
        self._app, self._fleet, self._listener = app, fleet, listener
        self._world = world = VirtualTime()
        self._drones = simulated(app, fleet)
        self._navigation = SimulatedNavigation(
            world,
            self._drones,
            World(seed, fleet.airspace, fleet.world),
            faults,
            seed,
            fleet.airspace,
        )
        gateway = Gateway(
            world,
            self._navigation if around is None else around(world, self._navigation),
            self._drones,
            fleet.airspace,
            apart=fleet.apart,
            slack=slack,
            max_airborne=fleet.max_airborne,
        )
        bodies = self._navigation.bodies
        self._changed = dict.fromkeys(bodies)
        """The drones whose motion has changed since the brain was told."""
        for drone, body in bodies.items():
            body.on_change = _Noted(self._changed, drone)
        keys = {drone: body.key for drone, body in bodies.items()}
        self._told: list[Message] = []
        self._dispatcher = Dispatcher(world, gateway.link(1), keys, self._hear)
        self.brain = Brain(app, fleet_data(fleet), space=fleet.airspace)

    @property
    def now(self) -> float:
        """The time, in seconds since the start."""
        return self._world.now

    def begin(self, missions: Iterable[Mission[Any]]) -> None:
        """Begin missions at this instant."""
        self._tell_changes()
        self.brain.begin([mission_data(self._app, one) for one in missions], self._world.now)
        self._listen()

    def run(self, until: float | None) -> bool:
        """Fly until every mission has ended and every drone has landed, or until a time."""
        brain, world = self.brain, self._world
        while brain.over is None:
            times = [when for when in (brain.due, world.next_time()) if when is not None]
            if not times:
                raise Stuck("nothing will ever happen again")
            if until is not None and min(times) > until:
                world.now = until
                return False
            world.now = min(times)
            self._settle()
        return True

    def close(self) -> None:
        """End everything where it is."""
        self.brain.close()
        self._world.close()

    def _settle(self) -> None:
        """Let everything happen that happens at this instant."""
        brain, world = self.brain, self._world
        now = world.now
        while brain.over is None:
            for order in brain.orders():
                self._dispatcher.obey(order)
            world.over = False
            world.drain()
            if world.crashed is not None:
                raise world.crashed
            if self._told:
                told = self._told[:]
                self._told.clear()
                for message in told:
                    if self._changed:
                        message["telemetry"] = self._motions()
                    brain.tell(message, now)
            elif (due := brain.due) is not None and due <= now:
                self._tell_changes()
                brain.advance(now)
            else:
                return
            self._listen()

    def _hear(self, message: Message) -> None:
        """Stop the world after this step: the brain shall know before anything else happens."""
        self._told.append(message)
        self._world.over = True

    def _tell_changes(self) -> None:
        if self._changed:
            self.brain.tell({"telemetry": self._motions()}, self._world.now)

    def _motions(self) -> Mapping[str, object]:
        bodies = self._navigation.bodies
        motions = {drone: bodies[drone].motion for drone in self._changed}
        self._changed.clear()
        return motions

    def _listen(self) -> None:
        for event in self.brain.events():
            self._listener(event)

    def outcome(
        self, missions: Sequence[Mission[Any]], events: Sequence[Event], ended: float, given_up: str
    ) -> SimulationResult:
        """Return the outcome of the missions, which are brought up to date."""
        standing = self.brain.standing()
        take_over(self._app, missions, standing["missions"])
        return SimulationResult(
            duration=ended,
            missions=tuple(missions),
            drones=drones_of(self._app, self._fleet, standing, self._navigation.bodies.__getitem__),
            flown={one.id: self._navigation.flown(one.id) for one in self._drones},
            events=tuple(events),
            given_up=given_up,
        )


class _Noted:
    """Notes a drone whose motion has changed."""

    def __init__(self, changed: dict[str, None], drone: str) -> None:
        self._changed, self._drone = changed, drone

    def __call__(self) -> None:
        self._changed[self._drone] = None


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
    bound, events = Bound(missions), list[Any]()

    def listen(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)
        if until is None and (enough := bound.look(event)) is not None:
            raise enough

    simulation = Simulation(app, fleet, seed, faults, listen, around, slack)
    ended, given_up = see_through(simulation, app.name, missions, bound, until)
    return simulation.outcome(missions, events, ended, given_up)
