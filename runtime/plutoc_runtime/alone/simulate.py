"""Simulation of an app in virtual time, with ideal drones.

It ends even if a graph retries for ever what cannot succeed. The bound is on flights and not on
hours, as a plan may last for months.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any

from ..brain import Brain
from ..domain.airspace import Airspace
from ..domain.app import moving
from ..domain.fleet_data import DroneData, FleetData
from ..domain.model import Mission
from ..domain.motion import CRAZYFLIE
from ..domain.status import DroneStatus
from ..domain.text import counted, quoted
from ..domain.trace import Clock, Event
from ..flow.record import fleet_data
from ..hooks.plain_data import mission_data
from ..time.told import Stuck
from .drones import IdealDrones

if TYPE_CHECKING:
    from ..domain.app import App
    from .world import Faults

Listener = Callable[[Event], object]
Run = Callable[[float | None], bool]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """The outcome of a simulation."""

    duration: float  # seconds, until the last mission ended
    standing: Mapping[str, Any]  # where missions and drones stood then, as the brain says
    flown: dict[str, float]  # metres, by the drones' ids
    events: tuple[Event, ...]
    given_up: str = ""  # why a simulation was ended that would have gone on for ever

    @property
    def crashed(self) -> int:
        """How many drones have crashed; in a simulation none is repaired."""
        stand = self.standing["drones"].values()
        return sum(drone["status"] == DroneStatus.LOST.value for drone in stand)

    @property
    def log(self) -> list[str]:
        """The lines of the console."""
        return [str(event["text"]) for event in self.events if event["event"] == "log"]

    def count(self, kind: str) -> int:
        """Return how many events of this kind there were."""
        return sum(event["event"] == kind for event in self.events)


def default_fleet(app: App) -> FleetData:
    """Return the fleet that is used without a file: five drones on an empty map."""
    kinds = [category.name for category in app.categories] * 5
    drones = [
        DroneData(id=f"cf{place}", category=kind, home=(float(place), 0.5, 0.0))
        for place, kind in enumerate(kinds[:5], 1)
    ]
    return FleetData(airspace=Airspace(), drones=drones, motion=CRAZYFLIE)


def simulate(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetData,
    *,
    seed: int,
    faults: Faults,
    until: float | None = None,
    on_event: Listener | None = None,
    new_brain: Callable[..., Brain] = Brain,
    prepare: Callable[[Alone], Run] | None = None,
) -> Outcome:
    """Fly the missions until the last one has ended or a time is reached.

    Without such a time it is given up if missions fly again and again without success. `prepare` is called
    before anything begins, and returns what runs the world until a time.
    """
    app = moving(app, fleet.motion, charges=fleet.charges_at_home)
    bound = Bound(missions)
    events = list[Event]()

    def listen(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)
        if until is None:
            bound.look(event)

    brain = new_brain(app, fleet_data(fleet), space=fleet.airspace)
    with closing(brain):
        flown = Alone(app, fleet, faults, seed, brain, listen)
        run = flown.run if prepare is None else prepare(flown)
        flown.begin(missions)
        ended, given_up = see_through(brain, flown, run, bound, until)
        return Outcome(
            duration=ended,
            standing=brain.standing(),
            flown={drone.id: drone.flown(flown.now) for drone in flown.drones.drones.values()},
            events=tuple(events),
            given_up=given_up,
        )


class Alone:
    """A brain and ideal drones, in virtual time."""

    def __init__(
        self, app: App, fleet: FleetData, faults: Faults, seed: int, brain: Brain, hear: Listener
    ) -> None:
        self.now = 0.0
        self.brain = brain
        self._app = app
        self._hear = hear
        self._happens = () if fleet.world is None else fleet.world.events
        kinds = (part.drones() for part in app.parts)
        kind = next(filter(None, kinds), IdealDrones)
        self.drones = kind(app, fleet, faults, seed, self)

    def begin(self, missions: Sequence[Mission[Any]]) -> None:
        """Begin missions at this instant."""
        self._tell({})
        begun = [{"name": one.name, **mission_data(self._app, one)} for one in missions]
        self.brain.begin(begun, self.now)
        self.brain.tell({"happens": self._happens}, self.now)
        self._listen()

    def run(self, until: float | None) -> bool:
        """Fly until everything has ended, or until a time; return whether it has ended."""
        brain = self.brain
        drones = self.drones
        while brain.over is None:
            for order in brain.orders():
                drones.obey(order)
            due = brain.due
            soon = drones.due
            when = soon if due is None else min(soon, due)
            if when == inf:
                raise Stuck("nothing will ever happen again")
            if until is not None and when > until:
                self.now = until
                brain.tell({"telemetry": drones.news()}, until)
                return False
            self.now = when
            if soon <= when:
                while not (told := drones.advance()) and drones.due <= when:
                    pass  # what has only begun is told with what follows at this instant
                self._tell(told)
            else:
                self._tell({})
                brain.advance(when)
            self._listen()
        return True

    def _tell(self, message: dict[str, Any]) -> None:
        if (news := self.drones.news()) or message:
            self.brain.tell({**message, "telemetry": news}, self.now)

    def _listen(self) -> None:
        for event in self.brain.events():
            self._hear(event)


FLIGHTS = 1_000  # the most flights for each planned trip in one round of its mission
IDLE = 366 * 86_400.0  # the longest time without a launch, in seconds
MORE = "to fly on, say how long with --until, such as --until 2h"


class Enough(Exception):
    """Raised to give up a simulation; the message says why."""


class Bound:
    """Limits the flights of each mission."""

    def __init__(self, missions: Sequence[Mission[Any]]) -> None:
        self._most = {one.name: FLIGHTS * max(1, len(one.trips)) for one in missions}
        self._flights = dict.fromkeys(self._most, 0)
        self._rounds = {one.name: getattr(one, "repeat", 0) for one in missions}
        """How many rounds are planned; a hook may ask for more."""
        self.last = 0.0  # when the last flight was launched, or will be after a delay

    def look(self, event: Mapping[str, Any]) -> None:
        """Count an event; raise `Enough` if the simulation would not end."""
        what = event["event"]
        if what == "trip.delayed":
            self.last = max(self.last, event["until"])
        elif what == "mission.repeated" and event["round"] <= self._rounds.get(event["mission"], 0):
            self._flights[event["mission"]] = 0
        elif what == "trip.launched":
            name = event["mission"]
            self.last = max(self.last, event["t"])
            self._flights[name] = flights = self._flights.get(name, 0) + 1
            most = self._most.get(name, FLIGHTS)
            if flights >= most:
                trips = counted(most // FLIGHTS, "trip")
                said = f"mission {quoted(name)} has set out {flights} times for {trips}"
                raise Enough(f"{said}, and nothing ends that; {MORE}")


def see_through(
    brain: Brain, clock: Clock, run: Run, bound: Bound, until: float | None
) -> tuple[float, str]:
    """Fly the missions that have begun until the last one has ended or a time is reached.

    Return when that was, and why it was given up, if it was: without such a time a bound holds.
    """
    last = bound.last + IDLE if until is None else until
    try:
        while not run(last) and until is None:
            if bound.last + IDLE <= last:
                days = f"nothing has set out for {IDLE / 86_400:.0f} days"
                raise Enough(f"{days}, and missions are not at their end; {MORE}")
            last = bound.last + IDLE
        return (clock.now if brain.over is None else brain.over), ""
    except Enough as enough:
        return clock.now, str(enough)
    except Stuck:
        if not (waiting := brain.standing()["waiting"]):
            raise
        never = "missions wait for ever, because the policy gives them none of the drones"
        return clock.now, f"{never} ({waiting})"


def outcome_data(name: str, seed: int, outcome: Outcome) -> dict[str, object]:
    """Return the object that `simulate --json` prints."""
    drained = {one["drone"]: None for one in outcome.events if one["event"] == "drone.drained"}
    return {
        "app": name,
        "seed": seed,
        "duration_s": outcome.duration,
        "missions": [
            {
                "name": mission,
                "status": stands["status"],
                "reason": stands["reason"],
                "completed_trips": [trip["name"] for trip in stands["done"]],
                "rounds": stands["round"] + 1,
                "attempts": stands["attempts"],
                **promised(stands),
            }
            for mission, stands in outcome.standing["missions"].items()
        ],
        "trips": trips_data(outcome),
        "drones": [
            {
                "id": drone,
                "trips": stands["trips"],
                "flown_m": outcome.flown[drone],
                "battery_level": stands["battery"],
                "status": stands["status"],
            }
            for drone, stands in outcome.standing["drones"].items()
        ],
        "log": outcome.log,
        **({"drained": list(drained)} if drained else {}),
        **({"crashed_drones": outcome.crashed} if outcome.crashed else {}),
        **({"given_up": outcome.given_up} if outcome.given_up else {}),
    }


def promised(stands: Mapping[str, Any]) -> dict[str, object]:
    """Return when a mission is to have ended, if it is, and whether it was late."""
    deadline = stands.get("promises", {}).get("deadline")
    return {} if deadline is None else {"deadline_s": deadline, "late": stands["late"]}


def trips_data(outcome: Outcome) -> dict[str, int]:
    """Return how many flights there were, and how they ended."""
    asked = {"completed": "completed", "failed": "failed", "attempts": "launched"}
    return {name: outcome.count(f"trip.{kind}") for name, kind in asked.items()}
