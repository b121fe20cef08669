"""The results of any flight of the station's folder, as its journal has them."""

from __future__ import annotations

from collections import OrderedDict
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...files.origin import read_plane
from ...files.reading import PlanTable, parsed
from ...journal.place import ENDING, written
from ...journal.reader import Reader
from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from .meaning import SIMULATED_UNITS, Meanings
from .rows import NameOf, ResultRows, nowhere

if TYPE_CHECKING:
    from ...app import App
    from ...geodesy import LocalPlane
    from ..wire import Result

KEPT = 3
"""The flights whose results are kept in memory; others are read again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Brought:
    """A result with the wall time at which it was written down, and its value in full."""

    result: Result
    wall: float
    """Seconds since 1970."""
    value: Any


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightResults:
    """All results of a flight."""

    flight: str
    """The journal's name without its ending."""
    journal: Path
    rows: tuple[Brought, ...]
    pictures: dict[int, str]
    """The files of photos, as their cameras named them, by the numbers of their results."""
    plane: LocalPlane | None = None
    """Where its map lies on the Earth, if it says so."""


class ResultsOfFlights:
    """Reads the results of flights from the journals of a folder."""

    def __init__(self, app: App, folder: Path, name_of: NameOf = nowhere) -> None:
        self._app, self._folder, self._name_of = app, folder, name_of
        self._known: OrderedDict[str, tuple[int, FlightResults]] = OrderedDict()

    @property
    def app(self) -> str:
        """The name of the app that has flown them."""
        return self._app.name

    def journal(self, flight: str) -> Path:
        """Return a flight's journal; raise `BadInput` if the folder has none of that name."""
        for path in self._folder.glob(f"*{ENDING}"):  # no path is ever made of a request
            if path.stem == flight and path.is_file():
                return path
        raise BadInput(f"there is no flight {quoted(flight)} here")

    def of(self, flight: str) -> FlightResults:
        """Return the results of a flight, read anew if its journal was written since; may take a while."""
        journal = self.journal(flight)
        at = written(journal)
        known = self._known.get(flight)
        if known is None or known[0] != at:
            known = at, self._read(journal)
        self._known[flight] = known
        self._known.move_to_end(flight)
        while len(self._known) > KEPT:
            self._known.popitem(last=False)
        return known[1]

    def _read(self, journal: Path) -> FlightResults:
        found = list[Brought]()
        rows = self._rows(journal.stem, sim=False)
        plane = None
        with closing(Reader(journal)) as reader:
            for instant, event in reader.events():
                if event["event"] == "journal.begun":
                    if event.get("app") != self._app.name:
                        raise BadInput(f"flight {quoted(journal.stem)} is of another app")
                    rows = self._rows(journal.stem, sim=bool(event.get("sim")))
                    plane = _plane_in(event.get("fleet"))
                brought = rows.take(event)
                if brought is not None:
                    result, value = brought
                    if result["number"] <= len(found):
                        continue  # the same row, which says more now
                    found.append(Brought(result=result, wall=instant.wall, value=value))
        return FlightResults(
            flight=journal.stem,
            journal=journal,
            rows=tuple(found),
            pictures=rows.pictures,
            plane=plane,
        )

    def _rows(self, flight: str, *, sim: bool) -> ResultRows:
        units = SIMULATED_UNITS if sim else {}
        meanings = Meanings(self._app.results, self._app.actions, units)
        return ResultRows(flight, self._app.actions, meanings, self._name_of)


def _plane_in(fleet: object) -> LocalPlane | None:
    """Return where the map of a fleet file's text lies, which its journal has kept."""
    if not isinstance(fleet, str):  # it was flown without one
        return None
    with suppress(BadInput):
        document = parsed("", fleet)
        return read_plane(PlanTable(document, document.data).table("map"))
    return None
