"""The flights of the past as a station serves them. All of it blocks: ask it apart."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ...shared.domain.errors import BadInput
from ..results.rows import NameOf, nowhere
from .digest import Digest
from .folder import found, recording_of, rehearsal
from .hours import hours_of
from .kept_digests import KeptDigests
from .logbook import Logbook, logbook
from .mcap_file import mcap_of
from .reading import JournalText
from .recorded import Recorded
from .replay import Past
from .report import report_of

if TYPE_CHECKING:
    from ...app import App
    from ..config import StationConfig
    from ..wire import DroneHours, FlightReport, FlightSummary, Replay

DIGESTS_FILE = "flights.json"
"""The file with the digests of all flights, in the station's own folder."""

RECORDINGS_OPEN = 4
"""How many recordings are kept in mind, each by where its keyframes are."""


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
        self._recordings: dict[Path, Recorded] = {}

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
        path = found(self._config.folder, id)
        recorded, _ = self._recorded(recording_of(path))
        said = recorded.said if recorded is not None else ()
        return logbook(self._app, JournalText(path), said, self._name_of)

    def _past(self, id: str) -> Past:
        try:
            path, digest = self._digest(id)
        except BadInput:
            rehearsed = rehearsal(self._config.own_folder, id)
            if rehearsed is None:
                raise
            recorded, trouble = self._recorded(rehearsed)
            if recorded is None:
                raise BadInput(f"the rehearsal cannot be read: {trouble}") from None
            return Past(id=id, app=self._app, read=None, digest=None, recorded=recorded)
        recorded, trouble = self._recorded(recording_of(path))
        return Past(
            id=id,
            app=self._app,
            read=partial(JournalText, path),
            digest=digest,
            recorded=recorded,
            trouble=trouble,
            name_of=self._name_of,
        )

    def _digest(self, id: str) -> tuple[Path, Digest]:
        path = found(self._config.folder, id)
        return path, self._digests.of(id, path)

    def _recorded(self, path: Path) -> tuple[Recorded | None, str]:
        """Return a recording as far as it is written now, and what is wrong with it."""
        try:
            known = self._recordings.pop(path, None)
            if known is None:
                known = Recorded(path)
            else:
                known.refresh()
        except FileNotFoundError:
            return None, ""
        except (OSError, ValueError) as error:
            return None, f"{path}: this recording cannot be read: {error}"
        self._recordings[path] = known
        while len(self._recordings) > RECORDINGS_OPEN:
            del self._recordings[next(iter(self._recordings))]
        return known, ""
