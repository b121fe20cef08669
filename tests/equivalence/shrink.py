"""Makes what shows a difference smaller, as long as it shows one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TypeVar

from pluto_fleet.shared.alone.faults import Faults
from pluto_fleet.shared.domain.model import AfterTrip
from tests.equivalence.campaign import Finding
from tests.equivalence.worlds import MissionPlan, World

TRIES = 600

T = TypeVar("T")


Differs = Callable[[str, World], str | None]
"""Gives the first difference of a source in a world, if there is one."""


def shrunk(finding: Finding, differs: Differs) -> Finding:
    """Return a smaller source and world that leave two traces all the same."""
    tries, again = TRIES, finding.world is not None
    while again:
        again = False
        for text, world in _smaller(finding.text, finding.world):
            tries -= 1
            if tries < 0:
                return finding
            said = _said(text, world, differs)
            if said is not None:
                finding = replace(finding, text=text, world=world, said=said)
                again = True
                break
    return finding


def _said(text: str, world: World, differs: Differs) -> str | None:
    try:
        return differs(text, world)
    except (TypeError, KeyError, AttributeError):  # the world speaks of what the app has no more
        return None


def _smaller(text: str, world: World | None) -> Iterator[tuple[str, World]]:
    if world is None:
        return
    yield from ((text, each) for each in _worlds(world))
    yield from ((each, world) for each in _texts(text))


def _worlds(world: World) -> Iterator[World]:
    for number in range(len(world.missions)):
        if len(world.missions) > 1:
            yield replace(world, missions=_without(world.missions, number))
    if len(world.homes) > 1:
        yield replace(world, homes=world.homes[:-1])
    if world.faults != Faults():
        yield replace(world, faults=Faults())
    if world.max_airborne is not None:
        yield replace(world, max_airborne=None)
    if world.after_trip is not AfterTrip.HOME:
        yield replace(world, after_trip=AfterTrip.HOME)
    for number, mission in enumerate(world.missions):
        for smaller in _missions(mission):
            missions = (*world.missions[:number], smaller, *world.missions[number + 1 :])
            yield replace(world, missions=missions)


def _missions(mission: MissionPlan) -> Iterator[MissionPlan]:
    for name in mission.fields:
        yield replace(mission, fields={n: v for n, v in mission.fields.items() if n != name})
    for place, trip in enumerate(mission.trips):
        if len(mission.trips) > 1:
            yield replace(mission, trips=_without(mission.trips, place))
        for name in trip.fields:
            left = replace(trip, fields={n: v for n, v in trip.fields.items() if n != name})
            trips = (*mission.trips[:place], left, *mission.trips[place + 1 :])
            yield replace(mission, trips=trips)


def _texts(text: str) -> Iterator[str]:
    lines = text.splitlines()
    inner = range(2, len(lines) - 1)
    for number in inner:
        name = re.match(r"  (\w+) = ", lines[number])
        if name is not None:
            yield from _without_block(lines, name[1])
        elif "->" in lines[number] or lines[number].split()[0] in _WORDS:
            yield "\n".join(_without(tuple(lines), number)) + "\n"


_WORDS = ("category", "action", "evaluator", "modifier", "policy", "mission", "trip")


def _without_block(lines: list[str], name: str) -> Iterator[str]:
    """Take a block out: with all its arrows, or by leading on what led to it."""
    mention = re.compile(rf"\b{name}\b")
    yield "\n".join(line for line in lines if not mention.search(line)) + "\n"
    targets = [
        line.split(" -> ")[1].split()[0] for line in lines if line.startswith(f"  {name} -> ")
    ]
    for target in dict.fromkeys(targets):
        if target[0] != "[" and target != name:
            kept = [line for line in lines if not re.match(rf"  {name} (=|->) ", line)]
            yield "\n".join(mention.sub(target, line) for line in kept) + "\n"


def _without(values: tuple[T, ...], number: int) -> tuple[T, ...]:
    return (*values[:number], *values[number + 1 :])
