"""From an app, its missions and a fleet to a flown plan: puts the parts together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from gc import freeze
from typing import TYPE_CHECKING, Any

from ..domain.model import Drone, Mission
from ..domain.results import ResultStore
from ..domain.status import DroneStatus, Status
from ..domain.trace import Event, Trace
from ..fleet.fleet import Fleet
from ..fleet.queue import Queue
from ..fleet.reach import Reach
from ..time.kernel import FLEET, Kernel, Task
from ..trips.transitions import Transitions
from .engine import Engine
from .mission import Core, FailLater, Recorder

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..fleet.navigation import Navigation
    from ..trips.flight import Flight

Listener = Callable[[Event], object]


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
        """How many drones have crashed: none is brought back in a simulation."""
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
        fleet: FleetData,
        kernel: Kernel,
        navigation: Navigation[Flight],
        listeners: Sequence[Listener],
        recorder: Recorder | None = None,
        fail_later: FailLater | None = None,
        kind_of_fleet: type[Fleet] = Fleet,
        kind_of_engine: type[Engine] = Engine,
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
        queue = Queue(kernel, Reach(app, fleet.airspace), self.drones, fleet.max_airborne)
        self.core = Core(
            app=app,
            kernel=kernel,
            airspace=fleet.airspace,
            navigation=navigation,
            trace=trace,
            results=results,
            transitions=Transitions(kernel, trace, results),
            queue=queue,
            fleet=kind_of_fleet(
                kernel, trace, fleet.airspace, navigation, self.drones, queue, fleet.after_trip
            ),
            recorder=recorder,
            fail_later=fail_later,
        )
        if recorder is not None:
            recorder.trace, recorder.results = trace, results
        self.engine = kind_of_engine(self.core)

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
            if engine.done.is_set:  # and no mission has been let go on meanwhile
                return ended


def outcome_data(name: str, seed: int, outcome: Outcome) -> dict[str, object]:
    """Return the object that `simulate --json` prints."""
    return {
        "app": name,
        "seed": seed,
        "duration_s": outcome.duration,
        "missions": [
            {
                "name": mission.name,
                "status": mission.status.value,
                "reason": mission.reason,
                "completed_trips": [trip.name for trip in mission.completed_trips],
                "rounds": mission.round + 1,
                "attempts": mission.attempts,
            }
            for mission in outcome.missions
        ],
        "trips": trips_data(outcome),
        "drones": [
            {
                "id": drone.id,
                "trips": drone.trips,
                "flown_m": outcome.flown[drone.id],
                "battery_level": drone.battery_level,
                "status": drone.status.value,
            }
            for drone in outcome.drones
        ],
        "log": outcome.log,
        **({"crashed_drones": outcome.crashed} if outcome.crashed else {}),
        **({"given_up": outcome.given_up} if outcome.given_up else {}),
    }


def trips_data(outcome: Outcome) -> dict[str, int]:
    """Return how many flights there were, and how they ended."""
    return {
        "completed": outcome.count("trip.completed"),
        "failed": outcome.count("trip.failed"),
        "attempts": outcome.count("trip.launched"),
    }
