"""`resume`: goes on after a stop or a crash."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..journal import place
from ..journal.header import fingerprint
from . import output, stop_mark
from .flights import reported, see_through, supervised
from .taken_up import take_up

if TYPE_CHECKING:
    from ..app import App
    from .options import Options


def resume(app: App, options: Options) -> int:
    """Go on with the missions of a journal, which says what was planned."""
    journal = options.journal or place.newest(app.name)
    taken = take_up(app, journal)
    store = taken.store
    if taken.is_over:
        store.close()
        output.line("nothing to go on with: every mission has ended")
        output.line()
        return reported(app, journal, taken.known.records)
    if not options.supervised:
        output.tell(f"journal: {journal}")
        stop_mark.remove(store.path)
        if taken.header["app_hash"] != fingerprint(app):
            output.tell("the app has changed since: missions go on by the names of its blocks")
    if store.torn is not None:
        output.tell(f"{journal}: {store.torn}")
    if options.supervise:
        store.close()
        return supervised(app, options, journal, None)
    return see_through(taken.flight(options.speed), store, taken.known)
