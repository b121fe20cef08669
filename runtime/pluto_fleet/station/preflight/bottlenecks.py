"""What holds a plan up, in words, by the waits of its median run."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

from ...shared.domain.actions import PICK
from ...shared.domain.text import counted, duration, mass, percent
from ...shared.fleet.reach import docked
from ..charging import ready_in
from ..words import words

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..wire import Words
    from .question import Question
    from .rehearsal import Waits

NOTABLE = 0.1
"""The share of a run in which a mission must wait for something, for that to be said."""

FEW = 0.5
"""The share of the fleet up to which its able drones are few."""


def bottlenecks(question: Question, waits: Waits) -> list[Words]:
    """Return what holds the plan up, the most important first."""
    return [
        *_low(question, waits),
        *_few(question, waits),
        *_charging(question, waits),
        *_busy(question, waits),
        *_room(question, waits),
    ]


def _low(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait at first, as batteries are too low."""
    if waits.first is None or not waits.first[0]:
        return
    number, low = waits.first
    short = [one for one in question.present if one.id in low]
    if not short:
        return
    level = max(low.values())
    kinds = {category.name: category for category in question.app.categories}
    entries = {one.id: one for one in question.fleet.drones}
    every = [
        ready_in(
            kinds[entries[one.id].category],
            one.battery,
            low[one.id],
            docked=docked(one.at, entries[one.id].home),
        )
        for one in short
    ]
    soonest = min((seconds for seconds in every if seconds is not None), default=None)
    first = "" if soonest is None else f", the first is ready in about {duration(soonest)}"
    are = "is" if len(short) == 1 else "are"
    text = f"{_wait(number)}: {counted(len(short), 'drone')} {are} below {percent(level)}{first}"
    facts = {} if soonest is None else {"ready_in": soonest}
    yield words("preflight.low", text, missions=number, drones=len(short), level=level, **facts)


def _few(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait for the few drones that can do what they need."""
    found: dict[tuple[tuple[str, ...], str], list[float]] = defaultdict(list)
    names = {**waits.busy, **waits.low}
    both = {name: waits.busy.get(name, 0.0) + waits.low.get(name, 0.0) for name in names}
    for name in _notable(waits, both):
        able = waits.few.get(name)
        if able and len(able) <= FEW * len(question.flown.drones):
            action, kilograms = waits.lacks[name]
            found[able, action].append(kilograms)
    for (able, action), masses in found.items():
        number, kilograms = len(masses), min(masses)
        does = f"lift {mass(kilograms)}" if action == PICK else f"do {action}"
        who = "the one drone" if len(able) == 1 else f"the {len(able)} drones"
        wait = "waits" if number == 1 else "wait"
        of = counted(len(question.all), "mission")
        text = f"{number} of {of} {wait} for {who} that can {does}"
        yield words(
            "preflight.few-lift" if action == PICK else "preflight.few",
            text,
            missions=number,
            of=len(question.all),
            drones=list(able),
            action=action,
            mass=kilograms,
        )


def _charging(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait for batteries later on."""
    late = _notable(waits, waits.low)
    if late:
        mean = sum(waits.low[name] for name in late) / len(late)
        text = f"{_wait(len(late))} for batteries to be charged, {duration(mean)} on average"
        yield words("preflight.charging", text, missions=len(late), seconds=mean)


def _busy(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait, as all drones that could fly them do."""
    busy = [name for name in _notable(waits, waits.busy) if name not in waits.few]
    if busy:
        mean = sum(waits.busy[name] for name in busy) / len(busy)
        number = len(question.flown.drones)
        who = "the one drone is" if number == 1 else f"all {number} drones are"
        text = f"{_wait(len(busy))} {duration(mean)} on average: {who} busy then"
        yield words("preflight.busy", text, missions=len(busy), seconds=mean, drones=number)


def _room(question: Question, waits: Waits) -> Iterator[Words]:
    """Yield that missions wait, as no more drones may be in the air."""
    most = question.fleet.max_airborne
    held = _notable(waits, waits.room)
    if held and most is not None:
        text = f"{_wait(len(held))}, as no more than {counted(most, 'drone')} may fly at once"
        yield words("preflight.room", text, missions=len(held), drones=most)


def _notable(waits: Waits, seconds: Mapping[str, float]) -> list[str]:
    return [name for name, waited in seconds.items() if waited >= NOTABLE * waits.seconds > 0.0]


def _wait(missions: int) -> str:
    return f"{counted(missions, 'mission')} {'waits' if missions == 1 else 'wait'}"
