"""The station between flights: the unfinished flight, the drones' last known states, the lost drones."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.fleet import with_joined
from ..files.stand_ins import CRTP, StandIns, stand_ins_in
from ..flight.config import how_to_go_on
from ..flight.lives import Resumable, reopen
from ..flight.offline import record_loss, record_return, returned
from ..gateway.sightings import SEEN, Sighting, at_home, sightings_in
from ..journal import lock, place
from ..journal.header import Header, check_whole, fleet_in
from ..journal.place import gateway_folder
from ..journal.reader import Reader
from ..journal.standing import Standing, inherited
from ..journal.store import Store
from ..process.untrusted import parsed
from ..process.whole_file import write_whole
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from ..simulation.world_store import DRONES
from . import rows
from .attention import Cause, of_drones

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import DroneEntry, FleetFile
    from .config import StationConfig
    from .wire import DroneRow

FRESH_FOR = 4.0
"""Seconds for which a drone's last known state counts as current."""

HOVERED = "it was in the air when it was last heard of: go and look"
COMES_DOWN = "it is in the air, and the gateway brings it down"
NEVER = "it has not been heard of yet"
BACK = "it was brought back: it is asked how it is as soon as missions fly"


class IdleDrones:
    """The drones of a fleet, as the last gateway has left them."""

    def __init__(self, fleet: Sequence[DroneEntry], journal: Path | None) -> None:
        self._fleet, self._journal = fleet, journal
        self._folder = None if journal is None else gateway_folder(journal)
        self._read_at: object = None
        self._sightings: dict[str, Sighting] = {}

    @property
    def sightings(self) -> Mapping[str, Sighting]:
        """The drones' last known states, of those that were ever heard of."""
        return self._newest()

    def rows(self, known: Standing | None) -> Iterator[DroneRow]:
        """Yield the row of each; `known` is the journal's record of them."""
        sightings, now = self._newest(), time.time()
        ids = dict.fromkeys(entry.id for entry in self._fleet)
        if known is not None:
            ids |= dict.fromkeys(str(one["id"]) for one in known.joined)
        for id in ids:
            yield _row(id, sightings.get(id), known, now)

    def crashed(self) -> Collection[str]:
        """Return the drones that fell, as the gateway has seen."""
        return [id for id, seen in self._newest().items() if seen.crashed]

    def write_down(self, app: App, known: Standing | None) -> bool:
        """Record the drones that crashed while no app was running; return whether there are any.

        Each state of a drone is processed once.
        """
        before, sightings = self._read_at, self._newest()
        if known is None or self._journal is None or self._read_at == before:
            return False
        told = {*known.lost, *known.mended}
        new = [one for one in sightings if sightings[one].has_fallen and one not in told]
        for drone in new:
            with suppress(BadInput, OSError):  # an app that flies them now records it itself
                seen = sightings[drone]
                record_loss(app, self._journal, drone, seen.why, seen.at)
        return bool(new)

    def _newest(self) -> dict[str, Sighting]:
        """Read the gateway's file, if it has changed."""
        if self._folder is not None:
            with suppress(OSError):
                found = (self._folder / SEEN).stat()
                at = found.st_mtime_ns, found.st_ino
                if at != self._read_at:
                    self._read_at, self._sightings = at, sightings_in(self._folder)
        return self._sightings


def _row(id: str, seen: Sighting | None, known: Standing | None, now: float) -> DroneRow:
    lost = known.lost.get(id) if known is not None else None
    trips = known.flown.get(id, 0) if known is not None else 0
    retired = known is not None and id in known.retired
    if known is not None and id in known.mended:  # it has been repaired since
        return rows.drone_at(id, "UNKNOWN", None, trips, retired, BACK)
    fresh = seen is not None and now - seen.when < FRESH_FOR
    if lost is not None:
        status, why = "LOST", str(lost["reason"])
        if seen is None and lost["at"] is not None:
            seen = Sighting(at=tuple(lost["at"]), battery=0.0, landed=True, when=0.0)
    elif seen is None:
        status, why = "UNKNOWN", NEVER
    elif seen.why:
        status, why = "LOST" if seen.has_fallen else "UNKNOWN", seen.why
    elif seen.landed:
        status, why = "LANDED", ""
    else:
        status, why = ("ALOFT", COMES_DOWN) if fresh else ("UNKNOWN", HOVERED)
    return rows.drone_at(id, status, seen, trips, retired, why)


PUT_AWAY_FILE = "put_away"
"""The file with the name of the last discarded journal."""


def unfinished_flight(app: App, config: StationConfig, going_on: bool = False) -> Resumable | None:
    """Return the newest journal of the station's folder, opened, to be shown and resumed.

    A flight over another map would be misread on this one: it is ignored, unless this station was
    started to resume it.
    """
    journal = place.newest_in(config.folder)
    if journal is None or journal.name == _put_away(config):
        return None
    try:
        taken = reopen(app, journal)
    except BadInput as why:  # flown by another process, damaged, or another app's
        output.tell(f"the last flight cannot be shown: {why}")
        return None
    if _kind_in(taken.header) != _kind_of(config):
        taken.store.close()
        return None
    if not going_on and shown_fleet(taken.fleet) != shown_fleet(config.fleet):
        taken.store.close()
        if taken.is_over:
            return None
        output.tell(
            "the last flight is not shown: it has another map, or other drones, than this station;"
            f" serve with the fleet file with which it began. Without it, {how_to_go_on(app, journal)}"
        )
        return None
    return taken


def _kind_of(config: StationConfig) -> str:
    """Return what its drones are: real, simulated, or simulated down to a protocol."""
    return _kind(config.sim, config.stand_ins)


def _kind_in(header: Header) -> str:
    """Return the same of a flight."""
    return _kind(bool(header.get("sim")), stand_ins_in(header))


def _kind(sim: bool, stand_ins: StandIns | None) -> str:
    if stand_ins is not None:
        return stand_ins.kind
    return "simulated" if sim else "real"


def shown_fleet(fleet: FleetFile) -> object:
    """Return the data of a fleet for pages."""
    return fleet.airspace, [(one.id, one.category, one.home) for one in fleet.drones]


def put_away(config: StationConfig, journal: Path) -> None:
    """Mark a journal as discarded, so that it is not resumed; the file stays."""
    (config.own_folder / PUT_AWAY_FILE).write_text(journal.name, encoding="utf-8")


def _put_away(config: StationConfig) -> str:
    with suppress(OSError, ValueError):
        return (config.own_folder / PUT_AWAY_FILE).read_text(encoding="utf-8")
    return ""


DRONES_FILE = "drones.json"


class FleetHistory:
    """The drones' states before a flight begins, from earlier flights."""

    def __init__(self, app: App, config: StationConfig) -> None:
        self._app, self._config = app, config
        self._kind = _kind_of(config)
        self._file = config.own_folder / DRONES_FILE
        self.records = Standing()
        self._journal: Path | None = None
        """The newest journal, if it is of these drones."""
        self._idle = IdleDrones(config.fleet.drones, None)

    def read(self) -> None:
        """Read it again, as another process may have brought a drone back, or flown."""
        self.records, self._journal = self._kept(), None
        journal = place.newest_in(self._config.folder)
        if journal is not None:
            with suppress(BadInput):  # errors are reported where the last flight is shown
                self._take(journal)
        self._idle = IdleDrones(self._config.fleet.drones, self._journal)

    def _take(self, journal: Path) -> None:
        with closing(Store.open(journal)) as store:
            header: Header = store.header
            check_whole(journal, header, self._app)
            if _kind_in(header) != self._kind:
                return
            flown = fleet_in(self._app, journal, header)
            same = shown_fleet(flown) == shown_fleet(self._config.fleet)
            records = store.standing()
        if "lost" not in header:  # it was not started by a station
            for drone, why in self.records.lost.items():
                records.lose(drone, why["reason"], why["at"])
        self.records = records
        if same:
            self._journal = journal
        else:  # positions on another map mean nothing on this one
            records.app["joined"] = []
            for drone, why in records.lost.items():
                records.with_drone(drone, lost={**why, "at": None})

    def _kept(self) -> Standing:
        records = Standing()
        with suppress(OSError, ValueError, TypeError, LookupError):
            kept = parsed(self._file.read_text(encoding="utf-8"))
            if kept["kind"] == self._kind:
                records.take(inherited(kept["drones"]))
        return records

    def leave(self, journal: Path, records: Standing) -> None:
        """Store the states that a flight has left."""
        self.records, self._journal = records, journal
        self._idle = IdleDrones(self._config.fleet.drones, journal)
        self._keep()

    def _keep(self) -> None:
        known = self.records
        drones = {"lost": known.lost, "mended": known.mended, "retired": known.retired}
        text = json.dumps({"kind": self._kind, "drones": drones})
        with suppress(OSError):  # the journal has it, too
            write_whole(self._file, text)

    @property
    def facts(self) -> dict[str, object]:
        """Return the facts that the next journal inherits."""
        known = self.records
        drones = {"lost": known.lost, "mended": known.mended, "retired": known.retired}
        return drones | {"joined": known.joined}

    @property
    def fleet(self) -> FleetFile:
        """The fleet, with the drones that have joined it in earlier flights on this map."""
        return with_joined(self._app, self._config.fleet, self.records.joined)

    @property
    def _fleet(self) -> list[str]:
        return [entry.id for entry in self.fleet.drones]

    @property
    def sightings(self) -> Mapping[str, Sighting]:
        """The drones' last known states, of those that were ever heard of."""
        return self._idle.sightings

    @property
    def lost(self) -> Sequence[str]:
        """The lost drones of the fleet."""
        return [drone for drone in self._fleet if drone in self.records.lost]

    def bring_back(self, id: str, drone: str) -> str:
        """Bring a drone back while nothing flies."""
        if drone not in self._fleet:
            names = ", ".join(map(quoted, self._fleet))
            raise BadInput(f"no drone {quoted(drone)} is in the fleet; there are: {names}")
        now = self.records.time
        commanded = {"t": now, "event": "commanded", "id": id, "command": "bring-back"}
        if self._journal is not None and self._journal.exists():
            said = record_return(self._app, self._journal, drone, [commanded])
            self.read()
        else:
            event, said = returned(self.records, drone)
            if event is not None:
                self.records.bring_back(drone)
        self._keep()
        return said

    def flown_elsewhere(self) -> int | None:
        """Return the process that commands the drones of the newest journal, if any."""
        journal = place.newest_in(self._config.folder)
        process = None if journal is None else lock.holder(journal)
        if journal is None or process is None:
            return None
        with closing(Reader(journal)) as reader:  # its writer has it open
            header = reader.header
        return process if _kind_in(header) == self._kind else None

    def check_free(self) -> None:
        """Raise `BadInput` if another process commands the drones of the newest journal."""
        if (process := self.flown_elsewhere()) is not None:
            raise BadInput(
                f"the last flight was gone on with elsewhere (process {process}): end it there first"
            )

    def hand_on_the_world(self, journal: Path) -> None:
        """Copy the simulated world of the last flight to the next one.

        Drones without an earlier flight are at home.
        """
        new = place.gateway_folder(journal)
        new.mkdir(mode=0o700, parents=True, exist_ok=True)
        if self._journal is not None:
            old = place.gateway_folder(self._journal)
            for name in (*self._world(old), SEEN):
                with suppress(FileNotFoundError):
                    shutil.copyfile(old / name, new / name)
        if self._config.sim:
            at_home(new, {entry.id: entry.home for entry in self.fleet.drones})

    def _world(self, folder: Path) -> Sequence[str]:
        """Return the files of the simulated world of a gateway that has ended."""
        stand_ins = self._config.stand_ins
        if stand_ins is not None and stand_ins.kind == CRTP:
            from ..crtp.process import DRONES as CRAZYFLIES  # rarely needed
            from ..crtp.process import end

            end(folder)
            return [CRAZYFLIES]
        if stand_ins is not None:
            from ..autopilot.process import VEHICLES, end

            end(folder)
            return [VEHICLES]
        return [DRONES] if self._config.sim else []

    def rows(self) -> Iterator[DroneRow]:
        """Yield the rows of the drones while there is no flight."""
        if self._idle.write_down(self._app, self.records):
            self.read()
            self._keep()
        known = self.records
        if self._journal is not None or known.lost or known.mended or known.retired:
            yield from self._idle.rows(known)

    def causes(self, drones: Sequence[DroneRow]) -> Iterator[Cause]:
        """Yield what a person must know of while there is no flight."""
        return of_drones(drones, self._idle.crashed())
