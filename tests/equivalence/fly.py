"""Flies an app in a world, and keeps everything that can be seen of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from pluto_fleet.app import described
from pluto_fleet.flight.outcome import SimulationResult, result_of
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.simulate import simulate as by_itself
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Drone, Mission, Point
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.domain.trace import Event
from tests.equivalence.behaviour import Behaviour
from tests.equivalence.flows import Package
from tests.equivalence.patience import Spins
from tests.equivalence.worlds import World

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.files.fleet import FleetFile
    from pluto_fleet.shared.alone.world import Faults
    from pluto_fleet.shared.domain.app import Flow
    from pluto_fleet.shared.flow.run import Run

ANY: tuple[type[Exception], ...] = (Exception,)
"""All that ends a run is kept, and compared."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """What came of a run."""

    events: tuple[Event, ...]
    diary: tuple[str, ...]
    """What the hooks saw."""
    ends: tuple[str, ...]
    """How missions, trips and drones stood at last; or the error that ended the run."""
    lengths: tuple[float, ...]
    """How long the trips took, to the last bit."""
    coincidences: int
    """Trips that were completed at the very instant of their mission's safe time."""
    broken: bool
    """An error ended the run that is no answer to bad input."""
    spins: bool
    """It was broken off: it went round for ever. When that was noticed is no part of the trace."""


class Fly(Protocol):
    """What flies missions: `simulate` of the runtime, or another driver of the same kind."""

    def __call__(
        self,
        app: App,
        missions: Sequence[Mission[Any]],
        fleet: FleetFile,
        *,
        seed: int,
        faults: Faults,
        until: float | None,
        on_event: Callable[[Event], None] | None,
    ) -> SimulationResult: ...


class Told(NamedTuple):
    """What a brain alone says of a drone."""

    location: Point
    battery_level: float
    landed: bool


def alone(
    app: App, missions: Sequence[Mission[Any]], fleet: FleetFile, **how: Any
) -> SimulationResult:
    """Fly without the library."""
    given: Any = app.given
    outcome = by_itself(given, missions, fleet, **how)

    def told(drone: str) -> Told:
        stands = outcome.standing["drones"][drone]
        return Told(tuple(stands["at"]), stands["battery"], stands["landed"])

    return result_of(moving(given, fleet.motion), missions, fleet, outcome, told)


def record(package: Package, world: World, *, fly: Fly = simulate, patient: bool = True) -> Record:
    """Fly a package in a world."""
    events: list[Event] = []
    behaviour = Behaviour(
        seed=world.seed, limits=world.limits, patient=patient, clock=lambda: _now(events)
    )
    app = package.app(behaviour.hooks(package.graph))
    if world.entry is not None and world.entry[0] in app.resumes:
        block, status = world.entry
        entry = block, Status(status.value)
        app = replace(app, flow=_entered(app.flow, entry))
    flown = described(app)
    missions = world.made(flown)
    ends: Sequence[str]
    try:
        outcome = fly(
            flown,
            missions,
            world.fleet,
            seed=world.seed,
            faults=world.faults,
            until=world.until,
            on_event=events.append,
        )
        ends = [*_ends(outcome), *map(repr, outcome.flown.items())]
        broken = spins = False
    except ANY as error:
        ends = [f"{type(error).__name__}: {error}"]
        spins = isinstance(error, Spins)
        broken = not isinstance(error, BadInput | Spins)
    return Record(
        events=tuple(events),
        diary=tuple(behaviour.diary),
        ends=tuple(ends),
        lengths=tuple(_lengths(missions)),
        coincidences=sum(map(_just_in_time, missions)),
        broken=broken,
        spins=spins,
    )


def _entered(flow: Flow, entry: tuple[str, Status]) -> Flow:
    """Return a flow from where a mission was interrupted, though it has flown nothing."""

    async def entered(run: Run[Mission[Any]]) -> Status:
        run.core.transitions.create(run.mission)
        run.at, run.status = entry
        return await flow(run)

    return entered


def _now(events: Sequence[Event]) -> float:
    """Evaluators and policies are told no time: the last event's is near enough."""
    return float(str(events[-1]["t"])) if events else 0.0


def _ends(outcome: SimulationResult) -> list[str]:
    return [
        f"over after {outcome.duration!r}",
        *(_mission(mission) for mission in outcome.missions),
        *(_drone(drone) for drone in outcome.drones),
    ]


def _mission(mission: Mission[Any]) -> str:
    trips = [
        (
            trip.name,
            trip.status.value,
            trip.attempt,
            trip.start_time,
            trip.end_time,
            trip.reason,
            trip.drone.id if trip.drone else None,
        )
        for trip in (*mission.trips, *mission.completed_trips)
    ]
    stands = (mission.status.value, mission.reason, mission.round, mission.attempts)
    return f"{mission.name}: {stands} {len(mission.trips)} to do {trips}"


def _drone(drone: Drone) -> str:
    stands = (drone.status.value, drone.trips, drone.battery_level, drone.location)
    return f"{drone.id}: {stands}"


def _lengths(missions: Sequence[Mission[Any]]) -> list[float]:
    return [
        trip.end_time - trip.start_time
        for mission in missions
        for trip in (*mission.trips, *mission.completed_trips)
        if trip.start_time is not None and trip.end_time is not None
    ]


def _just_in_time(mission: Mission[Any]) -> int:
    safe = getattr(mission, "safe_time", None)
    if not isinstance(safe, float) or not safe:
        return 0
    return sum(trip.end_time == (trip.start_time or 0.0) + safe for trip in mission.completed_trips)


def difference(one: Record, other: Record) -> str | None:
    """Return the first difference of two runs in words, or None."""
    if one.spins and other.spins:
        return None
    for what, left, right in (
        ("event", _lines(one.events), _lines(other.events)),
        ("call of a hook", one.diary, other.diary),
        ("end", one.ends, other.ends),
    ):
        for number in range(max(len(left), len(right))):
            a = left[number] if number < len(left) else "nothing"
            b = right[number] if number < len(right) else "nothing"
            if a != b:
                return f"{what} {number + 1}:\n  plain:     {a}\n  optimised: {b}"
    return None


def _lines(events: Sequence[Event]) -> list[str]:
    return [repr(event) for event in events]
