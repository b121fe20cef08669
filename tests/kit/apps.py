"""Apps for tests, all in this process: small ones of a flow written by hand, and compiled ones.

`flow`, `app`, `mission`, `trip` and `fleet` make a small app and its plan; `fly` simulates them.
`example` and `loaded` compile an app once a session and import it; `compiled` gives the package's folder.
"""

from __future__ import annotations

import atexit
import shutil
import sys
from collections.abc import Callable, Coroutine, Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module, invalidate_caches
from io import StringIO
from itertools import count
from pathlib import Path
from tempfile import mkdtemp
from types import ModuleType
from typing import Any

from pluto_fleet.app import App, described
from pluto_fleet.files.fleet import DroneEntry, FleetFile, load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain import app as brain_app
from pluto_fleet.shared.domain import model
from pluto_fleet.shared.domain.actions import BUILT_IN, Action
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fields import Entity, Field, FieldType
from pluto_fleet.shared.domain.model import AfterTrip, Category, Item, Point
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.fleet.policies import Policy, nearest
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.trials.drone_rules import Items
from pluto_fleet.trials.invariants import items_of
from plutoc.cli import main
from plutoc_blocks.clock.step import wait_for_time
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.gap_monitor.step import watch_gap
from plutoc_blocks.gate_fifo.step import pass_first
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_evaluator.step import evaluate_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.mission_repeater.step import repeat_mission
from plutoc_blocks.priority_manager.step import raise_priority
from plutoc_blocks.timer_monitor.step import watch_timer
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.step import watch_trip
from tests.paths import EXAMPLES

__all__ = ["EXAMPLES", "SimulationResult"]

Way = Callable[[Run[Any], Status], Coroutine[Any, Any, Status]]
NO_FAULTS = Faults()
SCOUT = Category(name="scout")


@dataclass(slots=True, kw_only=True, eq=False)
class Trip(model.Trip):
    """A trip with every field that a block may bring in."""

    delay: float | None = None
    priority: int = 0
    gap: float | None = None


@dataclass(slots=True, kw_only=True, eq=False)
class Mission(model.Mission[Trip]):
    """A mission with every field that a block may bring in."""

    at: float | None = None
    every: float | None = None
    safe_time: float | None = None
    repeat: int | bool = 0
    evaluator: str | None = None


FIELDS = tuple(
    Field(name=name, on=on, type=type_, label=name, default=default)
    for name, on, type_, default in (
        ("at", Entity.MISSION, FieldType.TIME_OF_DAY, None),
        ("every", Entity.MISSION, FieldType.TIME, None),
        ("safe_time", Entity.MISSION, FieldType.TIME, None),
        ("repeat", Entity.MISSION, FieldType.ROUNDS, 0),
        ("evaluator", Entity.MISSION, FieldType.EVALUATOR, None),
        ("delay", Entity.TRIP, FieldType.TIME, None),
        ("priority", Entity.TRIP, FieldType.INT, 0),
        ("gap", Entity.TRIP, FieldType.TIME, None),
    )
)


def app(
    flow: Callable[[Run[Mission]], Coroutine[Any, Any, Status]],
    *,
    categories: Sequence[Category] = (SCOUT,),
    actions: Sequence[Action] = (),
    evaluators: Mapping[str, Callable[..., object]] | None = None,
) -> App:
    """Return an app of this flow."""
    return described(
        brain_app.App(
            name="tested",
            title="Tested",
            flow=flow,
            mission=Mission,
            trip=Trip,
            fields=FIELDS,
            categories=tuple(categories),
            actions={**BUILT_IN, **{action.name: action for action in actions}},
            evaluators=evaluators or {},
        )
    )


def changed(app: App, **changes: Any) -> App:
    """Return an app with other facts, for the library and for its brain."""
    given: Any = app.given
    return described(replace(given, **changes))


def watched(run: Run[Any], status: Status) -> Coroutine[Any, Any, Status]:
    """A TripMonitor alone."""
    return watch_trip(run, status)


def allocated(run: Run[Any], status: Status) -> Coroutine[Any, Any, Status]:
    """A DroneAllocator alone."""
    return allocate_drone(run, status, block="allocate", policy=nearest)


launched = launch_trip
"""A TripLauncher alone."""


async def timed(run: Run[Any], status: Status) -> Status:
    """TripMonitor ∥ TimerMonitor → GateFIFO."""

    async def timer(run: Run[Any], status: Status) -> Status:
        return await watch_timer(run, status, default=None, safe_time=run.mission.safe_time)

    return await pass_first(run, status, watch_trip, timer)


async def gapped(run: Run[Any], status: Status) -> Status:
    """TripMonitor ∥ GapMonitor → GateFIFO."""

    async def gap(run: Run[Any], status: Status) -> Status:
        return await watch_gap(run, status, default=None, gap=run.mission.current.gap)

    return await pass_first(run, status, watch_trip, gap)


def flow(
    *,
    watch: Way = watched,
    clock: bool = False,
    attempts: int | None = None,
    evaluator: Callable[..., object] | None = None,
    repeater: bool = False,
    policy: Policy = nearest,
    within: float | None = None,
    fail_late: bool = False,
    prepare: Callable[..., object] | None = None,
) -> Callable[[Run[Mission]], Coroutine[Any, Any, Status]]:
    """Return create → [clock →] [modifier →] allocate → launch → watch, and what follows."""

    async def one_trip(run: Run[Mission], status: Status) -> Status:
        mission, at = run.mission, run.at
        if clock and at != "allocate":
            status = await wait_for_time(run, status, block="wait", delay=mission.current.delay)
        if prepare is not None and at is None:
            status = await modify_mission(run, status, hook=prepare)
        run.at = None
        status = await allocate_drone(
            run,
            status,
            block="allocate",
            policy=policy,
            allocate_within=within,
            fail_late=fail_late,
            priority=mission.current.priority,
        )
        return await watch(run, launch_trip(run, status))

    async def whole(run: Run[Mission]) -> Status:
        mission, status = run.mission, run.status
        if run.at is None:
            status = create_mission(run, status)
        while True:
            status = await one_trip(run, status)
            if status is Status.FAILED and attempts is not None:
                status = raise_priority(
                    run, status, max_attempts=attempts, priority=mission.current.priority
                )
            if status is Status.COMPLETED and evaluator is not None:
                status = await evaluate_mission(
                    run, status, hook=evaluator, evaluator=mission.evaluator
                )
            if status is Status.COMPLETED and repeater:
                status = repeat_mission(run, status, repeat=mission.repeat)
            if status is not Status.STANDBY:
                return status

    return whole


def modified(hook: Callable[..., object], *emits: Status) -> Way:
    """TripMonitor ∥ MissionModifier → GateFIFO: the thesis's third exercise."""

    async def limit(run: Run[Any], status: Status) -> Status:
        return await modify_mission(run, status, hook=hook, emits=emits)

    async def both(run: Run[Any], status: Status) -> Status:
        return await pass_first(run, status, watch_trip, limit)

    return both


def trip(name: str, x: float, y: float = 0.5, action: str = "take_photo", **more: Any) -> Trip:
    """Return a trip to a point at cruise height."""
    return Trip(name=name, action=action, target=(x, y, 1.2), **more)


def pick(name: str, x: float) -> Trip:
    """Return a trip that picks the pills."""
    return trip(name, x, action="pick_item", item=Item(name="pills", mass=0.004))


def release(name: str, x: float) -> Trip:
    """Return a trip that releases the pills."""
    return trip(name, x, action="release_item", item=Item(name="pills", mass=0.004))


def mission(name: str, *trips: Trip, index: int = 0, **more: Any) -> Mission:
    """Return a mission of these trips."""
    for place, each in enumerate(trips):
        each.index = place
    return Mission(name=name, trips=list(trips), index=index, **more)


def fleet(
    *homes: Point,
    categories: Sequence[str] = ("scout",),
    after: AfterTrip = AfterTrip.HOME,
    max_airborne: int | None = None,
    airspace: Airspace | None = None,
    apart: float = 0.0,
) -> FleetFile:
    """Return a fleet file; without homes, one drone at (0.5, 0.5).

    Drones do not wait for each other unless a test says so: most are about something else.
    """
    return FleetFile(
        airspace=airspace or Airspace(),
        drones=tuple(
            DroneEntry(id=f"cf{n}", category=categories[(n - 1) % len(categories)], home=home)
            for n, home in enumerate(homes or ((0.5, 0.5, 0.0),), start=1)
        ),
        after_trip=after,
        max_airborne=max_airborne,
        apart=apart,
    )


TWO = fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))
"""Two drones beside each other."""


def fly(
    tested: App,
    *missions: Mission,
    on: FleetFile | None = None,
    faults: Faults = NO_FAULTS,
    seed: int = 0,
    until: float | None = None,
) -> SimulationResult:
    """Fly missions in virtual time."""
    for index, each in enumerate(missions):
        each.index = index
    return simulate(
        tested, missions, on or fleet(), seed=seed, faults=faults, until=until, on_event=None
    )


def flown(
    *missions: Mission,
    on: FleetFile | None = None,
    faults: Faults = NO_FAULTS,
    seed: int = 0,
    until: float | None = None,
    categories: Sequence[Category] = (SCOUT,),
    actions: Sequence[Action] = (),
    **how: Any,
) -> SimulationResult:
    """Fly missions through a flow that is made so."""
    tested = app(flow(**how), categories=categories, actions=actions)
    return fly(tested, *missions, on=on, faults=faults, seed=seed, until=until)


def events(outcome: SimulationResult, kind: str) -> list[Event]:
    """Return the events of one kind."""
    return [event for event in outcome.events if event["event"] == kind]


def times(outcome: SimulationResult, kind: str) -> list[float]:
    """Return when events of one kind happened."""
    return [float(str(event["t"])) for event in events(outcome, kind)]


def moments(outcome: SimulationResult, kind: str) -> dict[str, float]:
    """Return when an event of this kind happened to each mission, the last time."""
    return {str(one["mission"]): float(str(one["t"])) for one in events(outcome, kind)}


# Compiled apps

NAMES = sorted(path.parent.name for path in EXAMPLES.glob("*/app.pluto"))
"""The examples."""

A_WEEK = 7 * 86_400.0
"""Seconds. A mission that has not ended by then never will: its end is missed in the trace."""

MISHAPS = {"crash": 0.10, "link": 0.05, "action": 0.05}
"""What `--fail crash=10%,link=5%,action=5%` lets go wrong."""

STRAIGHT_LEGS = '[motion]\nlegs = "straight"\n'
"""What a fleet file says whose drones are to be back in half of the time that a Crazyflie takes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """What came of one run."""

    outcome: SimulationResult
    trace: Sequence[Event]

    @property
    def ends(self) -> list[tuple[str, str]]:
        """How each mission ended, and why if it failed."""
        return [(mission.status.value, mission.reason) for mission in self.outcome.missions]


@dataclass(frozen=True, slots=True, kw_only=True)
class Example:
    """An example's package, imported, with its own two files."""

    name: str
    package: Path
    app: App
    missions: Sequence[model.Mission[Any]]
    items: Items
    fleet: FleetFile

    def fly(self, seed: int, mishaps: Mapping[str, float] | None = None) -> Flown:
        """Simulate the missions to their end."""
        trace: list[Event] = []
        outcome = simulate(
            self.app,
            deepcopy(self.missions),
            self.fleet,
            seed=seed,
            faults=Faults(**(mishaps or {})),
            until=A_WEEK,
            on_event=trace.append,
        )
        return Flown(outcome=outcome, trace=trace)


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """An app that was compiled and imported, and its hooks."""

    name: str
    package: Path
    app: App
    hooks: ModuleType


@cache
def example(name: str) -> Example:
    """Return an example, compiled and imported, once a session."""
    package = compiled(name)
    app = imported(name, package)
    fleet = load_fleet(EXAMPLES / name / "fleet.toml", app)
    missions = load_missions(EXAMPLES / name / "missions.toml", app, fleet.airspace)
    items = items_of(missions)
    return Example(name=name, package=package, app=app, missions=missions, items=items, fleet=fleet)


@cache
def loaded(text: str, hooks: str = "") -> Loaded:
    """Return the app of a source, once a session; `NAME` in it becomes a name of its own."""
    name = f"app_{next(_NUMBERS)}"
    folder = _folder() / name
    folder.mkdir()
    (folder / "app.pluto").write_text(text.replace("NAME", name), encoding="utf-8")
    (folder / "hooks.py").write_text(hooks, encoding="utf-8")
    package = compiled_file(folder / "app.pluto", folder / "package")
    (name,) = (path.name for path in (package / "src").iterdir() if path.is_dir())
    app = imported(name, package)
    return Loaded(name=name, package=package, app=app, hooks=sys.modules[f"{name}.hooks"])


_NUMBERS = count(1)


def compiled(name: str, into: Path | None = None) -> Path:
    """Return the folder of an example's package; `into` a folder it is the caller's own to change."""
    package = _example_package(name)
    return package if into is None else Path(shutil.copytree(package, into / name))


@cache
def _example_package(name: str) -> Path:
    return compiled_file(EXAMPLES / name / "app.pluto", _folder() / name)


@cache
def _folder() -> Path:
    """The folder of what is compiled in this session."""
    folder = Path(mkdtemp(prefix="pluto-apps-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def compiled_file(source: Path, package: Path) -> Path:
    """Compile an app as a person would, and return the package's folder."""
    said = StringIO()
    with redirect_stdout(said), redirect_stderr(said):
        code = main(["compile", str(source), "-o", str(package)])
    if code != 0:
        raise AssertionError(f"plutoc compile of {source} ended with {code}:\n{said.getvalue()}")
    return package


def imported(name: str, package: Path) -> App:
    """Import an app from its package's folder, in place of another of this name."""
    for known in [known for known in sys.modules if known.split(".")[0] == name]:
        del sys.modules[known]
    invalidate_caches()
    sys.path.insert(0, str(package / "src"))
    try:
        return described(import_module(f"{name}.flow").APP)
    finally:
        sys.path.remove(str(package / "src"))


def fly_straight(fleet: Path) -> None:
    """Let the drones of a fleet file fly straight."""
    with fleet.open("a", encoding="utf-8") as file:
        file.write(f"\n{STRAIGHT_LEGS}")
