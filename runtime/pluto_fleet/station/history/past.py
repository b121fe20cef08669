"""The flights of the past as a station serves them. All of it blocks: ask it apart."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ...shared.domain.errors import BadInput
from ..results.rows import NameOf, nowhere
from .digest import Digest
from .hours import hours_of
from .kept_digests import KeptDigests
from .logbook import Logbook, logbook
from .mcap_file import mcap_of
from .reading import JournalText, found, rehearsal
from .replay import Past
from .report import report_of

if TYPE_CHECKING:
    from ...app import App
    from ..config import StationConfig
    from ..wire import DroneHours, FlightReport, FlightSummary, Replay

DIGESTS_FILE = "flights.json"
"""The file with the digests of all flights, in the station's own folder."""


class PastFlights:
    """The flights of one folder, and its rehearsals."""

    def __init__(
        self,
        app: App,
        config: StationConfig,
        name_of: NameOf = nowhere,
    ) -> None:
        """`name_of` says what a place of the map is called."""
        self._app, self._config, self._name_of = app, config, name_of
        file = config.own_folder / DIGESTS_FILE
        self._digests = KeptDigests(app, config.folder, file)

    def flights(self) -> list[FlightSummary]:
        """Return a line for each flight, the newest first."""
        return [digest.summary for digest in self._digests.all()]

    def hours(self) -> list[DroneHours]:
        """Return what each drone has flown, over all flights."""
        return hours_of(self._digests.all())

    def replay(self, id: str, start: float) -> Replay:
        """Return a part of a flight's replay, or of a rehearsal's; raise `BadInput` if there is none."""
        return self._past(id).part(start)

    def report(self, id: str) -> FlightReport:
        """Return what is to be said of a flight on paper."""
        path, digest = self._digest(id)
        return report_of(
            self._app, JournalText(path), JournalText(path), digest, self._config.own_folder
        )

    def mcap(self, id: str) -> bytes:
        """Return a flight as an MCAP file; raise `BadInput` if that cannot be written here."""
        return mcap_of(self._past(id), self._book(id))

    def console(self, id: str) -> str:
        """Return the console of a flight."""
        return self._book(id).feed.console()

    def results(self, id: str) -> list[object]:
        """Return the results of a flight."""
        return self._book(id).feed.brought()

    def _book(self, id: str) -> Logbook:
        return logbook(self._app, JournalText(found(self._config.folder, id)), self._name_of)

    def _past(self, id: str) -> Past:
        try:
            path, digest = self._digest(id)
        except BadInput:
            rehearsed = rehearsal(self._config.own_folder, id)
            if rehearsed is None:
                raise
            return Past(id=id, app=self._app, read=lambda: rehearsed, summary=None)
        return Past(
            id=id,
            app=self._app,
            read=partial(JournalText, path),
            summary=digest.summary,
            name_of=self._name_of,
        )

    def _digest(self, id: str) -> tuple[Path, Digest]:
        path = found(self._config.folder, id)
        return path, self._digests.of(id, path)
