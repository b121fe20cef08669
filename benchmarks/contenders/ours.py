"""Ours: the package that plutoc makes of `flow/app.pluto`, as it is, with the runtime it carries.

It does all that it does for its users: results and reasons are recorded, batteries and capabilities
looked at, `async def` hooks called. Only the drones are made up, by the navigations of `flights.py`.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

from .flights import HOME, AllTogether, FromTheLoop, Still, ThroughTheKernel
from .process import Notes, parser, report
from .work import Done, Work

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.domain.trace import Event
    from plutoc_runtime.time.kernel import Kernel, Task

TARGET = (1.0, 1.0, 1.2)
"""Where all trips go: straight up from home."""
AN_HOUR = 3600.0
"""On a slow machine it may take long until all are in the air, and none may be given up before."""


def runtime(name: str) -> Any:
    """Return a module of the runtime, or of the library that was given it."""
    return import_module(name)


def load() -> None:
    """Import all that flies, as every contender has when its clock starts."""
    from pluto_fleet.scaffolding import bind  # before anything of the runtime is imported

    bind("measured._runtime")
    import_module("measured.flow")
    for name in (
        "plutoc_runtime.domain.airspace",
        "plutoc_runtime.domain.errors",
        "pluto_fleet.files.fleet",
        "pluto_fleet.journal.event_line",
        "plutoc_runtime.time.kernel",
        "pluto_fleet.process.realtime",
        "plutoc_runtime.flow.engine",
        "plutoc_runtime.time.virtual",
    ):
        runtime(name)


class Journal:
    """Each transition as a line of JSON; kept, but not written to a disk."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._line: Callable[[Event], str] = runtime("pluto_fleet.journal.event_line").line

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


def missions(work: Work, safe_time: float | None) -> list[Mission[Any]]:
    """Return the plan; flights may take 30 s, as the app has it, or what the missions say."""
    model = import_module("measured.model")
    names = [str(number) for number in range(work.trips)]
    return [
        model.Mission(
            name=str(number),
            index=number,
            safe_time=safe_time,
            trips=[
                model.Trip(name=name, action="take_photo", target=TARGET, index=index)
                for index, name in enumerate(names)
            ],
        )
        for number in range(work.missions)
    ]


def started(
    given: argparse.Namespace, work: Work, kernel: Kernel, navigation: Still
) -> tuple[list[Mission[Any]], Task[float]]:
    """Set the missions on their way; the task is done when the last of them is over."""
    app, files = import_module("measured.flow").APP, runtime("pluto_fleet.files.fleet")
    category = app.categories[0].name
    fleet = files.FleetFile(
        airspace=runtime("plutoc_runtime.domain.airspace").Airspace(),
        drones=tuple(
            files.DroneEntry(id=str(number), category=category, home=HOME)
            for number in range(work.drones)
        ),
    )
    session = runtime("plutoc_runtime.flow.engine").Session(
        app, fleet, kernel, navigation, listeners(given)
    )
    plan = missions(work, AN_HOUR if given.together else None)
    return plan, session.start(plan)


def told(plan: Sequence[Mission[Any]]) -> Done:
    """Return what came of the missions."""
    completed = sum(len(mission.completed_trips) for mission in plan)
    return Done(
        missions=sum(mission.status.value == "COMPLETED" for mission in plan),
        completed=completed,
        failed=sum(mission.attempts for mission in plan) - completed,
    )


def crash() -> Exception:
    """Return what is reported of a flight that failed."""
    errors = runtime("plutoc_runtime.domain.errors")
    failed: Exception = errors.FlightFailed(errors.Failure.CRASH, "the hash says so")
    return failed


def listeners(given: argparse.Namespace) -> list[Callable[[Event], object]]:
    """Return who hears of every transition."""
    return [Journal().note, Listener().hear] if given.journal else []


async def in_real_time(given: argparse.Namespace, work: Work, notes: Notes) -> Done:
    """Fly on asyncio."""
    kernel = runtime("pluto_fleet.process.realtime").RealTime()
    flights = AllTogether if given.together else FromTheLoop
    plan, over = started(given, work, kernel, flights(crash(), kernel, work, notes))
    await kernel.run(over)
    return told(plan)


def in_virtual_time(given: argparse.Namespace, work: Work) -> Done:
    """Fly in a simulation."""
    kernel = runtime("plutoc_runtime.time.virtual").VirtualTime()
    events = runtime("plutoc_runtime.time.kernel")
    navigation = ThroughTheKernel(crash(), kernel, events.EventKind.FLIGHT, events.mission_key)
    plan, over = started(given, work, kernel, navigation)
    kernel.run(over)
    return told(plan)


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

    def fly(work: Work, notes: Notes) -> Done:
        if given.virtual:
            return in_virtual_time(given, work)
        return asyncio.run(in_real_time(given, work, notes))

    report(fly, given)


if __name__ == "__main__":
    main()
