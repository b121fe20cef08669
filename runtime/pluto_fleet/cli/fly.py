"""`fly` and `resume`: missions in real time, until all have ended or the user stops them."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.stand_ins import stand_ins_in
from ..flight.config import End, FlightResult, FlightSetup, Stops, how_to_go_on
from ..flight.live_flight import FlightObserver
from ..flight.lives import (
    Resumable,
    aloft,
    flight_of,
    reopen,
    run_flight,
)
from ..flight.mission_status import finished, has_ended, records_in
from ..flight.offline import clear_stop, pending_stop
from ..journal import place
from ..journal.errors import exists
from ..journal.header import fingerprint, header
from ..journal.store import Store
from ..process import respawn as again
from ..report.report import report_of, waiting_lines
from ..report.sentences import line_of
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import printable
from ..station.sight import noting
from .interrupts import Interrupts
from .plans import load
from .preflight import check_flight, check_real
from .shutdown import run as run_until_complete
from .supervise import STOPS, Supervised, supervise

if TYPE_CHECKING:
    from ..app import App
    from ..journal.standing import Standing
    from ..shared.domain.model import Drone
    from ..shared.domain.trace import Event
    from .options import Options


def fly(app: App, options: Options) -> int:
    """Fly the missions and report the outcome; an interrupt lands the drones."""
    options.refuse_what_is_simulated()
    plan = load(app, options)
    check_flight(app, plan.fleet, options)
    journal = options.journal or place.new(app.name, time.time())
    if os.path.lexists(journal):
        raise exists(journal)
    left = place.gateway_folder(Path(os.path.realpath(journal)))
    if os.path.lexists(left):
        raise BadInput(
            f"{left}: it is of an earlier flight, whose journal is gone, and says what that did:"
            " move it away, or name another place with --journal"
        )
    begun = header(
        app,
        missions=plan.missions_text,
        fleet=plan.fleet_text,
        sim=options.sim,
        stand_ins=options.stand_ins.header if options.stand_ins else None,
        seed=options.seed,
        faults=options.fail,
    )
    if not options.supervised:
        output.tell(f"journal: {printable(str(journal))}")
    if options.supervise:
        words = options.supervised_words("--journal", str(journal))
        return supervised(app, options, journal, again.command(app.package, *words))
    store = Store.create(journal, begun)
    flight = flight_of(plan.app, store, plan.missions, plan.fleet, options.speed or 1.0)
    return see_through(flight, store)


def resume(app: App, options: Options) -> int:
    """Resume the missions of a journal, which has the plan."""
    journal = options.journal or place.newest(app.name)
    taken = reopen(app, journal)
    store = taken.store
    try:
        _check(options, taken)
    except BadInput:
        store.close()
        raise
    if taken.is_over:
        store.close()
        output.line("nothing to go on with: every mission has ended")
        output.line()
        return reported(app, journal, taken.records)
    if not options.supervised:
        output.tell(f"journal: {printable(str(journal))}")
        clear_stop(store.path)
        if taken.header["app_hash"] != fingerprint(app):
            output.tell("the app has changed since: missions go on by the names of its blocks")
    if options.supervise:
        store.close()
        return supervised(app, options, journal, None)
    return see_through(taken.flight(options.speed), store, taken.records)


def _check(options: Options, taken: Resumable) -> None:
    """Refuse flags that are not for the drones of this journal, and drones that cannot be flown."""
    path, stand_ins = taken.store.path, stand_ins_in(taken.header)
    if options.stand_ins is not None and options.stand_ins != stand_ins:
        raise BadInput(f"{path}: it was not begun with {options.stand_ins.flag}")
    if taken.header["sim"]:
        return
    if options.sim:
        raise BadInput(f"{path}: its drones are real ones: go on without --sim")
    options.refuse_what_is_simulated()
    check_real(taken.app, taken.fleet, f"{path} (its fleet)", stand_ins=stand_ins is not None)


STOPPED = 130
"""The exit code after `tell J stop`, as after Ctrl-C."""


def see_through(flight: FlightSetup, store: Store, records: Standing | None = None) -> int:
    """Fly until all have ended or it is stopped; report the outcome, and return the exit code.

    `records`: where all stands by the journal, if that has been read already.
    """
    stops = Stops()
    interrupts = Interrupts(stops, lambda: flight.journal, flight.how_to_go_on)
    with interrupts.listening():
        lived = run_until_complete(_heard(flight, store, stops, interrupts, records))
    if lived.end is End.STOPPED:
        who = "all other drones" if aloft(flight, lived.drones) else "all drones"
        output.tell(f"{who} are down; {flight.how_to_go_on}")
        return interrupts.code or STOPPED
    output.line()
    return reported(flight.app, flight.journal, lived.records, lived.drones)


def reported(app: App, journal: Path, records: Standing, drones: Sequence[Drone] = ()) -> int:
    """Report the outcome of a flight, and return its exit code."""
    code, lines = report_of(app, journal, records, drones)
    for line in [*lines, *waiting_lines(app, journal, records)]:
        output.line(line)
    return code


async def _heard(
    flight: FlightSetup,
    store: Store,
    stops: Stops,
    interrupts: Interrupts,
    records: Standing | None,
) -> FlightResult:
    """Run a flight with its interrupt handlers."""
    interrupts.loop = asyncio.get_running_loop()
    observer = FlightObserver(tell=tell, say=output.tell, born=noting(flight, stops))
    return await run_flight(flight, store, stops, records, observer)


def supervised(app: App, options: Options, journal: Path, first: Sequence[str] | None) -> int:
    """Fly in another process, and restart it when it crashes; `first`: it has not begun."""
    speed = ["--speed", str(options.speed)] if options.speed else []
    on = again.command(app.package, "resume", str(journal), *speed, "--supervised")
    return supervise(
        Supervised(
            name=app.name,
            first=first or on,
            again=lambda: on if journal.exists() else None,
            finished=lambda: finished(records_in(app, journal)) if journal.exists() else 0,
            over=partial(_is_over, app, journal),
            how_to_go_on=how_to_go_on(app, journal),
        )
    )


def _is_over(app: App, journal: Path, code: int) -> bool:
    """Return whether the journal confirms this exit code of a flight."""
    if not journal.exists():
        return code in STOPS  # before anything was flown
    if code in STOPS and pending_stop(Path(os.path.realpath(journal))):
        return True
    records = records_in(app, journal)
    if has_ended(records):
        return code in STOPS or code == report_of(app, journal, records)[0]
    return code in STOPS and records.stopped


def tell(event: Event) -> None:
    """Show an event on standard output."""
    line = line_of(event)
    if line is not None:
        with suppress(output.ClosedPipe, output.CannotWrite):  # the output is closed: fly on
            output.line(line)
            output.flush()
