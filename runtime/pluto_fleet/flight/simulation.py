"""A brain, and simulated drones that a gateway keeps apart, on any kernel."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..gateway.gateway import Gateway
from ..jobs.controls import fleet_drones
from ..shared.alone.simulate import Outcome
from ..shared.domain.app import moving
from ..shared.events.world import MovingWorld
from ..shared.flow.record import fleet_data
from ..simulation.drones import SimulatedNavigation
from .driver import Driver, Stands, begun, take_up
from .outcome import SimulationResult, result_of

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..jobs.controls import Controls
    from ..jobs.link import Message
    from ..process.hook_runner import RealHooks
    from ..shared.alone.world import Faults
    from ..shared.domain.model import Mission
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Future, Kernel
    from ..simulation.drones import SimulatedBody

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
        stands: Stands | None = None,
    ) -> None:
        """`hooks` runs hooks in real time; without it they are called at once.

        `stands`: where each drone stands at first; None: in its dock, fully charged.
        """
        app = moving(app, fleet.motion, charges=fleet.charges_at_home)
        self._app, self._fleet, self._kernel = app, fleet, kernel
        self._drones = fleet_drones(app, fleet)
        world = MovingWorld(seed, fleet.airspace, fleet.world)
        self._navigation = SimulatedNavigation(kernel, self._drones, world, faults, seed)
        self._stands = {} if stands is None else stands
        for drone, (at, level) in self._stands.items():
            self._navigation.bodies[drone].stand(at, level)
        gateway = Gateway(
            kernel,
            self._navigation if around is None else around(kernel, self._navigation),
            self._drones,
            fleet.airspace,
            apart=fleet.apart,
            slack=fleet.motion.slack,
            max_airborne=fleet.max_airborne,
        )
        if world.movers:
            gateway.tracker = self._navigation.tracks
        bodies = self._navigation.bodies
        self._changed = dict.fromkeys(bodies)
        """The drones whose motion has changed since the brain was told."""
        for drone, body in bodies.items():
            body.on_change = partial(self._changed.__setitem__, drone, None)
        self.brain = app.new_brain(fleet_data(fleet), space=fleet.airspace, hooks=hooks)
        link = gateway.link(1)
        link.hear = self._told
        self._driver = driver = Driver(
            kernel, self.brain, obey=link.send, motions=self._motions, hear=listener
        )
        if hooks is not None:
            hooks.ended = lambda number: driver.tell({"hook": number})
            hooks.stir = driver.pump

    def start(self, missions: Iterable[Mission[Any]]) -> Future[float]:
        """Begin missions at this instant; return what is set when all has ended."""
        given = begun(self._app, missions)

        def begin(now: float) -> None:
            if self._stands:
                take_up(self.brain, self._stands, now)
            self.brain.begin(given, now)
            if self._fleet.world is not None:
                self.brain.tell({"happens": self._fleet.world.events}, now)

        self._driver.call(begin)
        return self._driver.done

    @property
    def bodies(self) -> Mapping[str, SimulatedBody]:
        """The drones as they are, by their ids."""
        return self._navigation.bodies

    def close(self) -> None:
        """End everything where it is."""
        self.brain.close()
        self._kernel.close()

    def _told(self, message: Message) -> None:
        """Tell the brain what came of an order, or where an action is done that is done beside its target."""
        if "flown" not in message:
            self._driver.tell(message)
            return
        facts = {name: message["flown"][name] for name in ("flight", "target", "at")}
        request = {"command": "acts-beside", **facts}
        self._driver.call(partial(self._app.perform, self.brain, request))

    def _motions(self) -> Mapping[str, object]:
        if not self._changed:
            return _NOTHING
        bodies = self._navigation.bodies
        motions = {drone: bodies[drone].news() for drone in self._changed}
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


_NOTHING: Mapping[str, object] = {}
