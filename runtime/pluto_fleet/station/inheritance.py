"""What each flight leaves to the next: who is lost, who was looked after since, who is retired.

The newest journal says so. A file of the station's says it as well, for journals may be moved away;
drones do not heal by that.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import quoted

from ..cli.looked_after import brought_back, looked_after
from ..cli.plans import fleet_in
from ..flight.fly import recovered
from ..gateway.sightings import SEEN, at_home
from ..journal import lock, place
from ..journal.fold import Records
from ..journal.header import Header, check
from ..journal.reader import Reader
from ..journal.store import Store
from ..simulation.world_store import DRONES
from .leftover import drawn
from .rest import Rest

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from . import rows
    from .settings import Settings

FILE = "drones.json"


class Inheritance:
    """What is known of the drones before a flight begins."""

    def __init__(self, app: App, settings: Settings) -> None:
        self._app, self._settings = app, settings
        self._kind = [settings.sim, settings.crtp_sim is not None]
        self._file = settings.own_folder / FILE
        self._fleet = [entry.id for entry in settings.fleet.drones]
        self.records = Records()
        self._journal: Path | None = None
        """The newest one, if its drones are these."""
        self._rest = Rest(settings.fleet.drones, None)

    def read(self) -> None:
        """Read it anew: somebody else may have brought a drone back, or flown meanwhile."""
        self.records, self._journal = self._kept(), None
        journal = place.newest_in(self._settings.folder)
        if journal is not None:
            with suppress(BadInput):  # whoever shows the last flight says what is wrong with it
                self._take(journal)
        self._rest = Rest(self._settings.fleet.drones, self._journal)

    def _take(self, journal: Path) -> None:
        with closing(Store.open(journal)) as store:
            header: Header = store.header
            check(journal, header, self._app)
            if [header["sim"], header.get("crtp_sim") is not None] != self._kind:
                return
            same = drawn(fleet_in(self._app, journal, header)) == drawn(self._settings.fleet)
            records = recovered(store).records
        if "lost" not in header:  # it was not begun by a station
            for drone, why in self.records.lost.items():
                records.lost.setdefault(drone, why)
        self.records = records
        if same:
            self._journal = journal
        else:  # what was a place on that map is none on this one
            for why in records.lost.values():
                why["at"] = None

    def _kept(self) -> Records:
        records = Records()
        with suppress(OSError, ValueError, TypeError, AttributeError):
            kept = json.loads(self._file.read_text(encoding="utf-8"))
            if kept["kind"] == self._kind:
                records.take({"t": 0.0, "event": "journal.begun", **kept["drones"]})
        return records

    def leave(self, journal: Path, records: Records) -> None:
        """Keep what a flight has left behind."""
        self.records, self._journal = records, journal
        self._rest = Rest(self._settings.fleet.drones, journal)
        self._keep()

    def _keep(self) -> None:
        text = json.dumps({"kind": self._kind, "drones": self.facts})
        with suppress(OSError):  # the journal says it, too
            part = self._file.with_name(f"{self._file.name}.part")
            part.write_text(text, encoding="utf-8")
            part.replace(self._file)

    @property
    def facts(self) -> dict[str, object]:
        """What the next journal begins with."""
        known = self.records
        return {"lost": known.lost, "mended": known.mended, "retired": known.retired}

    @property
    def lost(self) -> Sequence[str]:
        """The drones of the fleet that nobody may have."""
        return [drone for drone in self._fleet if drone in self.records.lost]

    def bring_back(self, id: str, drone: str) -> str:
        """A person has looked after a drone, while nothing flies."""
        if drone not in self._fleet:
            names = ", ".join(map(quoted, self._fleet))
            raise BadInput(f"no drone {quoted(drone)} is in the fleet; there are: {names}")
        commanded = {
            "t": self.records.time,
            "event": "commanded",
            "id": id,
            "command": "bring-back",
        }
        if self._journal is not None and self._journal.exists():
            said = looked_after(self._app, self._journal, drone, [commanded])
            self.read()
        else:
            event, said = brought_back(self.records, drone)
            for one in [event, commanded] if event is not None else []:
                self.records.take(one)
        self._keep()
        return said

    def flown_elsewhere(self) -> int | None:
        """Return the process that commands the drones of the newest journal, if any does."""
        journal = place.newest_in(self._settings.folder)
        process = None if journal is None else lock.holder(journal)
        if journal is None or process is None:
            return None
        with closing(Reader(journal)) as reader:  # whoever writes it has it open
            header: dict[str, object] = next((json.loads(row.text)[0] for row in reader.rows()), {})
        same = [header.get("sim"), header.get("crtp_sim") is not None] == self._kind
        return process if same else None

    def check_free(self) -> None:
        """Raise `BadInput` where somebody commands the drones of the newest journal."""
        if (process := self.flown_elsewhere()) is not None:
            raise BadInput(
                f"somebody has gone on with the last flight elsewhere (process {process}): end it"
                " there first"
            )

    def hand_on_the_world(self, journal: Path) -> None:
        """Let simulated drones be in the next flight where the last one has left them.

        Those that no flight has left anywhere stand at home, and that is known.
        """
        new = place.gateway_folder(journal)
        new.mkdir(mode=0o700, parents=True, exist_ok=True)
        if self._journal is not None:
            old = place.gateway_folder(self._journal)
            for name in (*self._world(old), SEEN):
                with suppress(FileNotFoundError):
                    shutil.copyfile(old / name, new / name)
        if self._settings.sim:
            at_home(new, {entry.id: entry.home for entry in self._settings.fleet.drones})

    def _world(self, folder: Path) -> Sequence[str]:
        """Return the files of the simulated world of a gateway, which nobody lives in any more."""
        if self._settings.crtp_sim is not None:
            from ..crtp.process import DRONES as CRAZYFLIES  # few want them
            from ..crtp.process import end

            end(folder)
            return [CRAZYFLIES]
        return [DRONES] if self._settings.sim else []

    def rows(self) -> Iterator[rows.Row]:
        """Yield what there is to see of the drones while there is no flight at all."""
        if self._rest.write_down(self._app, self.records):
            self.read()
            self._keep()
        known = self.records
        if self._journal is not None or known.lost or known.mended or known.retired:
            yield from self._rest.rows(known)
