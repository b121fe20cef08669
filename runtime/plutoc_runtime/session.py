"""From an app, its missions and a fleet to a flown plan: puts the parts together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from gc import freeze
from typing import TYPE_CHECKING, Any

from .allocation import Queue
from .core import Core
from .eligibility import Reach
from .engine import Engine
from .enough import IDLE, Bound, Enough
from .errors import BadInput
from .fleet import Fleet
from .gateway.gateway import Gateway
from .kernel import FLEET, Kernel, Task
from .model import Drone, Mission
from .results import ResultStore
from .simulation.drones import SimulatedDrone, SimulatedNavigation
from .simulation.world import World
from .status import DroneStatus, Status
from .trace import Event, Trace
from .transitions import Transitions
from .virtual import Stuck, VirtualTime
from .watching import Deadlines
from .words import duration

if TYPE_CHECKING:
    from .app import App
    from .controls import Controls
    from .files.fleet import FleetFile
    from .gateway.commanding import Commanding
    from .journal.recorder import Recorder
    from .navigation import Navigation
    from .simulation.faults import Faults

Listener = Callable[[Event], object]
Around = Callable[["Kernel", "Controls"], "Controls"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What came of a flown plan."""

    duration: float
    """Seconds, until the last mission ended."""
    missions: tuple[Mission[Any], ...]
    drones: tuple[Drone, ...]
    flown: dict[str, float]
    """Metres, by the drones' ids."""
    events: tuple[Event, ...]
    given_up: str = ""
    """Why a simulation was ended that would have gone on for ever."""

    @property
    def crashed(self) -> int:
        """How many drones have crashed: nobody brings them back in a simulation."""
        return sum(drone.status is DroneStatus.LOST for drone in self.drones)

    @property
    def log(self) -> list[str]:
        """The lines of the console."""
        return [str(event["text"]) for event in self.events if event["event"] == "log"]

    def count(self, kind: str) -> int:
        """Return how many events of this kind there were."""
        return sum(event["event"] == kind for event in self.events)

    @property
    def completed(self) -> bool:
        """Whether every mission was completed."""
        return all(mission.status is Status.COMPLETED for mission in self.missions)


class Session:
    """One running app: its engine, over any navigation, on any kernel."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        navigation: Navigation,
        listeners: Sequence[Listener],
        recorder: Recorder | None = None,
        link: Commanding | None = None,
    ) -> None:
        self._kernel = kernel
        known = DroneStatus.FREE if recorder is None else DroneStatus.OFFLINE
        categories = {category.name: category for category in app.categories}
        self.drones = tuple(
            Drone(
                id=entry.id,
                category=categories[entry.category],
                home=entry.home,
                telemetry=navigation.telemetry(entry.id),
                status=known,
                index=index,
            )
            for index, entry in enumerate(fleet.drones)
        )
        trace, results = Trace(kernel, listeners), ResultStore()
        queue = Queue(kernel, trace, Reach(app, fleet.airspace), self.drones, fleet.max_airborne)
        self.core = Core(
            app=app,
            kernel=kernel,
            airspace=fleet.airspace,
            navigation=navigation,
            trace=trace,
            results=results,
            transitions=Transitions(kernel, trace, results),
            queue=queue,
            fleet=Fleet(
                kernel, trace, fleet.airspace, navigation, self.drones, queue, fleet.after_trip
            ),
            deadlines=Deadlines(kernel),
            recorder=recorder,
            link=link,
        )
        if recorder is not None:
            recorder.trace, recorder.results = trace, results
        self.engine = Engine(self.core)

    def start(self, missions: Sequence[Mission[Any]]) -> Task[float]:
        """Set the missions on their way; the task gives the time at which the last one ended.

        It is done when every drone is down as well.
        """
        self.set_out(missions)
        return self._kernel.spawn(self.see_through(), FLEET, "the session")

    def set_out(self, missions: Sequence[Mission[Any]]) -> None:
        """Start the missions."""
        # All this lives until the end: the garbage collector need not look at it again and again,
        # neither at what has been given while all set out, nor at that afterwards.
        freeze()
        self.engine.start(missions)
        freeze()

    async def see_through(self) -> float:
        """Wait until the last mission has ended and every drone is down; return when it ended."""
        engine = self.engine
        while True:
            await engine.done
            ended = self._kernel.now
            await self.core.fleet.all_down()
            if engine.done.is_set:  # and nobody has let a mission go on meanwhile
                return ended


class Simulation:
    """A session over simulated drones, all of whose events are kept."""

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
        categories = {category.name: category for category in app.categories}
        simulated = [
            SimulatedDrone(
                id=entry.id, category=categories[entry.category], home=entry.home, index=index
            )
            for index, entry in enumerate(fleet.drones)
        ]
        world = World(seed, fleet.airspace, fleet.world)
        self._navigation = SimulatedNavigation(
            kernel, simulated, world, faults, seed, fleet.airspace
        )
        gateway = Gateway(
            kernel,
            self._navigation if around is None else around(kernel, self._navigation),
            simulated,
            fleet.airspace,
            apart=fleet.apart,
            slack=slack,
            max_airborne=fleet.max_airborne,
        )
        self._events: list[Event] = []
        listeners = [self._events.append, *([listener] if listener else [])]
        self.session = Session(app, fleet, kernel, gateway.link(1), listeners)

    def outcome(
        self, missions: Sequence[Mission[Any]], ended: float, given_up: str = ""
    ) -> Outcome:
        """Return what has come of the missions."""
        drones = self.session.drones
        return Outcome(
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
) -> Outcome:
    """Fly the missions in virtual time, until the last one has ended or a time is reached.

    Without such a time it is given up where missions set out again and again for nothing.
    `around` puts something between the gateway and its drones; `slack` keeps them further apart.
    """
    kernel, bound = VirtualTime(), Bound(missions)

    def listen(event: Event) -> None:
        if on_event is not None:
            on_event(event)
        if until is None and (enough := bound.look(event)) is not None:
            kernel.crash(enough)

    simulation = Simulation(app, fleet, kernel, seed, faults, listen, around, slack)
    over = simulation.session.start(missions)
    try:
        if until is None:
            while not kernel.run(over, last := bound.last + IDLE):
                if bound.last + IDLE <= last:
                    raise Enough(bound.idle())
            ended = over.result()
        else:
            ended = over.result() if kernel.run(over, until) else kernel.now
    except Enough as enough:
        return simulation.outcome(missions, kernel.now, str(enough))
    except Stuck:
        queue = simulation.session.core.queue
        if not queue.waiting:
            raise
        raise BadInput(
            f"{app.name}: the simulation stops at {duration(kernel.now)}: missions wait for ever, "
            f"because the policy gives them none of the drones ({queue.standing()})"
        ) from None
    finally:
        kernel.close()
    return simulation.outcome(missions, ended)
