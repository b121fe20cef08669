"""What must be true of every run of every app with any faults: read off its events.

The rules know nothing of how the runtime works inside. They are told one event after the other (see
`trace.py`), so a run may be as long as it likes, and they cost little beside it. A run may have
several lives: an app that was stopped or that crashed goes on, and its events with it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import PICK, RELEASE

from .delay_rule import DelaysAreWaited
from .drone_rules import ItemsStayAboard, ServesOneMission, StaysDown
from .rules import (
    ENDS,
    OVER,
    AttemptsCountUp,
    CompletedDidEverything,
    EndsOnce,
    Hears,
    LimitsAreKept,
    NothingAfterTheEnd,
    Say,
    TripsDoNotOverlap,
    at,
)

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.domain.trace import Event

    from .rules import Rule

__all__ = ["ENDS", "RULES", "Invariants", "Items", "items_of", "violations"]

Items = Mapping[str, Mapping[str, str]]
"""By mission: the trips that pick an item, each with the trip that releases it."""

RULES: tuple[Callable[[Say], Rule], ...] = (
    EndsOnce,
    NothingAfterTheEnd,
    TripsDoNotOverlap,
    AttemptsCountUp,
    DelaysAreWaited,
    LimitsAreKept,
    CompletedDidEverything,
    ServesOneMission,
    StaysDown,
)
"""Those that need the events alone."""


class Invariants:
    """The rules of one run. Tell `take` every event, and `over` at the end."""

    def __init__(self, items: Items, rules: Sequence[Callable[[Say], Rule]] | None = None) -> None:
        self.found: list[str] = []
        """A sentence for each violation so far."""
        chosen: Sequence[Callable[[Say], Rule]]
        chosen = (*RULES, partial(ItemsStayAboard, items)) if rules is None else rules
        self._hears = _Hears([rule(self.found.append) for rule in chosen])
        self._now = 0.0

    def take(self, event: Event) -> None:
        """Something happened."""
        now: Any = event["t"]
        if now < self._now:
            self.found.append(f"{at(event)}: {event['event']} comes after {self._now:g} s")
        self._now = now
        for hear in self._hears[event["event"]]:
            hear(event)

    def over(self) -> list[str]:
        """Return what is wrong with the whole run, with what should have happened and has not."""
        for hear in self._hears[OVER]:
            hear({"t": self._now, "event": OVER})
        return self.found


class _Hears(dict[object, tuple[Hears, ...]]):
    """Who hears of each kind of event: by its name, else by what stands before the dot."""

    def __init__(self, rules: Sequence[Rule]) -> None:
        super().__init__()
        self._rules = rules

    def __missing__(self, kind: object) -> tuple[Hears, ...]:
        family = str(kind).partition(".")[0]
        asked = (rule.hears.get(str(kind), rule.hears.get(family)) for rule in self._rules)
        found = self[kind] = tuple(hear for hear in asked if hear is not None)
        return found


def violations(trace: Iterable[Event], items: Items) -> list[str]:
    """Return what is wrong with a whole run, from the first mission's creation to the last's end."""
    invariants = Invariants(items)
    for event in trace:
        invariants.take(event)
    return invariants.over()


def items_of(missions: Iterable[Mission[Any]]) -> Items:
    """Return which trips of a plan pick items, and which release them."""
    items: dict[str, dict[str, str]] = {}
    for mission in missions:
        picked = ""
        for trip in mission.trips:
            if trip.action == PICK:
                picked = trip.name
            elif trip.action == RELEASE:
                items.setdefault(mission.name, {})[picked] = trip.name
    return items
