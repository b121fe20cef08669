"""The drones while nobody commands them: where each was heard of last, and what that leaves open."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput

from ..cli.looked_after import lost_meanwhile
from ..gateway.sightings import SEEN, Sighting, sightings_in
from ..journal.place import gateway_folder
from . import rows

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.app import App

    from ..files.drones import DroneEntry
    from ..journal.fold import Records

FRESH = 4.0
"""Seconds for which what was heard of a drone is how it is."""

HOVERED = "it was in the air when it was last heard of: go and look"
COMES_DOWN = "it is in the air, and the gateway brings it down"
NEVER = "it has not been heard of yet"
BACK = "it was brought back: it is asked how it is as soon as missions fly"


class Rest:
    """The drones of a fleet, as the last gateway that flew them has left them."""

    def __init__(self, fleet: Sequence[DroneEntry], journal: Path | None) -> None:
        self._fleet, self._journal = fleet, journal
        self._folder = None if journal is None else gateway_folder(journal)
        self._read_at: object = None
        self._sightings: dict[str, Sighting] = {}

    def rows(self, known: Records | None) -> Iterator[rows.Row]:
        """Yield what there is to see of each; `known` is what the journal says of them."""
        sightings, now = self._newest(), time.time()
        for entry in self._fleet:
            yield _row(entry.id, sightings.get(entry.id), known, now)

    def write_down(self, app: App, known: Records | None) -> bool:
        """Put on record who has crashed with no app there to be told; say whether anybody has.

        Each news of the drones is looked at once.
        """
        before, sightings = self._read_at, self._newest()
        if known is None or self._journal is None or self._read_at == before:
            return False
        told = {*known.lost, *known.mended}
        new = [one for one in sightings if sightings[one].has_fallen and one not in told]
        for drone in new:
            with suppress(BadInput, OSError):  # an app that flies them now hears it from them
                seen = sightings[drone]
                lost_meanwhile(app, self._journal, drone, seen.why, seen.at)
        return bool(new)

    def _newest(self) -> dict[str, Sighting]:
        """Read the gateway's file, if it is another than before."""
        if self._folder is not None:
            with suppress(OSError):
                found = (self._folder / SEEN).stat()
                at = found.st_mtime_ns, found.st_ino
                if at != self._read_at:
                    self._read_at, self._sightings = at, sightings_in(self._folder)
        return self._sightings


def _row(id: str, seen: Sighting | None, known: Records | None, now: float) -> rows.Row:
    lost = known.lost.get(id) if known is not None else None
    trips = known.flown.get(id, 0) if known is not None else 0
    retired = known is not None and id in known.retired
    if known is not None and id in known.mended:  # somebody has taken it in their hands since
        return rows.drone_at(id, "UNKNOWN", None, trips, retired, BACK)
    fresh = seen is not None and now - seen.when < FRESH
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
