"""Hooks that write, or delete, any attribute that can be reached from what they are given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from random import Random
from types import SimpleNamespace
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.shared.domain.status import DroneStatus, Status, TripStatus
from pluto_fleet.shared.hooks.context import Verdict
from plutoc.block import HookKind
from plutoc.graph.model import Graph, Hook
from tests.kit import apps

DEEPEST = 5
"""Steps from an argument to what is written."""
FLIGHTS = 6
"""After so many an evaluator asks for no more."""
PLAIN = (None, -5, 0, 3, 10**30, 2.5, float("nan"), float("inf"), 1e300, True, "", "zzz", "1", b"x")
MADE: tuple[Callable[[], object], ...] = (list, dict, object, set, lambda: "long" * 1_000)
TARGETS = ((1.0, 2.0, 1.2), (2, 3), [4.0, 4.0], (1e9, 0.0), (float("nan"), 1.0), "q", None)
GIVES: Mapping[str | None, object] = {"int": 3, "float": 2.5, "text": "seen"}


@dataclass(slots=True)
class Vandals:
    """The hooks of one app; those of a mission that is called bad write where they can."""

    seed: str
    graph: Graph
    active: bool
    trip: Callable[..., Any] = field(init=False)
    """Makes a new trip of the app."""
    called: int = 0

    def module(self) -> SimpleNamespace:
        """Return a module `hooks` for the app."""
        makers: dict[HookKind, Callable[[Hook], Callable[..., object]]] = {
            HookKind.MODIFIER: self._modifier,
            HookKind.EVALUATOR: self._evaluator,
            HookKind.POLICY: self._policy,
        }
        hooks = {hook.name: makers[hook.kind](hook) for hook in self.graph.hooks}
        acts = {one.name: self._action(one.name, one.returns) for one in self.graph.actions}
        return SimpleNamespace(**hooks, **acts)

    def _modifier(self, hook: Hook) -> Callable[..., object]:
        async def modifier(mission: Any, context: Any, **_: object) -> Status | None:
            chance = self._chance(hook.name, mission)
            answer = chance.choice(hook.emits) if hook.emits else None
            pause = chance.choice((0.0, 0.0, 0.5, 5.0))
            self.spoil(mission, mission, context)
            await context.sleep(pause)
            self.spoil(mission, mission, context)
            return answer and Status[answer.name]

        return modifier

    def _evaluator(self, hook: Hook) -> Callable[..., object]:
        def evaluator(mission: Any, results: Any, **_: object) -> Verdict:
            chance, more = self._chance(hook.name, mission), mission.attempts < FLIGHTS
            redo = mission.completed_trips[:1] if more and chance.random() < 0.5 else ()
            self.spoil(mission, mission, results)
            if self._is_bad(mission) and more:
                return Verdict(redo=redo, add=[self._new(chance)] * chance.choice((0, 1, 2)))
            return Verdict(redo=redo)

        return evaluator

    def _policy(self, hook: Hook) -> Callable[..., object]:
        def one_by_one(trip: Any, candidates: Any) -> object:
            self.spoil(trip, trip, candidates)
            return candidates[0]

        def for_all(waiting: Any, drones: Any, now: float) -> object:
            for one in waiting:
                with suppress(Exception):  # else it is a fault of who has waited longest
                    self.spoil(one.mission, one, waiting, drones)
            free, pairs = list(drones), []
            for one in waiting:
                if drone := next((each for each in one.drones if each in free), None):
                    free.remove(drone)
                    pairs.append((one, drone))
            return pairs

        return Random(f"{self.seed}/{hook.name}").choice((one_by_one, for_all))

    def _action(self, name: str, returns: str | None) -> Callable[..., object]:
        async def action(drone: Any, trip: Any, context: Any, **_: object) -> object:
            self.spoil(trip, drone, trip, context)
            await context.sleep(1.0)
            self.spoil(trip, drone, trip, context)
            return GIVES.get(returns)

        action.__module__, action.__name__ = __name__, name
        return action

    def _is_bad(self, of: Any) -> bool:
        """Whether this is a mission, or a trip of one, whose hooks write where they can."""
        return self.active and str(of.name).startswith("bad")

    def _chance(self, hook: str, mission: Any) -> Random:
        return Random(f"{self.seed}/{hook}/{mission.name}/{mission.attempts}")

    def spoil(self, of: Any, *given: object) -> None:
        """Write somewhere, a few times; what that raises is caught now and then."""
        if not self._is_bad(of):
            return
        self.called += 1
        chance = Random(f"{self.seed}/{self.called}")
        for _ in range(chance.choice((0, 1, 1, 2, 5))):
            if chance.random() < 0.8:
                with suppress(Exception):
                    self._write(chance, given)
            else:
                self._write(chance, given)

    def _write(self, chance: Random, given: tuple[object, ...]) -> None:
        here: Any = chance.choice(given)
        for _ in range(chance.randint(0, DEEPEST)):
            parts = _parts(here)
            if not parts:
                break
            here = chance.choice(parts)
        value = self._value(chance, given)
        if isinstance(here, list) and chance.random() < 0.8:
            at = chance.randint(0, len(here))
            with suppress(IndexError):
                chance.choice(
                    (
                        lambda: here.append(value),
                        lambda: here.insert(at, value),
                        lambda: here.extend([value, *here]),
                        lambda: here.__setitem__(at, value),
                        lambda: here.__delitem__(at),
                        here.clear,
                        here.reverse,
                    )
                )()
        elif isinstance(here, dict):
            here["dose"] = value
        else:
            name = chance.choice(_names(here) or ["new"])
            if chance.random() < 0.15:
                delattr(here, name)
            elif name == "reset" and chance.random() < 0.8:
                here.reset()
            else:
                setattr(here, name, value)

    def _value(self, chance: Random, given: tuple[object, ...]) -> object:
        if chance.random() < 0.35:
            return chance.choice(PLAIN)
        if chance.random() < 0.2:
            return chance.choice(MADE)()
        if chance.random() < 0.2:
            return chance.choice((*Status, *TripStatus, *DroneStatus))
        if chance.random() < 0.3:
            return chance.choice(TARGETS)
        if chance.random() < 0.4:
            return self._new(chance)
        here: Any = chance.choice(given)
        for _ in range(chance.randint(1, DEEPEST)):
            here = chance.choice(_parts(here) or [here])
        return here

    def _new(self, chance: Random) -> Any:
        """Return a new trip, sound or not."""
        more: dict[str, Any] = {"name": "bad new", "action": "take_photo", "target": (3.0, 3.0)}
        for name in ("name", "action", "target", "source", "parameters", "item", "index"):
            if chance.random() < 0.05:
                more[name] = chance.choice((*PLAIN, *TARGETS, {"dose": "1 g"}, {"quantity": "x"}))
        return self.trip(**more)


def _names(here: object) -> list[str]:
    """Return the names of all attributes but those that Python, or we, keep to ourselves."""
    return [name for name in dir(here) if not name.startswith("_")]


def _parts(here: Any) -> list[Any]:
    """Return all that can be reached from something in one step."""
    if isinstance(here, (str, bytes, int, float, type(None))):
        return []
    parts: list[Any] = []
    if isinstance(here, (list, tuple)) or hasattr(here, "__getitem__"):
        with suppress(Exception):
            parts += list(here.values()) if isinstance(here, Mapping) else list(here)[:5]
    for name in _names(here):
        with suppress(Exception):
            if not callable(part := getattr(here, name)):
                parts.append(part)
    return parts


def missions_of(app: App, trip: Callable[..., Any], rng: Random) -> list[Any]:
    """Return a good mission and two bad ones; the trips of those are called so, too."""
    made = []
    for place, name in enumerate(("good", "bad one", "bad two")):
        own = "" if name == "good" else "bad "
        trips = [
            trip(name=f"{own}{n}", target=(rng.uniform(1, 4), rng.uniform(1, 4), 1.2), index=n)
            for n in range(rng.choice((1, 2, 3)))
        ]
        needed = {one.name: one.sample for one in _needed(app, "mission")}
        made.append(app.mission(name=name, index=place, trips=trips, **needed))
        if hasattr(made[-1], "repeat"):
            made[-1].repeat = rng.choice((0, 1))
    return made


def trips_of(app: App, rng: Random) -> Callable[..., Any]:
    """Return what makes trips of an app: with actions that its first drones can do."""
    able = [
        one
        for one in app.actions.values()
        if app.categories[0].can(one.name) and not one.name.endswith("_item")
    ]

    def trip(**given: Any) -> Any:
        action = rng.choice(able)
        parameters = {one.name: one.default or "x" for one in action.parameters}
        needed = {one.name: one.sample for one in _needed(app, "trip")}
        return app.trip(**{"action": action.name, "parameters": parameters, **needed, **given})

    return trip


def _needed(app: App, on: str) -> list[Any]:
    return [one for one in app.fields if one.on.value == on and one.hint]


FLEET = apps.fleet(*[(0.5, 0.5, 0.0)] * 10)
"""All of one home: it does not matter who flies."""
