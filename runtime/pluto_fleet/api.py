"""Apps from Python: simulate and fly one from a script or a notebook.

What cannot be done raises `BadInput`, with a sentence for a person. Metres, seconds, battery levels from
0 to 1. `docs/python.md` has an example of each function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from .app import App, described
from .cli.preflight import check_real
from .files.fleet import FleetFile, default_fleet, load_fleet
from .files.missions import load_missions
from .files.plan_check import endless, problems, wrong_fields
from .files.writing import fleet_text, missions_text
from .flight.config import End, FlightResult, FlightSetup, Stops
from .flight.live_flight import FlightObserver
from .flight.lives import flight_of, reopen, run_flight
from .flight.outcome import SimulationResult
from .flight.simulate import simulate as _simulate
from .jobs.reports import Down
from .journal.header import header
from .journal.store import Store
from .seam import check
from .shared.alone.world import Faults
from .shared.domain.airspace import Airspace
from .shared.domain.app import moving
from .shared.domain.errors import BadInput
from .shared.domain.model import Item, Mission, Point, Trip
from .shared.domain.status import Status, TripStatus
from .shared.domain.trace import Event
from .shared.domain.values import shortened
from .shared.hooks.loading import loaded
from .station.sight import noting

__all__ = [
    "Airspace",
    "App",
    "BadInput",
    "Down",
    "End",
    "Event",
    "FleetFile",
    "FlightResult",
    "Item",
    "Mission",
    "Point",
    "SimulationResult",
    "Status",
    "Stops",
    "Trip",
    "TripStatus",
    "default_fleet",
    "fly",
    "load_app",
    "load_fleet",
    "load_missions",
    "resume",
    "simulate",
]

Listener = Callable[[Event], object]


def load_app(package: str) -> App:
    """Return the app of a generated package, such as `greenhouse`.

    Its `mission` and `trip` are the classes of its missions and trips, with the fields of its graph.
    """
    brain = f"{package}._runtime"
    try:
        check(package, import_module(f"{brain}.command").SEAM)
    except ModuleNotFoundError as error:
        raise BadInput(f"{package} is no app that can be imported here: {error}") from error
    return described(loaded(lambda: import_module(f"{package}.flow").APP))


def simulate(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile | None = None,
    *,
    seed: int = 0,
    fail: Mapping[str, float] | None = None,
    until: float | None = None,
    on_event: Listener | None = None,
) -> SimulationResult:
    """Fly the missions in virtual time, and return what came of them.

    The missions are brought up to date. `fail`: what goes wrong, and how often, such as
    `{"crash": 0.02}`; `until`: stop then; `on_event` is called with each event as it happens.
    """
    on = fleet or default_fleet(app)
    _refuse(app, missions, on, endless(missions, app) if until is None else [])
    faults = Faults(**(fail or {}))
    return _simulate(app, missions, on, seed=seed, faults=faults, until=until, on_event=on_event)


async def fly(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile | None = None,
    *,
    journal: Path,
    real: bool = False,
    speed: float = 1.0,
    seed: int = 0,
    fail: Mapping[str, float] | None = None,
    stops: Stops | None = None,
    on_event: Listener | None = None,
) -> FlightResult:
    """Fly the missions in real time, and return when they have ended or all was stopped.

    The drones are simulated, `speed` times as fast as real ones, unless `real` says that those of the
    fleet shall fly. `journal` is a new file; from it `resume` goes on after any end. `on_event` is
    called with each event once that is durable; `stops.stop(…)` brings all drones down.
    """
    on = fleet or default_fleet(app)
    flown = moving(app, on.motion)
    _refuse(flown, missions, on, [])
    if real:
        check_real(flown, on, "the fleet", stand_ins=False)
    begun = header(
        app,
        missions=missions_text(app, missions),
        fleet=fleet_text(on),
        sim=not real,
        seed=seed,
        faults=fail,
    )
    store = Store.create(journal, begun)
    flight = flight_of(flown, store, missions, on, speed)
    stops = stops or Stops()
    return await run_flight(flight, store, stops, None, _observer(flight, stops, on_event))


async def resume(
    app: App,
    journal: Path,
    *,
    speed: float | None = None,
    stops: Stops | None = None,
    on_event: Listener | None = None,
) -> FlightResult:
    """Go on with the missions of a journal, with the drones with which they were begun."""
    taken = reopen(app, journal)
    try:
        if not taken.header["sim"]:
            check_real(taken.app, taken.fleet, f"{journal} (its fleet)", stand_ins=False)
    except BadInput:
        taken.store.close()  # it holds the journal's lock
        raise
    flight = taken.flight(speed)
    stops = stops or Stops()
    observer = _observer(flight, stops, on_event)
    return await run_flight(flight, taken.store, stops, taken.records, observer)


def _observer(flight: FlightSetup, stops: Stops, on_event: Listener | None) -> FlightObserver:
    def ignore(_: object) -> None:
        """What is not an event is in the journal, too."""

    return FlightObserver(tell=on_event or ignore, say=ignore, born=noting(flight, stops))


def _refuse(
    app: App, missions: Sequence[Mission[Any]], fleet: FleetFile, more: Sequence[str]
) -> None:
    """Raise `BadInput` with everything that is wrong with a plan."""
    found = [*wrong_fields(missions, app), *problems(missions, app, fleet, fleet.airspace), *more]
    if found:
        raise BadInput(shortened(found))
