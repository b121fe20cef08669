"""A journal that somebody goes on with: opened, checked and read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.faults import Faults

from ..files.fleet import as_flown
from ..flight.fly import Recovered, recovered
from ..gateway.process import NOTE
from ..gateway.starting import speed_in
from ..journal.header import Header, check
from ..journal.place import gateway_folder
from ..journal.store import Store
from .flights import Flight
from .flown import all_over
from .plans import fleet_in, missions_in

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ..files.fleet import FleetFile


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenUp:
    """A journal, and what it says."""

    app: App
    store: Store
    header: Header
    fleet: FleetFile
    known: Recovered
    planned: Sequence[Mission[Any]]
    """What is to be flown if nothing has begun yet."""

    @property
    def is_over(self) -> bool:
        """Whether every mission has ended, and no drone is on its way home any more."""
        note = gateway_folder(self.store.path) / NOTE
        return all_over(self.known.records) and not note.exists()

    def flight(self, speed: float | None) -> Flight:
        """Return the flight that goes on; without a speed it goes on at the one it had."""
        folder = gateway_folder(self.store.path)
        return Flight(
            app=self.app,
            journal=self.store.path,
            missions=self.planned,
            fleet=self.fleet,
            speed=speed or speed_in(folder) or 1.0,
            seed=self.header["seed"],
            faults=Faults(**self.header["faults"]),
            sim=self.header["sim"],
            crtp=self.header.get("crtp_sim") is not None,
        )


def take_up(app: App, journal: Path) -> TakenUp:
    """Open a journal to go on with it; raise `BadInput` where that cannot be."""
    store = Store.open(journal)
    try:
        header: Header = store.header
        check(journal, header, app)
        fleet = fleet_in(app, journal, header)
        if not header["sim"]:
            app = as_flown(app, fleet)
        known = recovered(store)
        started = bool(known.records.missions)
        planned = [] if started else missions_in(app, journal, header, fleet)
    except BaseException:
        store.close()
        raise
    return TakenUp(app=app, store=store, header=header, fleet=fleet, known=known, planned=planned)
