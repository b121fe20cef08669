"""The question: which missions are to be completed, by when, and what may go wrong; and one run of it.

Batteries may be swapped by a person instead of charged in the dock. A swap is simulated as a charge that is
as short. The batteries that were taken out are charged outside of the drones, in the time that the app
says; the most that are charging at once is how many spare ones are needed, so that a full one is at hand
for every swap.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from heapq import heappop, heappush
from typing import Any, NamedTuple

from ..app import App
from ..files.fleet import FleetFile
from ..flight.outcome import SimulationResult
from ..flight.simulate import simulate
from ..shared.alone.world import Faults
from ..shared.domain.model import Mission
from ..shared.domain.motion import charging
from ..shared.domain.status import Status
from ..shared.domain.trace import Event
from ..shared.fleet.reach import docked
from ..trials.case import fresh

LATE = "is late: its deadline has passed"
"""What is said of a mission that is completed, and later than its own deadline."""


class Run(NamedTuple):
    """What came of one run."""

    success: bool
    seconds: float
    """Until its last mission ended, or the time was up."""
    mission: str = ""
    """The first that failed, or else one that was not completed in time; empty after a success."""
    reason: str = ""
    """Why it failed, without what differs from run to run; empty: it was not completed by then; `LATE`."""
    batteries: tuple[tuple[str, int], ...] = ()
    """How many were on chargers at once, at most, by category: where they are swapped."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """Missions, and when they have succeeded."""

    app: App
    missions: Sequence[Mission[Any]]
    faults: Faults = field(default_factory=Faults)
    begin: float = 0.0
    """When the first mission may begin, in seconds after the start of a simulation."""
    by: float | None = None
    """When all must be completed; None: no matter when."""
    swapped: App | None = None
    """The app with its true times of charging, if batteries are swapped instead."""

    @property
    def within(self) -> float | None:
        return None if self.by is None else self.by - self.begin

    def alone(self, name: str) -> Question:
        """Return the same for one mission alone, no matter by when, and with nothing that goes wrong."""
        missions = [mission for mission in self.missions if mission.name == name]
        return replace(self, missions=missions, faults=Faults(), by=None)

    def fly(self, fleet: FleetFile, seed: int) -> Run:
        outcome = simulate(
            self.app,
            [fresh(mission) for mission in self.missions],
            replace(fleet, charges_at_home=True) if self.swapped else fleet,
            seed=seed,
            faults=self.faults,
            until=self.by,
            on_event=None,
        )
        batteries = most_charging(self.swapped, fleet, outcome.events) if self.swapped else ()
        seconds = outcome.duration - self.begin
        late = [one.name for one in outcome.missions if one.late]
        if outcome.completed and not late:
            return Run(True, seconds, batteries=batteries)
        if outcome.completed:
            return Run(False, seconds, late[0], LATE, batteries)
        return Run(False, seconds, *_failure(outcome), batteries)


def _failure(outcome: SimulationResult) -> tuple[str, str]:
    for event in outcome.events:
        if event["event"] == "mission.ended" and event["status"] != Status.COMPLETED.value:
            ids = [drone.id for drone in outcome.drones]
            return str(event["mission"]), _typical(str(event["reason"]), ids)
    open_ = [one for one in outcome.missions if one.status is not Status.COMPLETED]
    return open_[-1].name, outcome.given_up


def _typical(reason: str, drones: Sequence[str]) -> str:
    """Return a reason without the place, and without the drone."""
    anyone = "|".join(map(re.escape, sorted(drones, key=len, reverse=True)))
    reason = re.sub(rf"\b(?:{anyone})\b", "a drone", reason)
    return re.sub(r" at \([-\d., ]+\)", "", reason)


FULL = 0.999
"""A battery that is as full as this is not swapped."""


def swapping(app: App, seconds: float) -> App:
    """Return the app with batteries that are swapped within so many seconds."""
    given: Any = app.given

    def faster(one: Any) -> Any:
        return replace(one, charge_time=min(one.charge_time, seconds))

    return replace(
        app,
        categories=tuple(map(faster, app.categories)),
        given=replace(given, categories=tuple(map(faster, given.categories))),
    )


def most_charging(
    app: App, fleet: FleetFile, events: Iterable[Event]
) -> tuple[tuple[str, int], ...]:
    """Return how many batteries of each category are charging at once, at most.

    `app` says how long that takes. A drone's battery is swapped whenever it has landed in its dock.
    """
    categories = {category.name: category for category in app.categories}
    drones = {drone.id: drone for drone in fleet.drones}
    flown = dict.fromkeys(drones, False)
    chargers: dict[str, list[float]] = {}
    """When each battery will be full, by category."""
    most: dict[str, int] = {}
    for event in events:
        what = event["event"]
        if what == "trip.launched":
            flown[str(event["drone"])] = True
        elif what in _DOCKED and flown[(id := str(event["drone"]))]:
            drone = drones[id]
            now = event["t"]
            level = event["battery"]
            if level >= FULL or not docked(tuple(event["at"]), drone.home):
                continue
            flown[id] = False
            on = chargers.setdefault(drone.category, [])
            while on and on[0] <= now:
                heappop(on)
            kind = categories[drone.category]
            heappush(on, now + charging(level, 1.0, kind.charge_time, kind.motion.taper))
            most[drone.category] = max(most.get(drone.category, 0), len(on))
    return tuple(sorted(most.items()))


_DOCKED = ("drone.free", "drone.charging")
