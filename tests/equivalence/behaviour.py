"""Hooks of an app, made up from a seed: the same calls in the same order bring the same.

They keep a diary. What a hook saw, when, and whether it went on after its wait is compared, too:
it is what a developer would notice first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random
from types import SimpleNamespace
from typing import Any

from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.model import Drone, Mission, Results, Trip
from pluto_fleet.shared.domain.status import TripStatus
from pluto_fleet.shared.events.context import Context as EventContext
from pluto_fleet.shared.events.declared import Event
from pluto_fleet.shared.hooks.context import Context, Verdict
from plutoc.block import HookKind
from plutoc.graph.model import Graph, Hook
from plutoc_runtime.domain.status import Status

PAUSES = (0.0, 0.0, 0.5, 1.0, 2.0, 4.0, 6.5, 15.0)
MADE = 3
"""Missions that a creator makes: their hooks raise events, too."""
PATIENCE = 40
"""Calls of a mission's hooks, after which they raise: some graphs are mazes without a way out."""

AnyMission = Mission[Any]


@dataclass(kw_only=True, eq=False)
class Behaviour:
    """The hooks of one run."""

    seed: int
    limits: Sequence[float] = (5.0,)
    """Times from a trip's start at which something else may happen too."""
    patient: bool = True
    """Its hooks wait now and then. Those that never do are over in the instant of their call."""
    clock: Callable[[], float] = lambda: 0.0
    diary: list[str] = field(default_factory=list)
    calls: Counter[tuple[str, str]] = field(default_factory=Counter)
    raises: bool = False
    """They raise events now and then."""

    def hooks(self, graph: Graph) -> SimpleNamespace:
        """Return a module `hooks` for an app."""
        self.raises = bool(graph.events)
        made = {
            one.name: (self._along if one.name in graph.along else self._action)(one.name)
            for one in graph.actions
        }
        makers = {
            HookKind.MODIFIER: self._modifier,
            HookKind.EVALUATOR: self._evaluator,
            HookKind.POLICY: self._policy,
            HookKind.CREATOR: self._creator,
        }
        for hook in graph.hooks:
            made[hook.name] = makers[hook.kind](hook)
        for name, function in made.items():
            function.__name__ = name
        return SimpleNamespace(**made)

    def _chance(self, name: str, mission: str) -> Random:
        """Return the luck of one call."""
        self.calls[name, mission] += 1
        return Random(f"{self.seed}/{name}/{mission}/{self.calls[name, mission]}")

    def _tired(self, mission: AnyMission) -> bool:
        self.calls["", mission.name] += 1
        return self.calls["", mission.name] > PATIENCE

    def _note(self, name: str, what: str, mission: AnyMission, context: Context) -> None:
        stands = f"{mission.status.value} {mission.attempts} {len(mission.trips)}"
        self.diary.append(
            f"{context.now:.6f} {name} {what} {mission.name} {stands} {len(context.results)}"
        )

    def _modifier(self, hook: Hook) -> Callable[..., object]:
        async def waits(mission: AnyMission, context: Context, *, limit: float = 0.0) -> object:
            chance = self._chance(hook.name, mission.name)
            self._note(hook.name, "begins", mission, context)
            if chance.random() < 0.3 and mission.trips:
                within = chance.choice((None, limit, *self.limits))
                await context.trip_ended(mission.current, within=within)
            if chance.random() < 0.6:
                await context.sleep(chance.choice(PAUSES))
            must = bool(hook.emits) and Status.RUNNING not in hook.emits and _flying(mission)
            if must and (Status.FAILED not in hook.emits or chance.random() < 0.7):
                await context.trip_ended(mission.current)
            self._note(hook.name, "goes on", mission, context)
            self._emit(chance, context)
            return self._said(hook, mission, chance)

        def is_quick(mission: AnyMission, context: Context, *, limit: float = 0.0) -> object:
            chance = self._chance(hook.name, mission.name)
            self._note(hook.name, "is quick", mission, context)
            self._emit(chance, context)
            if chance.random() < 0.2:
                context.log(f"{hook.name} says {chance.random():.3f}")
            if chance.random() < 0.2 and len(mission.trips) > 2:
                mission.trips[1:] = mission.trips[:0:-1]
            if hasattr(mission, "notes"):
                mission.notes += 1
            if mission.trips and hasattr(mission.current, "layers"):
                mission.current.layers += 1
            return self._said(hook, mission, chance)

        async def never_waits(
            mission: AnyMission, context: Context, *, limit: float = 0.0
        ) -> object:
            return is_quick(mission, context, limit=limit)

        if not self.patient:
            return never_waits
        return waits if Random(f"{self.seed}/{hook.name}").random() < 0.6 else is_quick

    def _said(self, hook: Hook, mission: AnyMission, chance: Random) -> object:
        """Return a status that fits, as far as there is one; now and then one that does not."""
        if self._tired(mission):
            raise RuntimeError("enough")
        if chance.random() < 0.004:
            raise ActionFailed("what only an action may say")
        if not hook.emits:
            return None if chance.random() < 0.995 else Status.FAILED
        fits = [status for status in hook.emits if _fits(status, mission)]
        if not fits and Status.STANDBY in hook.emits and mission.trips and not _flying(mission):
            mission.current.reset()
            return Status.STANDBY
        wild = not fits or chance.random() < 0.01
        return chance.choice(hook.emits if wild else fits)

    def _evaluator(self, hook: Hook) -> Callable[..., object]:
        def judges(
            mission: AnyMission, results: Results[Any, Any], *, least: int = 0, share: float = 0.0
        ) -> object:
            chance = self._chance(hook.name, mission.name)
            seen = [f"{result.trip.name}/{result.round}/{result.attempt}" for result in results.new]
            self.diary.append(
                f"{self.clock():.6f} {hook.name} {mission.name} {seen} {len(results.all)}"
                f" {least} {share} {_own(mission)} {[_own(one) for one in mission.completed_trips]}"
            )
            often = self.calls[hook.name, mission.name] > 3 or self._tired(mission)
            return Verdict() if often else _verdict(mission, chance)

        async def takes_time(
            mission: AnyMission, results: Results[Any, Any], *, least: int = 0, share: float = 0.0
        ) -> object:
            return judges(mission, results, least=least, share=share)

        plain = self.patient and Random(f"{self.seed}/{hook.name}").random() < 0.5
        return judges if plain else takes_time

    def _creator(self, hook: Hook) -> Callable[..., object]:
        def makes(event: Event, context: EventContext) -> object:
            chance = self._chance(hook.name, "")
            living = context.missions
            self.diary.append(f"{context.now:.6f} {hook.name} {event.id} {len(living)}")
            if len(living) > 1 and chance.random() < 0.1:
                context.cancel(living[-1], "it was one too many")
            if not living or self.calls[hook.name, ""] > MADE or chance.random() < 0.2:
                return None
            like = living[0]
            trips = [*like.trips, *like.completed_trips][:1]
            return _another(like, trips=[_another(one, action="take_photo") for one in trips])

        return makes

    def _policy(self, hook: Hook) -> Callable[..., object]:
        def chooses(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
            chance = self._chance(hook.name, trip.name)
            ids = [drone.id for drone in candidates]
            self.diary.append(f"{self.clock():.6f} {hook.name} {trip.name} {ids}")
            if chance.random() < 0.01:
                raise ValueError("no idea")
            return None if chance.random() < 0.05 else chance.choice(candidates)

        return chooses

    def _emit(self, chance: Random, context: Context) -> None:
        """Raise an event now and then, some of them once only."""
        if self.raises and chance.random() < 0.3:
            once = chance.choice((None, None, "one", "two"))
            of_events: Any = context
            of_events.emit(chance.choice(("smoke", "seen")), id=once)

    def _along(self, name: str) -> Callable[..., object]:
        async def looks(drone: Drone, trip: Trip, context: Context) -> object:
            chance = self._chance(name, trip.name)
            for _look in range(chance.choice((1, 3, 30))):
                self.diary.append(f"{context.now:.6f} {name} {trip.name} {drone.id} looks")
                self._emit(chance, context)
                await context.sleep(chance.choice((0.5, 1.0, 2.0)))
            if chance.random() < 0.2:
                raise ActionFailed("it saw nothing")
            return None

        async def sees_at_once(drone: Drone, trip: Trip, context: Context) -> None:
            self.diary.append(f"{context.now:.6f} {name} {trip.name} {drone.id} looks")

        return looks if self.patient else sees_at_once

    def _action(self, name: str) -> Callable[..., object]:
        def begins(trip: Trip, drone: Drone, context: Context, given: str) -> Random:
            self.diary.append(f"{context.now:.6f} {name} {trip.name} {drone.id} {given}")
            return self._chance(name, trip.name)

        def gives(chance: Random) -> object:
            if chance.random() < 0.15:
                raise ActionFailed("it slipped")
            if chance.random() < 0.02:
                raise KeyError(name)
            return chance.randint(0, 9)

        async def acts(
            drone: Drone, trip: Trip, context: Context, *, dose: float = 0.0, how: str = ""
        ) -> object:
            chance = begins(trip, drone, context, f"{dose:g}{how}")
            if chance.random() < 0.6:  # at the very instant of a limit, perhaps
                over = await context.trip_ended(trip, within=chance.choice(self.limits))
                self.diary.append(f"{context.now:.6f} {name} {trip.name} is over: {over}")
            else:
                await context.sleep(chance.choice(PAUSES))
            self.diary.append(f"{context.now:.6f} {name} {trip.name} is done")
            self._emit(chance, context)
            return gives(chance)

        async def never_waits(
            drone: Drone, trip: Trip, context: Context, *, dose: float = 0.0, how: str = ""
        ) -> object:
            return gives(begins(trip, drone, context, f"{dose:g}{how}"))

        return acts if self.patient else never_waits


def _another(like: Any, **given: object) -> Any:
    """Return a new mission or trip with what one must have."""
    names = ("target", "owner", "gentle", "name")
    known = {name: getattr(like, name) for name in names if hasattr(like, name)}
    return type(like)(**{**known, **given})


def _flying(mission: AnyMission) -> bool:
    return bool(mission.trips) and mission.current.status is TripStatus.EXECUTING


def _fits(status: Status, mission: AnyMission) -> bool:
    """Return whether a mission can go on so, as `language.md` has it."""
    if status is Status.FAILED:
        return True
    if status is Status.RUNNING or _flying(mission):
        return status is Status.RUNNING and _flying(mission)
    if status is Status.COMPLETED:
        return not mission.trips
    waits = bool(mission.trips) and mission.current.status is TripStatus.WAITING
    return waits and (status is Status.STANDBY or not mission.attempts)


def _own(of: object) -> list[object]:
    """Return what an app's own fields hold (graphs.py)."""
    names = ("owner", "notes", "layers", "gentle", "remark", "share")
    return [getattr(of, name) for name in names if hasattr(of, name)]


def _verdict(mission: AnyMission, chance: Random) -> object:
    drawn = chance.random()
    done = mission.completed_trips
    if drawn < 0.3 and done:
        return Verdict(redo=tuple(chance.sample(done, chance.randint(1, len(done)))))
    if drawn < 0.45 and done:
        new = type(done[0])(name="more", action="take_photo", target=chance.choice(done).target)
        return Verdict(ok=False, add=(new,), log=("one more",))
    if drawn < 0.55:
        return Verdict(ok=False, fail=chance.choice((None, "not good enough")))
    return Verdict(log=("well done",)) if drawn < 0.97 else None
