"""What `fly` and `resume` share: one life after another, until all is over or somebody stops it."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime import output

from ..flight.config import End, Stops
from ..flight.lives import Flight, Observer, aloft, how_to_go_on, run_flight
from ..flight.offline import pending_stop
from ..flight.standing import finished, has_ended, records_in
from ..process import respawn as again
from ..report.report import report_of, waiting_lines
from ..report.sentences import line_of
from .interrupts import Interrupts
from .leaving import run as run_until_complete
from .supervise import STOPS, Supervised, supervise

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone
    from plutoc_runtime.domain.trace import Event

    from ..flight.config import Lived
    from ..flight.fly import Recovered
    from ..journal.fold import Records
    from ..journal.store import Store
    from .options import Options

STOPPED = 130
"""The exit code after `tell J stop`, as after Ctrl-C."""

def see_through(flight: Flight, store: Store, known: Recovered | None = None) -> int:
    """Fly until all is over or somebody stops it; say what came of it, and return the exit code.

    `known` is what the journal says, if it has been read already.
    """
    stops = Stops()
    interrupts = Interrupts(stops, lambda: flight.journal, flight.how_to_go_on)
    with interrupts.listening():
        lived = run_until_complete(_heard(flight, store, stops, interrupts, known))
    if lived.end is End.STOPPED:
        who = "all other drones" if aloft(flight, lived.drones) else "all drones"
        output.tell(f"{who} are down; {flight.how_to_go_on}")
        return interrupts.code or STOPPED
    output.line()
    return reported(flight.app, flight.journal, lived.records, lived.drones)


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
    return await run_flight(flight, store, stops, known, Observer(tell=tell, say=output.tell))


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
    if code in STOPS and pending_stop(Path(os.path.realpath(journal))):
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
