"""What `fly` and `resume` share: one life after another, until all is over or somebody stops it."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import in_shell, place

from ..drones.real_fleet import real_fleet
from ..flight.config import End, Lived, Setting, Stops
from ..flight.fly import Recovered, live
from ..gateway.settings import settings_for
from ..gateway.starting import connect
from ..journal.place import commands_note, gateway_folder
from ..journal.store import Store
from ..process import respawn as again
from . import leaving, stop_mark
from .events import line_of
from .flown import finished, has_ended, records_in, report_of, waiting_lines
from .interrupts import Interrupts
from .supervise import STOPS, Supervised, supervise

if TYPE_CHECKING:
    from plutoc_runtime.alone.faults import Faults
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission
    from plutoc_runtime.domain.trace import Event

    from ..drones.real_fleet import RealFleet
    from ..files.fleet import FleetFile
    from ..flight.live_flight import OneLife
    from ..journal.fold import Records
    from .options import Options

STOPPED = 130
"""The exit code after `tell J stop`, as after Ctrl-C."""

MOST_GATEWAYS = 5
"""How many may die in a row with nothing finished in between."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flight:
    """A journal, and all that is needed to go on with it."""

    app: App
    journal: Path
    missions: Sequence[Mission[Any]]
    fleet: FleetFile
    speed: float
    seed: int
    faults: Faults
    sim: bool = True
    """Whether the drones are simulated ones; real ones are moved by this."""
    crtp: bool = False
    """Whether simulated Crazyflies stand in for real ones, down to their radio."""

    @property
    def how_to_go_on(self) -> str:
        """A sentence for whoever has stopped it."""
        return how_to_go_on(self.app, self.journal)


def how_to_go_on(app: App, journal: Path) -> str:
    """Return a sentence for whoever has stopped an app, with what can be typed."""
    return f"to go on: {app.name} resume {in_shell(journal)}"


def see_through(flight: Flight, store: Store, known: Recovered | None = None) -> int:
    """Fly until all is over or somebody stops it; say what came of it, and return the exit code.

    `known` is what the journal says, if it has been read already.
    """
    stops = Stops()
    interrupts = Interrupts(stops, lambda: flight.journal, flight.how_to_go_on)
    with interrupts.listening():
        lived = leaving.run(_heard(flight, store, stops, interrupts, known))
    if lived.end is End.STOPPED:
        who = "all other drones" if aloft(flight, lived.drones) else "all drones"
        output.tell(f"{who} are down; {flight.how_to_go_on}")
        return interrupts.code or STOPPED
    output.line()
    return reported(flight.app, flight.journal, lived.records, lived.drones)


def aloft(flight: Flight, drones: Iterable[Drone]) -> list[Drone]:
    """Return the real drones that were last heard of in the air, though all were to be down."""
    return [] if flight.sim else [drone for drone in drones if not drone.telemetry.landed]


def may_hover(drones: Iterable[Drone]) -> str:
    """Return what to tell people of those."""
    places = ", ".join(f"{drone.id} (last heard of at {place(drone.location)})" for drone in drones)
    return (
        f"no word of a landing from {places}: what may still hover, nobody should stand under;"
        " the gateway lands whichever answers within two minutes"
    )


def reported(app: App, journal: Path, records: Records, drones: Sequence[Drone] = ()) -> int:
    """Say what came of a flight, and return the exit code for that."""
    code, lines = report_of(app, journal, records, drones)
    for line in [*lines, *waiting_lines(app, journal, records)]:
        output.line(line)
    return code


async def _heard(
    flight: Flight,
    store: Store,
    stops: Stops,
    interrupts: Interrupts,
    known: Recovered | None,
) -> Lived:
    """Live, and hear whoever wants it to end."""
    interrupts.loop = asyncio.get_running_loop()
    return await lives(flight, store, stops, known, Watcher(tell=tell, say=output.tell))


@dataclass(frozen=True, slots=True, kw_only=True)
class Watcher:
    """Whoever watches a flight."""

    tell: Callable[[Event], object]
    """Told of each event, once it is on record."""
    say: Callable[[str], object]
    """Told what is no event of the flight: a gateway has died."""
    born: Callable[[OneLife], object] | None = None
    """Told of each life when it begins."""
    patient: bool = False
    """Whether somebody is there who can decide what missions ask."""


async def lives(
    flight: Flight, store: Store, stops: Stops, known: Recovered | None, watcher: Watcher
) -> Lived:
    """Live once more each time that the gateway dies; `known` is what the journal says."""
    folder = gateway_folder(flight.journal)
    settings = settings_for(
        flight.app,
        flight.fleet,
        seed=flight.seed,
        faults=flight.faults,
        real=None if flight.sim else await _real(flight, folder, known),
        speed=flight.speed,
    )
    setting = Setting(
        app=flight.app,
        missions=flight.missions,
        fleet=flight.fleet,
        connect=lambda kernel, epoch, lost: connect(folder, settings, kernel, epoch, lost),
        note=commands_note(flight.journal),
        tell=watcher.tell,
        speed=flight.speed,
        sim=flight.sim,
        patient=watcher.patient,
    )
    deaths, done = 0, -1
    while True:
        stops.asked = stops.asked or stop_mark.found(flight.journal)
        with closing(store):
            lived = await live(setting, store, stops, known, watcher.born)
        known = None
        if lived.end is not End.LOST:
            if unheard := aloft(flight, lived.drones):
                watcher.say(may_hover(unheard))
            return lived
        before, done = done, finished(lived.records)
        deaths = 1 if done > before else deaths + 1
        if deaths > MOST_GATEWAYS:
            raise BadInput(
                f"{flight.journal}: the gateway ended {deaths} times in a row with nothing finished"
                f" in between; what it said is in {folder / 'log'}; {flight.how_to_go_on}"
            )
        watcher.say(
            "the gateway has ended, or cut this app off: it is reached anew, and all drones are asked"
        )
        store = Store.open(flight.journal)


async def _real(flight: Flight, folder: Path, known: Recovered | None) -> RealFleet:
    """Return how the drones are flown; simulated Crazyflies are there when this returns."""
    records = () if known is None else known.records.missions.values()
    real = real_fleet(flight.fleet, flight.missions, records=records)
    if not flight.crtp:
        return real
    from ..crtp.equipment import fitted
    from ..crtp.process import start, told  # few want them

    homes = {drone.id: drone.home for drone in flight.fleet.drones}
    uris = await asyncio.to_thread(start, folder, homes)
    camera = await asyncio.to_thread(told, folder, "camera")
    drones = (
        replace(drone, uri=uris[drone.id], options=fitted(drone.options, camera))
        for drone in real.drones
    )
    return replace(real, drones=tuple(drones))


def supervised(app: App, options: Options, journal: Path, first: Sequence[str] | None) -> int:
    """Let another process fly, and start it again when it crashes; `first`: it has not begun."""
    speed = ["--speed", str(options.speed)] if options.speed else []
    on = again.command("resume", str(journal), *speed, "--supervised")
    return supervise(
        Supervised(
            name=app.name,
            first=on if first is None else again.command(*first, *speed, "--supervised"),
            again=lambda: on if journal.exists() else None,
            finished=lambda: finished(records_in(app, journal)) if journal.exists() else 0,
            over=partial(_is_over, app, journal),
            how_to_go_on=how_to_go_on(app, journal),
        )
    )


def _is_over(app: App, journal: Path, code: int) -> bool:
    """Say whether a flight has ended as this exit code says; the journal knows."""
    if not journal.exists():
        return code in STOPS  # before anything was flown
    if code in STOPS and stop_mark.found(Path(os.path.realpath(journal))):
        return True
    records = records_in(app, journal)
    if has_ended(records):
        return code in STOPS or code == report_of(app, journal, records)[0]
    return code in STOPS and records.stopped


def tell(event: Event) -> None:
    """Show an event to whoever watches."""
    line = line_of(event)
    if line is not None:
        with suppress(output.ClosedPipe, output.CannotWrite):  # whoever watches has gone: fly on
            output.line(line)
            output.flush()
