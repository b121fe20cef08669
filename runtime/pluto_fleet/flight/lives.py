"""A flight and its journal: started or resumed, and run again until it has ended."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..drones.real_fleet import real_fleet
from ..files.fleet import fleet_from, not_real
from ..files.missions import missions_of
from ..files.reading import parsed
from ..gateway.process import NOTE
from ..gateway.settings import Settings, joining_data, settings_for
from ..gateway.starting import connect, speed_in
from ..journal import errors
from ..journal.header import Header, check_whole
from ..journal.place import gateway_folder
from ..journal.store import Store
from ..process import respawn
from ..shared.alone.world import Faults
from ..shared.domain.app import moving
from ..shared.domain.errors import BadInput
from ..shared.domain.text import place
from .config import End, FlightConfig, FlightResult, FlightSetup, Stops
from .fly import Recovered, live, recovered
from .live_flight import LiveFlight
from .mission_status import all_over, finished
from .offline import pending_stop

if TYPE_CHECKING:
    from ..app import App
    from ..drones.real_fleet import RealFleet
    from ..files.fleet import FleetFile
    from ..gateway.remote import RemoteLink
    from ..process.realtime import RealTime
    from ..shared.domain.model import Drone, Mission
    from ..shared.domain.trace import Event

GATEWAY_DEATHS = 5
"""How many gateways may die in a row without progress in between."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Resumable:
    """A journal that is opened to resume it, with its contents."""

    app: App
    store: Store
    header: Header
    fleet: FleetFile
    known: Recovered
    planned: Sequence[Mission[Any]]
    """The plan, to be flown if nothing has begun yet."""

    @property
    def is_over(self) -> bool:
        """Whether every mission has ended, and no drone is returning any more."""
        note = gateway_folder(self.store.path) / NOTE
        return all_over(self.known.records) and not note.exists()

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
        crtp=store.header.get("crtp_sim") is not None,
    )


def reopen(app: App, journal: Path) -> Resumable:
    """Open a journal to resume it; raise `BadInput` if that is not possible."""
    store = Store.open(journal)
    try:
        header: Header = store.header
        check_whole(journal, header, app)
        fleet = fleet_in(app, journal, header)
        app = moving(app, fleet.motion)
        known = recovered(store)
        if unknown := known.records.needed - {drone.id for drone in fleet.drones}:
            raise errors.strange(journal, errors.unknown_drone(min(unknown)))
        planned: Sequence[Mission[Any]] = ()
        if not known.records.missions:
            document = parsed(f"{journal} (its missions)", header["missions"])
            planned = missions_of(document, app, fleet.airspace)
    except BaseException:  # even an interrupt: the store holds the journal's lock
        store.close()
        raise
    return Resumable(app=app, store=store, header=header, fleet=fleet, known=known, planned=planned)


def fleet_in(app: App, journal: Path, header: Header) -> FleetFile:
    """Return the fleet of a journal; raise `BadInput` if it does not fit the app any more."""
    return fleet_from(app, f"{journal} (its fleet)", header["fleet"], header.get("crtp_sim"))


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightObserver:
    """Callbacks for what happens in a flight."""

    tell: Callable[[Event], object]
    """Called with each event, once it is durable."""
    say: Callable[[str], object]
    """Called with messages that are not events, such as that a gateway has died."""
    born: Callable[[LiveFlight], object] | None = None
    """Called with each run when it begins."""
    patient: bool = False
    """Whether the flight goes on while a mission waits for the user's decision."""


async def run_flight(
    flight: FlightSetup,
    store: Store,
    stops: Stops,
    known: Recovered | None,
    observer: FlightObserver,
) -> FlightResult:
    """Run again each time that the gateway dies; `known` is the journal's content."""
    folder = gateway_folder(flight.journal)
    gateway = respawn.library("gateway", beside=flight.app.package)
    records = () if known is None else tuple(known.records.missions.values())

    async def settings(fleet: FleetFile) -> Settings:
        return settings_for(
            flight.app,
            fleet,
            seed=flight.seed,
            faults=flight.faults,
            real=None if flight.sim else await _real(flight, fleet, folder, records),
            speed=flight.speed,
        )

    async def reach(
        kernel: RealTime, fleet: FleetFile, epoch: int, lost: Callable[[], object]
    ) -> RemoteLink:
        return await connect(folder, await settings(fleet), kernel, epoch, lost, gateway)

    async def joining(fleet: FleetFile) -> Mapping[str, object]:
        if not flight.sim and not flight.crtp and (why := not_real(fleet)):
            raise BadInput(why)
        whole = await settings(fleet)
        real = None if whole.real is None else whole.real.drones[-1]
        return joining_data(whole.drones[-1], real)

    setting = FlightConfig(
        flight=flight,
        connect=reach,
        joining=joining,
        tell=observer.tell,
        patient=observer.patient,
    )
    deaths, done = 0, -1
    while True:
        stops.asked = stops.asked or pending_stop(flight.journal)
        with closing(store):
            lived = await live(setting, store, stops, known, observer.born)
        known = None
        if lived.end is not End.LOST:
            if unheard := aloft(flight, lived.drones):
                observer.say(may_hover(unheard))
            return lived
        before, done = done, finished(lived.records)
        deaths = 1 if done > before else deaths + 1
        if deaths > GATEWAY_DEATHS:
            raise BadInput(
                f"{flight.journal}: the gateway ended {deaths} times in a row with nothing finished"
                f" in between; what it said is in {folder / 'log'}; {flight.how_to_go_on}"
            )
        observer.say(
            "the gateway has ended, or cut this app off: it is reached anew, and all drones are asked"
        )
        store = Store.open(flight.journal)


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


async def _real(
    flight: FlightSetup, fleet: FleetFile, folder: Path, records: Iterable[Mapping[str, Any]]
) -> RealFleet:
    """Return the gateway's arguments for real drones; starts simulated Crazyflies if needed."""
    real = real_fleet(fleet, flight.missions, records=records)
    if not flight.crtp:
        return real
    from ..crtp.equipment import fitted, settable
    from ..crtp.process import Surroundings, start, told  # rarely needed
    from ..shared.alone.world import invented

    homes = {drone.id: drone.home for drone in fleet.drones}
    kinds = {one.name: one for one in flight.app.categories}
    batteries = {
        drone.id: (
            kind.flight_time / flight.fleet.motion.drain,
            kind.charge_time if flight.charges else inf,
        )
        for drone in fleet.drones
        for kind in (kinds[drone.category],)
    }
    data = invented(flight.seed, fleet.airspace) if fleet.world is None else fleet.world
    around = Surroundings(seed=flight.seed, data=data)
    uris = await asyncio.to_thread(start, folder, homes, None, batteries, around)
    camera = await asyncio.to_thread(told, folder, "camera")
    drones = (
        replace(
            drone,
            uri=uris[drone.id],
            options=fitted(drone.options, camera, around.world),
            parameters=settable(drone.parameters),
        )
        for drone in real.drones
    )
    return replace(real, drones=tuple(drones))
