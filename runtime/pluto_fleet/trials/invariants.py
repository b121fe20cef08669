"""The invariants of every run of every app with any faults, checked on its events.

The rules are independent of the runtime's implementation. They process one event after the other (see
`trace.py`), so a run may be of any length, and they cost little. A journal may hold several runs of an app
that was stopped or crashed and resumed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.model import Mission
from ..shared.domain.trace import Event
from .drone_rules import Items, ItemsStayAboard, ServesOneMission, StaysDown
from .rules import (
    OVER,
    AttemptsCountUp,
    CompletedDidEverything,
    EndsOnce,
    EventsHappenOnce,
    Hears,
    LimitsAreKept,
    NothingAfterTheEnd,
    Rule,
    Say,
    TripsDoNotOverlap,
    at,
)
from .time_rules import DelaysAreWaited, PromisesAreKept

RULES: tuple[Callable[[Say], Rule], ...] = (
    EndsOnce,
    NothingAfterTheEnd,
    TripsDoNotOverlap,
    AttemptsCountUp,
    DelaysAreWaited,
    PromisesAreKept,
    LimitsAreKept,
    CompletedDidEverything,
    EventsHappenOnce,
    ServesOneMission,
    StaysDown,
)
"""The rules that need only the events."""


class Invariants:
    """Checks all rules: call `take` with every event, and `over` at the end."""

    def __init__(self, items: Items, rules: Sequence[Callable[[Say], Rule]] | None = None) -> None:
        self.found: list[str] = []
        """A sentence for each violation so far."""
        chosen: Sequence[Callable[[Say], Rule]]
        chosen = (*RULES, partial(ItemsStayAboard, items)) if rules is None else rules
        self._hears = _Hears([rule(self.found.append) for rule in chosen])
        self._now = 0.0

    def take(self, event: Event) -> None:
        """Process an event."""
        now = event["t"]
        if now < self._now:
            self.found.append(f"{at(event)}: {event['event']} comes after {self._now:g} s")
        self._now = now
        for hear in self._hears[event["event"]]:
            hear(event)

    def over(self) -> list[str]:
        """Return all violations of the run, also by what should have happened."""
        for hear in self._hears[OVER]:
            hear({"t": self._now, "event": OVER})
        return self.found


class _Hears(dict[object, tuple[Hears, ...]]):
    """The rules for each kind of event, by its full name or its family."""

    def __init__(self, rules: Sequence[Rule]) -> None:
        super().__init__()
        self._rules = rules

    def __missing__(self, kind: object) -> tuple[Hears, ...]:
        family = str(kind).partition(".")[0]
        asked = (rule.hears.get(str(kind), rule.hears.get(family)) for rule in self._rules)
        found = self[kind] = tuple(hear for hear in asked if hear is not None)
        return found


def violations(trace: Iterable[Event], items: Items) -> list[str]:
    """Return all violations of a complete run."""
    invariants = Invariants(items)
    for event in trace:
        invariants.take(event)
    return invariants.over()


def items_of(missions: Iterable[Mission[Any]]) -> Items:
    """Return the trips of a plan that pick items, with the trips that release them."""
    items: dict[str, dict[str, str]] = {}
    for mission in missions:
        picked = ""
        for trip in mission.trips:
            if trip.action == PICK:
                picked = trip.name
            elif trip.action == RELEASE:
                items.setdefault(mission.name, {})[picked] = trip.name
    return items
