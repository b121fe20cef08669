"""A flight and its journal: started or resumed, and run again until it has ended."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..files.missions import missions_of
from ..files.reading import parsed
from ..files.stand_ins import stand_ins_in
from ..gateway.process import NOTE
from ..gateway.starting import speed_in
from ..journal import errors
from ..journal.header import Header, check_whole, fleet_in
from ..journal.place import gateway_folder
from ..journal.store import Store
from ..shared.alone.world import Faults
from ..shared.domain.app import moving
from ..shared.domain.errors import BadInput
from ..shared.domain.text import place
from .access import GatewayAccess
from .config import End, FlightResult, FlightSetup, Stops
from .live_flight import FlightObserver, LiveFlight
from .mission_status import all_over, finished
from .offline import pending_stop

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..journal.standing import Standing
    from ..shared.domain.model import Drone, Mission

GATEWAY_DEATHS = 5
"""How many gateways may die in a row without progress in between."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Resumable:
    """A journal that is opened to resume it, with its contents."""

    app: App
    store: Store
    header: Header
    fleet: FleetFile
    records: Standing
    planned: Sequence[Mission[Any]]
    """The plan, to be flown if nothing has begun yet."""

    @property
    def is_over(self) -> bool:
        """Whether every mission has ended, and no drone is returning any more."""
        note = gateway_folder(self.store.path) / NOTE
        return all_over(self.records) and not note.exists()

    def flight(self, speed: float | None) -> FlightSetup:
        """Return the flight to resume; without a speed at its former one."""
        folder = gateway_folder(self.store.path)
        speed = speed or speed_in(folder) or 1.0
        return flight_of(self.app, self.store, self.planned, self.fleet, speed)


def flight_of(
    app: App, store: Store, missions: Sequence[Mission[Any]], fleet: FleetFile, speed: float
) -> FlightSetup:
    """Return a flight as the header of its journal says how it is flown."""
    return FlightSetup(
        app=app,
        journal=store.path,
        missions=missions,
        fleet=fleet,
        speed=speed,
        seed=store.header["seed"],
        faults=Faults(**store.header["faults"]),
        sim=store.header["sim"],
        stand_ins=stand_ins_in(store.header),
    )


def reopen(app: App, journal: Path) -> Resumable:
    """Open a journal to resume it; raise `BadInput` if that is not possible."""
    store = Store.open(journal)
    try:
        header: Header = store.header
        check_whole(journal, header, app)
        fleet = fleet_in(app, journal, header)
        app = moving(app, fleet.motion)
        records = store.standing()
        if unknown := records.needed - {drone.id for drone in fleet.drones}:
            raise errors.strange(journal, errors.unknown_drone(min(unknown)))
        planned: Sequence[Mission[Any]] = ()
        if not records.missions:
            document = parsed(f"{journal} (its missions)", header["missions"])
            planned = missions_of(document, app, fleet.airspace)
    except BaseException:  # even an interrupt: the store holds the journal's lock
        store.close()
        raise
    return Resumable(
        app=app, store=store, header=header, fleet=fleet, records=records, planned=planned
    )


async def run_flight(
    flight: FlightSetup,
    store: Store,
    stops: Stops,
    records: Standing | None,
    observer: FlightObserver,
) -> FlightResult:
    """Run again each time that the gateway dies; `records`: where all stands by the journal, if it was read."""
    access = GatewayAccess(flight, () if records is None else (*records.missions.values(),))
    deaths, done = 0, -1
    while True:
        stops.asked = stops.asked or pending_stop(flight.journal)
        with closing(store):
            lived = await live(flight, store, stops, observer, access, records)
        records = None
        if lived.end is not End.LOST:
            if unheard := aloft(flight, lived.drones):
                observer.say(may_hover(unheard))
            return lived
        before, done = done, finished(lived.records)
        deaths = 1 if done > before else deaths + 1
        if deaths > GATEWAY_DEATHS:
            raise BadInput(
                f"{flight.journal}: the gateway ended {deaths} times in a row with nothing finished"
                f" in between; what it said is in {gateway_folder(flight.journal) / 'log'}; {flight.how_to_go_on}"
            )
        observer.say(
            "the gateway has ended, or cut this app off: it is reached anew, and all drones are asked"
        )
        store = Store.open(flight.journal)


async def live(
    flight: FlightSetup,
    store: Store,
    stops: Stops,
    observer: FlightObserver,
    access: GatewayAccess,
    records: Standing | None = None,
) -> FlightResult:
    """Run the app until all missions have ended, it is stopped, or its gateway dies."""
    records = records or store.standing()
    begin = records.time
    if records.missions:
        meanwhile = speed_in(gateway_folder(store.path)) or flight.speed
        begin += max(0.0, time.time() - store.written) * meanwhile
    one = LiveFlight(flight, observer, access, store, records, begin)
    if observer.born is not None:
        observer.born(one)
    try:
        return await one.live(stops)
    finally:
        stops.stop_now = None
        await one.close()


def aloft(flight: FlightSetup, drones: Iterable[Drone]) -> list[Drone]:
    """Return the real drones that were last seen in the air, though all should have landed."""
    return [] if flight.sim else [drone for drone in drones if not drone.telemetry.landed]


def may_hover(drones: Iterable[Drone]) -> str:
    """Return the message about those."""
    places = ", ".join(f"{drone.id} (last heard of at {place(drone.location)})" for drone in drones)
    return (
        f"no word of a landing from {places}: do not stand where a drone may still hover;"
        " the gateway lands each that answers within two minutes"
    )
