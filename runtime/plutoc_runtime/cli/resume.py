"""`resume`: goes on after a stop or a crash."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import BadInput
from ..fly import recovered
from ..gateway.process import NOTE
from ..gateway.starting import speed_in
from ..journal import place
from ..journal.header import Header, check, fingerprint
from ..journal.store import Store
from ..simulation.faults import Faults
from . import output, stop_mark
from .flights import Flight, reported, see_through, supervised
from .flown import all_over
from .plans import fleet_in, missions_in

if TYPE_CHECKING:
    from ..app import App
    from .options import Options


def resume(app: App, options: Options) -> int:
    """Go on with the missions of a journal, which says what was planned."""
    journal = options.journal or place.newest(app.name)
    store = Store.open(journal)
    header: Header = store.header
    try:
        check(journal, header, app)
        if not header["sim"]:
            raise BadInput(f"{journal}: its drones are real ones, and those are not supported yet")
        fleet = fleet_in(app, journal, store.header)
        known = recovered(store)
        records = known.records
        planned = [] if records.missions else missions_in(app, journal, header, fleet)
    except BaseException:
        store.close()
        raise
    note = place.gateway_folder(store.path) / NOTE
    if all_over(records) and not note.exists():  # else drones may still be on their way home
        store.close()
        output.line("nothing to go on with: every mission has ended")
        output.line()
        return reported(app, journal, records)
    if not options.supervised:
        output.tell(f"journal: {journal}")
        stop_mark.remove(store.path)
        if header["app_hash"] != fingerprint(app):
            output.tell("the app has changed since: missions go on by the names of its blocks")
    if store.torn is not None:
        output.tell(f"{journal}: {store.torn}")
    if options.supervise:
        store.close()
        return supervised(app, options, journal, None)
    flight = Flight(
        app=app,
        journal=store.path,
        missions=planned,
        fleet=fleet,
        speed=options.speed or speed_in(place.gateway_folder(store.path)) or 1.0,
        seed=header["seed"],
        faults=Faults(**header["faults"]),
    )
    return see_through(flight, store, known)
