"""From an app, its missions and a fleet to a flown plan: puts the parts together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .allocation import Queue
from .core import Core
from .engine import Engine
from .errors import BadInput
from .fleet import Fleet
from .kernel import FLEET, Kernel, Task
from .model import Drone, Mission
from .results import ResultStore
from .simulation.drones import SimulatedDrone, SimulatedNavigation
from .simulation.world import World
from .status import Status
from .trace import Event, Trace
from .transitions import Transitions
from .virtual import Stuck, VirtualTime
from .words import duration

if TYPE_CHECKING:
    from .app import App
    from .files.fleet import FleetFile
    from .simulation.faults import Faults

Listener = Callable[[Event], None]


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
    """One running app: its engine, over simulated drones, on any kernel."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        seed: int,
        faults: Faults,
        listener: Listener | None,
    ) -> None:
        self._kernel = kernel
        categories = {category.name: category for category in app.categories}
        simulated = [
            SimulatedDrone(
                id=entry.id, category=categories[entry.category], home=entry.home, index=index
            )
            for index, entry in enumerate(fleet.drones)
        ]
        world = World(seed, fleet.airspace, fleet.world)
        self.navigation = SimulatedNavigation(
            kernel, simulated, world, faults, seed, fleet.airspace
        )
        self.drones = tuple(
            Drone(
                id=drone.id,
                category=drone.category,
                home=drone.home,
                telemetry=self.navigation.telemetry(drone.id),
                index=drone.index,
            )
            for drone in simulated
        )
        self.trace, results = Trace(kernel, listener), ResultStore()
        queue = Queue(kernel, app, fleet.airspace, self.drones, fleet.max_airborne)
        self.core = Core(
            app=app,
            kernel=kernel,
            airspace=fleet.airspace,
            navigation=self.navigation,
            trace=self.trace,
            results=results,
            transitions=Transitions(kernel, self.trace, results),
            fleet=Fleet(
                kernel,
                self.trace,
                fleet.airspace,
                self.navigation,
                self.drones,
                queue,
                fleet.after_trip,
            ),
        )
        self.engine = Engine(self.core)

    def start(self, missions: Sequence[Mission[Any]]) -> Task[float]:
        """Set the missions on their way; the task gives the time at which the last one ended.

        It is done when every drone is down as well.
        """
        self.engine.start(missions)
        return self._kernel.spawn(self._see_through(), FLEET, "the session")

    async def _see_through(self) -> float:
        await self.engine.done
        ended = self._kernel.now
        await self.core.fleet.all_down()
        return ended

    def outcome(self, missions: Sequence[Mission[Any]], ended: float) -> Outcome:
        """Return what has come of the missions."""
        return Outcome(
            duration=ended,
            missions=tuple(missions),
            drones=self.drones,
            flown={drone.id: self.navigation.flown(drone.id) for drone in self.drones},
            events=tuple(self.trace.events),
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
) -> Outcome:
    """Fly the missions in virtual time, until the last one has ended or a time is reached."""
    kernel = VirtualTime()
    session = Session(app, fleet, kernel, seed, faults, on_event)
    over = session.start(missions).done
    try:
        ended = over.result() if kernel.run(over, until) else kernel.now
    except Stuck:
        queue = session.core.fleet.queue
        if not queue.waiting:
            raise
        raise BadInput(
            f"{app.name}: the simulation stops at {duration(kernel.now)}: missions wait for ever, "
            f"because the policy gives them none of the drones ({queue.standing()})"
        ) from None
    finally:
        kernel.close()
    return session.outcome(missions, ended)
