"""`resume`: goes on after a stop or a crash."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import printable

from ..journal import place
from ..journal.header import fingerprint
from ..flight.lives import Resumable, reopen
from ..flight.offline import clear_stop
from .flights import reported, see_through, supervised
from .real import check_real

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .options import Options


def resume(app: App, options: Options) -> int:
    """Go on with the missions of a journal, which says what was planned."""
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
        return reported(app, journal, taken.known.records)
    if not options.supervised:
        output.tell(f"journal: {printable(str(journal))}")
        clear_stop(store.path)
        if taken.header["app_hash"] != fingerprint(app):
            output.tell("the app has changed since: missions go on by the names of its blocks")
    if store.torn is not None:
        output.tell(f"{journal}: {store.torn}")
    if options.supervise:
        store.close()
        return supervised(app, options, journal, None)
    return see_through(taken.flight(options.speed), store, taken.known)


def _check(options: Options, taken: Resumable) -> None:
    """Refuse flags that are not for the drones of this journal, and drones that cannot be flown."""
    path, stand_ins = taken.store.path, taken.header.get("crtp_sim")
    if options.crtp_sim not in (None, stand_ins):
        raise BadInput(f"{path}: it was not begun with --crtp-sim {options.crtp_sim}")
    if taken.header["sim"]:
        return
    if options.sim:
        raise BadInput(f"{path}: its drones are real ones: go on without --sim")
    options.refuse_what_is_simulated()
    check_real(taken.app, taken.fleet, f"{path} (its fleet)", stand_ins=stand_ins is not None)
