"""`fly`: the whole app in real time, from the beginning."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.alone.faults import Faults
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import printable

from ..journal import place
from ..journal.errors import exists
from ..journal.header import header
from ..journal.store import Store
from .flights import Flight, see_through, supervised
from .plans import load
from .real import check_real

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .options import Options


def fly(app: App, options: Options) -> int:
    """Fly the missions and say what came of them; whoever interrupts it lands the drones."""
    options.refuse_what_is_simulated()
    plan = load(app, options)
    if options.is_real:
        where = str(options.fleet or app.name)
        check_real(app, plan.fleet, where, stand_ins=options.crtp_sim is not None)
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
        crtp_sim=options.crtp_sim,
        seed=options.seed,
        faults=options.fail,
    )
    if not options.supervised:
        output.tell(f"journal: {printable(str(journal))}")
    if options.supervise:
        return supervised(app, options, journal, _words(options, journal))
    store = Store.create(journal, begun)
    flight = Flight(
        app=plan.app,
        journal=store.path,
        missions=plan.missions,
        fleet=plan.fleet,
        speed=options.speed or 1.0,
        seed=options.seed,
        faults=Faults(**options.fail),
        sim=options.sim,
        crtp=options.crtp_sim is not None,
    )
    return see_through(flight, store)


def _words(options: Options, journal: Path) -> list[str]:
    """Return the command line of the flight that is supervised."""
    fleet = ["--fleet", str(options.fleet)] if options.fleet else []
    faults = ",".join(f"{what}={share}" for what, share in options.fail.items())
    chance = ["--seed", str(options.seed), *(["--fail", faults] if faults else [])]
    how = options.drone_flags
    return ["fly", str(options.missions), *fleet, *how, *chance, "--journal", str(journal)]
