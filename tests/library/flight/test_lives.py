"""Lives of an app in real time: stopped, lost, gone on with, over a real journal."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.flight.access import GatewayAccess
from pluto_fleet.flight.config import FlightResult, FlightSetup, Stops
from pluto_fleet.flight.live_flight import FlightObserver
from pluto_fleet.flight.lives import flight_of, live
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.jobs.controls import fleet_drones
from pluto_fleet.jobs.link import Link
from pluto_fleet.jobs.reports import Down
from pluto_fleet.journal import header
from pluto_fleet.journal.copies import newest_whole
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.events.world import MovingWorld
from pluto_fleet.simulation.drones import SimulatedNavigation
from tests.kit import apps

SCOUT = Category(name="scout", speed=1.0)
AIRSPACE = Airspace(cruise_height=1.0)


class Tried:
    """An app with two trips, its journal and its drone, which outlives the app."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "a.journal"
        self.app = apps.changed(
            apps.app(apps.flow(), categories=[SCOUT]), resumes=("wait", "allocate")
        )
        self.fleet = apps.fleet(airspace=AIRSPACE)
        self.told: list[Event] = []
        self.drones = fleet_drones(self.app, self.fleet)
        self.ledger = Ledger()
        self.gateway: Gateway | None = None
        self.watch: Callable[[Event], object] = lambda event: None
        whole = header.header(self.app, missions="", fleet=None, sim=True, seed=0)
        Store.create(self.path, whole).close()

    @property
    def missions(self) -> list[apps.Mission]:
        trips = (
            apps.Trip(name=name, action="measure", target=(x, 0.5, 1.0))
            for name, x in (("A", 3.0), ("B", 4.0))
        )
        return [apps.mission("m", *trips)]

    def tell(self, event: Event) -> None:
        self.told.append(event)
        self.watch(event)

    async def live(self, stops: Stops | None = None) -> FlightResult:
        with closing(Store.open(self.path)) as store:
            flight = flight_of(self.app, store, self.missions, self.fleet, 1000.0)
            observer = FlightObserver(tell=self.tell, say=lambda _: None)
            return await live(flight, store, stops or Stops(), observer, HereAccess(flight, self))

    def on(self, kind: str, call: Callable[[], object]) -> None:
        """Call this, once, as soon as there is such an event, from outside of the kernel."""

        def watch(event: Event) -> None:
            if event["event"] == kind:
                self.watch = lambda event: None
                asyncio.get_running_loop().call_soon(call)

        self.watch = watch

    @property
    def kinds(self) -> list[str]:
        return [str(event["event"]) for event in self.told]

    @property
    def journal(self) -> list[dict[str, Any]]:
        with closing(Reader(self.path)) as reader:
            return [event for _, event in reader.events()][1:]


class HereAccess(GatewayAccess):
    """A gateway in this process, another one in each life."""

    def __init__(self, flight: FlightSetup, tried: Tried) -> None:
        super().__init__(flight)
        self._tried = tried

    async def link(
        self, kernel: RealTime, fleet: FleetFile, epoch: int, lost: Callable[[], object]
    ) -> Link:
        """Let new drones stand where they stand: of each life they are new."""
        tried = self._tried
        world = MovingWorld(0, AIRSPACE, None)
        navigation = SimulatedNavigation(kernel, tried.drones, world, Faults(), 0)
        tried.gateway = Gateway(kernel, navigation, tried.drones, AIRSPACE, ledger=tried.ledger)
        return tried.gateway.link(epoch, lost)


@pytest.fixture
def tried(tmp_path: Path) -> Tried:
    return Tried(tmp_path)


@pytest.fixture
def durable(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The kinds of the events that are on record, as soon as they are."""
    kinds: list[str] = []
    append = Store.append

    def noted(store: Store, entries: list[Entry]) -> None:
        append(store, entries)
        kinds.extend(event["event"] for one in entries for event in json.loads(one.events))

    monkeypatch.setattr(Store, "append", noted)
    return kinds


def test_nothing_is_told_before_it_is_on_record(tried: Tried, durable: list[str]) -> None:
    """So what was read on a screen is there after a crash."""

    def watch(event: Event) -> None:
        assert len(tried.told) <= len(durable)

    tried.watch = watch
    asyncio.run(tried.live())
    assert tried.kinds == durable


def test_on_a_full_disk_all_drones_land_and_nothing_more_is_told(
    tried: Tried, monkeypatch: pytest.MonkeyPatch
) -> None:
    append = Store.append
    left = [2]

    def full(store: Store, entries: list[Entry]) -> None:
        left[0] -= len(entries)
        if left[0] < 0:
            store.failure = JournalError("the disk is full")
            raise store.failure
        append(store, entries)

    monkeypatch.setattr(Store, "append", full)
    with pytest.raises(JournalError, match="the disk is full"):
        asyncio.run(tried.live())
    assert tried.gateway is not None
    assert not tried.gateway.flies
    written = tried.journal
    assert [event["event"] for event in written[:-1]] == tried.kinds
    assert "the disk is full" in str(written[-1]["text"])


def test_the_journal_is_copied_at_the_start_and_each_copy_is_whole(tried: Tried) -> None:
    """It can be put in the journal's place, and the flight goes on from there."""
    stops = Stops()
    tried.on("trip.completed", lambda: stops.stop(Down.LAND))
    asyncio.run(tried.live(stops))
    whole = newest_whole(tried.path)
    assert whole is not None
    tried.path.write_bytes(whole[0].read_bytes())
    lived = asyncio.run(tried.live())
    assert [mission.status for mission in lived.missions] == [Status.COMPLETED]
