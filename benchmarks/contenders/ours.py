"""Ours: the package that plutoc makes of `flow/app.pluto`, as it is, with the runtime it carries.

It does all that it does for its users: results and reasons are recorded, batteries and capabilities
looked at, `async def` hooks called. Only the drones are made up, by the drivers of `flights.py`.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
from collections.abc import Callable
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any

from .flights import HOME, AllTogether, Flights, FromTheLoop, Hear, ThroughTheKernel
from .process import Ask, Notes, parser, report
from .work import Done, Work

if TYPE_CHECKING:
    from pluto_fleet.shared.brain import Brain
    from pluto_fleet.shared.domain.trace import Event

TARGET = (1.0, 1.0, 1.2)
"""Where all trips go: straight up from home."""
AN_HOUR = 3600.0
"""On a slow machine it may take long until all are in the air, and none may be given up before."""


def load() -> None:
    """Import all that flies, as every contender has when its clock starts."""
    for name in (
        "measured.flow",
        "measured._runtime.brain",
        "measured._runtime.domain.airspace",
        "pluto_fleet.journal.event_line",
        "pluto_fleet.process.hook_runner",
    ):
        import_module(name)


class Journal:
    """Each transition as a line of JSON; kept, but not written to a disk."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._line: Callable[[Event], str] = import_module("pluto_fleet.journal.event_line").line

    def note(self, event: Event) -> None:
        """Format an event."""
        self.lines.append(self._line(event))


class Listener:
    """Counts the events that it hears."""

    def __init__(self) -> None:
        self.heard = 0

    def hear(self, event: Event) -> None:
        """Count it."""
        self.heard += 1


def missions(work: Work, safe_time: float | None) -> list[dict[str, Any]]:
    """Return the plan; flights may take 30 s, as the app has it, or what the missions say."""
    fields = {} if safe_time is None else {"safe_time": safe_time}
    trips = [
        {"name": str(number), "action": "take_photo", "target": TARGET}
        for number in range(work.trips)
    ]
    return [
        {"name": str(number), "fields": fields, "trips": trips} for number in range(work.missions)
    ]


def brain(work: Work, flights: Flights, hooks: Any) -> Brain:
    """Return the app's brain, which says what has happened if anybody wants to hear it."""
    app = import_module("measured.flow").APP
    made: Brain = import_module("measured._runtime.brain").Brain(
        app,
        {
            "drones": [{"id": str(number), "home": HOME} for number in range(work.drones)],
            "after_trip": "home",
            "silent": flights.hear is None,
        },
        space=import_module("measured._runtime.domain.airspace").Airspace(),
        hooks=hooks,
    )
    return made


def told(brain: Brain) -> Done:
    """Return what came of the missions."""
    missions = brain.standing()["missions"].values()
    completed = sum(len(mission["done"]) for mission in missions)
    return Done(
        missions=sum(mission["status"] == "COMPLETED" for mission in missions),
        completed=completed,
        failed=sum(mission["attempts"] for mission in missions) - completed,
    )


def listener(given: argparse.Namespace) -> Hear:
    """Return what hears of every transition."""
    if not given.journal:
        return None
    journal, second = Journal(), Listener()

    def hear(event: Event) -> None:
        journal.note(event)
        second.hear(event)

    return hear


async def in_real_time(given: argparse.Namespace, work: Work, notes: Notes) -> Ask:
    """Fly on asyncio."""
    flights = (AllTogether if given.together else FromTheLoop)(listener(given), work, notes)
    hooks = import_module("pluto_fleet.process.hook_runner").RealHooks(flights)
    flights.brain = brain(work, flights, hooks)
    hooks.ended = lambda number: flights.tell({"hook": number})
    await flights.run(missions(work, AN_HOUR if given.together else None), work.drones)
    return partial(told, flights.brain)


def in_virtual_time(given: argparse.Namespace, work: Work) -> Ask:
    """Fly in a simulation."""
    flights = ThroughTheKernel(listener(given))
    flights.brain = brain(work, flights, None)
    flights.run(missions(work, AN_HOUR if given.together else None), work.drones)
    return partial(told, flights.brain)


def main() -> None:
    """Measure what was asked for."""
    arguments = parser()
    arguments.add_argument("--package", required=True, help="where `measured` is imported from")
    arguments.add_argument("--virtual", action="store_true")
    arguments.add_argument("--journal", action="store_true", help="format each transition")
    arguments.add_argument("--together", action="store_true", help="all are in flight at once")
    given = arguments.parse_args()
    if given.together and given.drones < given.missions:
        arguments.error("--together needs a drone for each mission")
    sys.path.insert(0, given.package)
    load()

    def fly(work: Work, notes: Notes) -> Ask:
        if given.virtual:
            return in_virtual_time(given, work)
        return asyncio.run(in_real_time(given, work, notes))

    report(fly, given)


if __name__ == "__main__":
    main()
