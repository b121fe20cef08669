"""Hooks that write, or delete, any attribute that can be reached from what they are given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from random import Random
from types import SimpleNamespace
from typing import Any

from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.status import DroneStatus, Status, TripStatus
from pluto_fleet.shared.hooks.context import Verdict
from plutoc.block import HookKind
from plutoc.graph.model import Graph, Hook

DEEPEST = 5
FLIGHTS = 6
"""Steps from an argument to what is written; flights after which an evaluator asks for no more."""
MADE = 4
"""Missions that creators make at the most: those raise events, too."""
EVENTS = "smoke", "seen"
ODD_EVENTS = "late", "lost", "nothing", 7, None
ORIGIN = "id", "at", "track", "level", "mission", "drone", "time", "nonsense"
LOOKS = 12
"""Times that an action on the way goes on: not all flights last as long."""
PLACES = (1.0, 2.0, 1.2), (2, 3), [4.0, 4.0], (1e9, 0.0), (float("nan"), 1.0)
NUMBERS = -5, 0, 3, 10**30, 2.5, float("nan"), float("inf"), True
ALONG = (
    *({"action": "take_photo"}, {"action": "take_photo", "seconds": 0.0}),
    *({"action": "look", "metres": float("nan")}, {"action": "take_photo", "metres": "2 m"}),
    *({"action": "look", "parameters": 3}, {"action": "take_photo", "seconds": 2.0}),
)
VALUES: tuple[object, ...] = (
    *PLACES,
    *NUMBERS,
    None,
    "",
    "zzz",
    "1",
    "long" * 999,
    b"x",
    {},
    [],
    int,
)
STATUSES = (*Status, *TripStatus, *DroneStatus)
GIVES: Mapping[str | None, object] = {"int": 3, "float": 2.5, "text": "seen"}


class Vandals:
    """The hooks of one app; those of missions that are called bad write where they can, if `active`."""

    trip: Callable[..., Any]
    """Makes a trip of the app."""
    mission: Callable[..., Any]
    """Makes a mission of the app."""

    def __init__(self, seed: int, graph: Graph, active: bool) -> None:
        self._seed = seed
        self._active = active
        self._called = 0
        self._made = 0
        self.looked: dict[str, list[float]] = {}
        """When actions on the way went on, by the names that their trips had at the launch."""
        self._has_events = bool(graph.events)
        makers = {
            HookKind.MODIFIER: self._modifier,
            HookKind.EVALUATOR: self._evaluator,
            HookKind.POLICY: self._policy,
            HookKind.CREATOR: self._creator,
        }
        acts = {
            one.name: (
                self._along(one.name)
                if one.name in graph.along
                else self._action(one.name, one.returns)
            )
            for one in graph.actions
        }
        self.module = SimpleNamespace(
            **{one.name: makers[one.kind](one) for one in graph.hooks}, **acts
        )

    def _modifier(self, hook: Hook) -> Callable[..., object]:
        async def modifier(mission: Any, context: Any, **_: object) -> Status | None:
            chance = self._chance(hook.name, mission)
            answer = chance.choice(hook.emits) if hook.emits else None
            self._spoil(mission, mission, context)
            await context.sleep(chance.choice((0.0, 0.0, 0.5, 5.0)))
            self._raise(chance, mission, context)
            self._spoil(mission, mission, context)
            return answer and Status[answer.name]

        return modifier

    def _evaluator(self, hook: Hook) -> Callable[..., object]:
        def evaluator(mission: Any, results: Any, **_: object) -> Verdict:
            chance = self._chance(hook.name, mission)
            more = mission.attempts < FLIGHTS
            redo = mission.completed_trips[:1] if more and chance.random() < 0.5 else ()
            self._spoil(mission, mission, results)
            add = chance.choice((0, 1, 2)) if more and self._is_bad(mission) else 0
            return Verdict(redo=redo, add=[self._new(chance)] * add)

        return evaluator

    def _creator(self, hook: Hook) -> Callable[..., object]:
        def creator(event: Any, context: Any) -> object:
            chance = Random(f"{self._seed}/{hook.name}/{event.id}")
            spoils = SimpleNamespace(name="bad")
            self._spoil(spoils, event, context)
            living = context.missions
            if self._is_bad(spoils) and chance.random() < 0.3:
                for one in living:
                    if one.name.startswith("bad"):
                        context.cancel(one, chance.choice(("it is bad", "", 7)))
                        break
            if self._made >= MADE or chance.random() < 0.2:
                return None
            self._made += 1
            made = self.mission(name="bad made", trips=[self._new(chance)])
            if not self._is_bad(spoils):
                return made
            self._spoil(spoils, made, event, context)
            drawn = chance.random()
            return made if drawn < 0.8 else chance.choice((*VALUES, *living, self._new(chance)))

        return creator

    def _policy(self, hook: Hook) -> Callable[..., object]:
        def one_by_one(trip: Any, candidates: Any) -> object:
            self._spoil(trip, trip, candidates)
            return candidates[0]

        def for_all(waiting: Any, drones: Any, now: float) -> object:
            free = list(drones)
            pairs = []
            for one in waiting:
                with suppress(Exception):  # else it is a fault of who has waited longest
                    self._spoil(one.mission, one, waiting, drones)
                if drone := next((each for each in one.drones if each in free), None):
                    free.remove(drone)
                    pairs.append((one, drone))
            return pairs

        return Random(f"{self._seed}/{hook.name}").choice((one_by_one, for_all))

    def _action(self, name: str, returns: str | None) -> Callable[..., object]:
        async def action(drone: Any, trip: Any, context: Any, **_: object) -> object:
            self._spoil(trip, drone, trip, context)
            await context.sleep(1.0)
            self._raise(self._chance_of(name, trip), trip, context)
            self._spoil(trip, drone, trip, context)
            return GIVES.get(returns)

        action.__module__ = __name__
        action.__name__ = name
        return action

    def _along(self, name: str) -> Callable[..., object]:
        async def along(drone: Any, trip: Any, context: Any, **_: object) -> object:
            chance = self._chance_of(name, trip)
            looked = self.looked.setdefault(str(trip.name), [])
            for _look in range(chance.choice((1, LOOKS, LOOKS))):
                looked.append(context.now)
                if chance.random() < 0.2:
                    context.store(chance.choice((1, "seen", 2.5)))
                self._raise(chance, trip, context)
                self._spoil(trip, drone, trip, context)
                await context.sleep(0.5)
            if self._is_bad(trip) and chance.random() < 0.2:
                raise chance.choice((ActionFailed("it saw nothing"), ValueError("bad"), SystemExit))
            return chance.choice((None, 3, "seen"))

        along.__module__ = __name__
        along.__name__ = name
        return along

    def _raise(self, chance: Random, of: Any, context: Any) -> None:
        """Raise an event now and then; a bad one says of it what it likes."""
        if not self._has_events or chance.random() < 0.7:
            return
        if not self._is_bad(of):
            context.emit(chance.choice(EVENTS), at=chance.choice(((2.0, 3.0), None)))
            return
        given = {one: self._value(chance, (of, context)) for one in ORIGIN if chance.random() < 0.1}
        event: Any = chance.choice((*EVENTS, *EVENTS, *EVENTS, *ODD_EVENTS))
        with suppress(*[Exception] * (chance.random() < 0.9)):
            context.emit(event, **given)

    def _is_bad(self, of: Any) -> bool:
        return self._active and str(of.name).startswith("bad")

    def _chance(self, hook: str, mission: Any) -> Random:
        return Random(f"{self._seed}/{hook}/{mission.name}/{mission.attempts}")

    def _chance_of(self, hook: str, trip: Any) -> Random:
        return Random(f"{self._seed}/{hook}/{trip.name}/{trip.attempt}")

    def _spoil(self, of: Any, *given: object) -> None:
        """Write somewhere, a few times; what that raises is caught now and then."""
        self._called += 1
        chance = Random(f"{self._seed}/{self._called}")
        for _ in range(chance.choice((0, 1, 1, 2, 5)) if self._is_bad(of) else 0):
            with suppress(*[Exception] * (chance.random() < 0.8)):
                self._write(chance, given)

    def _write(self, chance: Random, given: tuple[object, ...]) -> None:
        here = _somewhere(chance, given)
        value = self._value(chance, given)
        if isinstance(here, list) and chance.random() < 0.8:
            at = chance.randint(0, len(here))
            name, *rest = chance.choice(
                (
                    *(("append", value), ("insert", at, value), ("extend", [value, *here])),
                    *(("__setitem__", at, value), ("__delitem__", at), ("clear",), ("reverse",)),
                )
            )
            getattr(here, name)(*rest)
        elif isinstance(here, dict):
            here["dose"] = value
        else:
            name = chance.choice(_names(here) or ["new"])
            if hasattr(here, "along") and chance.random() < 0.1:
                name = "along"
                value = chance.choice(ALONG)
            if chance.random() < 0.15:
                delattr(here, name)
            elif name == "reset" and chance.random() < 0.8:
                here.reset()
            else:
                setattr(here, name, value)

    def _value(self, chance: Random, given: tuple[object, ...]) -> object:
        drawn = chance.random()
        if drawn < 0.6:
            return chance.choice((*VALUES, *STATUSES))
        return self._new(chance) if drawn < 0.8 else _somewhere(chance, given)

    def _new(self, chance: Random) -> Any:
        """Return a new trip, sound or not."""
        more: dict[str, Any] = {"name": "bad new", "action": "take_photo", "target": (3.0, 3.0)}
        for name in ("name", "action", "target", "source", "parameters", "item", "index"):
            if chance.random() < 0.05:
                more[name] = chance.choice((*VALUES, {"dose": "1 g"}, {"quantity": "x"}))
        return self.trip(**more)


def _somewhere(chance: Random, given: tuple[object, ...]) -> Any:
    """Return what a walk over attributes and elements leads to."""
    here = chance.choice(given)
    for _ in range(chance.randint(0, DEEPEST)):
        here = chance.choice(_parts(here) or [here])
    return here


def _names(here: object) -> list[str]:
    """Return the names of all attributes but those that Python, or the runtime, keeps to itself."""
    return [name for name in dir(here) if not name.startswith("_")]


def _parts(here: Any) -> list[Any]:
    if isinstance(here, (str, bytes, int, float, type(None))):
        return []
    parts: list[Any] = []
    with suppress(Exception):
        parts += list(here.values()) if isinstance(here, Mapping) else list(here)[:5]
    for name in _names(here):
        with suppress(Exception):
            if not callable(part := getattr(here, name)):
                parts.append(part)
    return parts
