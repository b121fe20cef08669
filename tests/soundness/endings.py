"""Flies accepted apps with hooks that never change their mind: all that is accepted must end.

A modifier always says the same, an evaluator says the same until something is flown. So a loop that
should not have been accepted is gone round for ever; that nothing does but what a hook chose.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import StrEnum
from random import Random
from types import SimpleNamespace
from typing import Any

from pluto_fleet.app import App, described
from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import AfterTrip, Mission, Point, Results
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow import asking
from pluto_fleet.shared.hooks.context import Context, Verdict
from plutoc.block import HookKind
from plutoc.check.model import Checked
from plutoc.compile import planned
from plutoc.graph.model import Graph, Hook
from plutoc_runtime.domain.status import Status
from tests.equivalence.drivers import in_real_time
from tests.equivalence.flows import packaged
from tests.equivalence.patience import Spins

CALLS = 300
"""Of hooks between two launches, instead of a hundred thousand."""
FLIGHTS = 6
"""After so many an evaluator asks for no more."""
LONGEST = 2_000.0
"""Seconds after which those that still fly are left to it: a retry without a bound has no end."""
GOES_ROUND = "goes round in its graph for ever"


class End(StrEnum):
    """What becomes of a mission."""

    COMPLETED = "completed"
    FAILED = "failed"
    CHOSEN = "gone round for ever, as a modifier chose"
    FLIES = "still flying"
    HANGS = "HANGS"


@dataclass(slots=True, kw_only=True)
class Hooks:
    """The hooks of one run, and what they said to each mission since its last launch."""

    seed: int
    graph: Graph
    flown: dict[str, int] = field(default_factory=dict)
    free: dict[str, bool] = field(default_factory=dict)
    """Whether a modifier could have said something else, without failing the mission."""

    def module(self) -> SimpleNamespace:
        """Return a module `hooks` for the app."""
        makers = {
            HookKind.MODIFIER: self._modifier,
            HookKind.EVALUATOR: self._evaluator,
            HookKind.CREATOR: self._creator,
        }
        return SimpleNamespace(**{h.name: makers[h.kind](h) for h in self.graph.hooks})

    def _modifier(self, hook: Hook) -> Callable[..., object]:
        chance = Random(f"{self.seed}/{hook.name}")
        says = chance.choice(hook.emits) if hook.emits else None
        pause = chance.choice((0.0, 0.0, 0.001))

        async def modifier(mission: Mission[Any], context: Context) -> Status | None:
            if self.flown.get(mission.name) != mission.attempts:
                self.flown[mission.name], self.free[mission.name] = mission.attempts, False
            others = [status for status in hook.emits if status is not says]
            if mission.status.value == Status.COMPLETED.value:
                others = [status for status in others if status is Status.STANDBY]
            self.free[mission.name] |= bool(others) or (bool(hook.emits) and bool(mission.trips))
            await context.sleep(pause)
            return says

        modifier.__name__ = hook.name
        return modifier

    def _creator(self, hook: Hook) -> Callable[..., object]:
        def creator(event: object, context: object) -> None:
            return None

        creator.__name__ = hook.name
        return creator

    def _evaluator(self, hook: Hook) -> Callable[..., object]:
        async def evaluator(mission: Mission[Any], results: Results[Any, Any]) -> Verdict:
            more = mission.attempts < FLIGHTS
            chance = Random(f"{self.seed}/{hook.name}/{mission.attempts if more else ''}")
            if more and mission.completed_trips and chance.random() < 0.3:
                return Verdict(redo=(chance.choice(mission.completed_trips),))
            return Verdict(fail="not good enough") if chance.random() < 0.3 else Verdict()

        evaluator.__name__ = hook.name
        return evaluator


def endings(checked: Checked, seed: int, *, real: bool = False) -> tuple[End, ...]:
    """Fly an app's missions, and return what became of each."""
    hooks = Hooks(seed=seed, graph=checked.graph)
    app = packaged(planned(checked)).app(hooks.module(), patient=real)
    category = replace(app.categories[0], speed=2.0, flight_time=1e7)
    flown = described(replace(app, categories=(category,)))
    missions = _missions(flown, Random(seed))
    fly = in_real_time if real else simulate
    launched: dict[object, float] = {}
    ended: dict[object, None] = {}

    def hear(event: Event) -> None:
        if event["event"] == "trip.launched":
            launched[event["mission"]] = float(str(event["t"]))
        elif event["event"] == "mission.ended":
            ended[event["mission"]] = None

    try:
        with _fewer_calls():
            faults = Faults(action=(0.0, 0.2, 0.5)[seed % 3])
            fly(
                flown,
                missions,
                _fleet(flown),
                seed=seed,
                faults=faults,
                until=LONGEST,
                on_event=hear,
            )
    except (BadInput, Spins):
        return (End.HANGS,)
    return tuple(
        (
            _end(mission, hooks)
            if mission.name in ended
            else End.FLIES if launched.get(mission.name, 0.0) > LONGEST / 2 else End.HANGS
        )
        for mission in missions
    )


def _end(mission: Mission[Any], hooks: Hooks) -> End:
    if GOES_ROUND in mission.reason:
        return End.CHOSEN if hooks.free.get(mission.name) else End.HANGS
    return End.COMPLETED if mission.status.value == "COMPLETED" else End.FAILED


@contextmanager
def _fewer_calls() -> Iterator[None]:
    usual = asking.MOST_CALLS
    asking.MOST_CALLS = CALLS
    try:
        yield
    finally:
        asking.MOST_CALLS = usual


def _fleet(app: App) -> FleetFile:
    category, homes = app.categories[0].name, ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))
    drones = tuple(
        DroneEntry(id=f"cf{number}", category=category, home=home)
        for number, home in enumerate(homes, start=1)
    )
    return FleetFile(airspace=Airspace(), drones=drones, after_trip=AfterTrip.HOME, apart=0.0)


def _missions(app: App, rng: Random) -> list[Mission[Any]]:
    missions = []
    for place in range(2):
        trips = [
            app.trip(name=f"{number}", action="take_photo", target=_spot(rng), index=number)
            for number in range(rng.choice((1, 2)))
        ]
        mission = app.mission(name=f"m{place}", index=place, trips=trips)
        if hasattr(mission, "repeat"):
            mission.repeat = rng.choice((0, 1, 2))
        missions.append(mission)
    return missions


def _spot(rng: Random) -> Point:
    return float(rng.randint(1, 9)), float(rng.randint(1, 9)), 1.2
