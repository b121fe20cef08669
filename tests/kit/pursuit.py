"""The example `pursue` with other fleets and other people, and what its rule of release says of a flight."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from random import Random

from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.events.world import Mover

CORNERS = 6
"""Of a person's path."""
PACES = 0.1, 0.3
"""Metres a second: at most about two thirds of what a drone flies in the mean."""
COMES = 5.0, 60.0
"""Seconds within which people come."""
EDGE = 0.5
"""Metres from the walls that nobody walks on."""


def peopled(
    fleet: FleetFile,
    drones: int,
    people: int,
    seed: int,
    paces: tuple[float, float] = PACES,
) -> FleetFile:
    """Return a fleet file with so many drones, side by side, and people, on paths drawn from a seed."""
    width, depth = fleet.airspace.size
    between = width / (drones + 1)
    first = fleet.drones[0]
    homes = [(round(n * between, 2), *first.home[1:]) for n in range(1, drones + 1)]
    chance = Random(f"pursuit/{people}/{seed}")
    movers = tuple(_person(f"t{n}", chance, width, depth, paces) for n in range(1, people + 1))
    return replace(
        fleet,
        drones=tuple(replace(first, id=f"cf{n}", home=home) for n, home in enumerate(homes, 1)),
        world=replace(fleet.world or WorldData(), movers=movers),
    )


def _person(
    name: str, chance: Random, width: float, depth: float, paces: tuple[float, float]
) -> Mover:
    corners = [
        (chance.uniform(EDGE, width - EDGE), chance.uniform(EDGE, depth - EDGE))
        for _ in range(CORNERS)
    ]
    return Mover(
        name=name,
        kind="person",
        path=tuple(corners),
        speed=chance.uniform(*paces),
        starts=chance.uniform(*COMES),
        repeat=True,
    )


def releases(trace: Iterable[Event]) -> tuple[int, list[str]]:
    """Return how many that were stayed with were let go, and what was against the rule.

    Whoever is stayed with when a bound is broken is let go at that instant, and nobody at another.
    """
    staying: dict[str, None] = {}
    due: dict[str, None] = {}
    broken = -1.0
    released = 0
    wrong = list[str]()
    for entry in trace:
        if due and entry["t"] > broken:
            wrong += [f"{name} was kept at {broken:.1f} s" for name in due]
            due = {}
        match entry:
            case {"event": "event.raised", "kind": "late", "t": broken}:
                due = {**due, **staying}
            case {"event": "trip.launched", "mission": name} if name.startswith("stay with"):
                staying[name] = None
            case {"event": "log", "mission": name, "text": text} if text.startswith("let go"):
                released += 1
                due.pop(name, None)
                if entry["t"] != broken:
                    wrong.append(f"{name} was let go at {entry['t']:.1f} s")
            case {"event": "trip.completed" | "trip.failed", "mission": name}:
                staying.pop(name, None)
                due.pop(name, None)
            case {"event": "trip.interrupted", "mission": name}:
                staying.pop(name, None)
    return released, wrong
