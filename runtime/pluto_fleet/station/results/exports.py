"""The results of the current flight and of earlier ones, as files and pictures for pages."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from ...shared.domain.errors import BadInput
from . import pictures
from .archive import write_archive
from .flights import FlightResults, ResultsOfFlights
from .rows import NameOf, nowhere
from .tables import cells, csv_text, geojson

if TYPE_CHECKING:
    from ...app import App

AT_ONCE = 2
"""The pictures that are read or made small at once, each in a thread."""


class CurrentResults(Protocol):
    """The results of the current flight."""

    @property
    def pictures(self) -> Mapping[int, str]:
        """The files of photos, by the numbers of their results."""

    def brought(self) -> list[object]:
        """Return the newest results, with their values in full."""


class Place(Protocol):
    """Where a station keeps its files."""

    @property
    def folder(self) -> Path:
        """The folder of journals."""

    @property
    def own_folder(self) -> Path:
        """The folder of the station's own files."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CurrentFlight:
    """The flight that a station shows."""

    flight: str
    journal: Path
    feed: CurrentResults

    @property
    def pictures(self) -> Mapping[int, str]:
        """The files of its photos, by the numbers of their results."""
        return self.feed.pictures


class Exports:
    """All that is asked of results. Each call raises `BadInput` with what there is not, in a sentence.

    `flight` is the id of a flight, its journal's name without the ending; empty: the current one.
    """

    def __init__(
        self,
        app: App,
        place: Place,
        current: Callable[[], CurrentFlight | None],
        name_of: NameOf = nowhere,
    ) -> None:
        self._app, self._place, self._current = app, place, current
        self._flights = ResultsOfFlights(app, place.folder, name_of)
        self._reading, self._packing = asyncio.Lock(), asyncio.Lock()
        self._cleared = False
        self._pictures = asyncio.Semaphore(AT_ONCE)

    async def results(self, flight: str) -> list[object]:
        """Return the results as mappings: of the current flight the newest, of another one all."""
        now = self._current()
        if now is None and not flight:
            return []
        if now is not None and flight in ("", now.flight):
            return now.feed.brought()
        found = await self._of(flight)
        return [{**one.result, "value": one.value} for one in found.rows]

    async def csv(self, flight: str) -> str:
        """Return the table of values."""
        found = await self._of(flight)
        return await asyncio.to_thread(lambda: csv_text(cells(found)))

    async def geojson(self, flight: str) -> dict[str, object]:
        """Return the results that have a place, as GeoJSON."""
        found = await self._of(flight)
        return await asyncio.to_thread(geojson, found, self._app.name)

    async def archive(self, flight: str) -> Path:
        """Write an archive of the pictures into a file, which the caller deletes."""
        found = await self._of(flight)
        folder = self._place.own_folder / "archives"
        async with self._packing:
            if not self._cleared:  # a station that was killed may have left some
                self._cleared = True
                await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)
            return await asyncio.to_thread(write_archive, found, folder)

    async def picture(self, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        """Return the picture of a result and its media type: as it was taken, or a small JPEG."""
        now = self._current()
        taken: pictures.Taken
        if now is not None and flight in ("", now.flight):
            taken = now
        else:
            taken = await self._of(flight)
        async with self._pictures:
            if not small:
                return await asyncio.to_thread(pictures.picture, taken, number)
            cache = self._place.own_folder / "thumbnails"
            return await asyncio.to_thread(pictures.small, taken, number, cache), "image/jpeg"

    async def _of(self, flight: str) -> FlightResults:
        """Return the results of a flight, as its journal has them."""
        now = self._current()
        if not flight:
            if now is None:
                raise BadInput("nothing has flown yet: name an earlier flight with ?flight=")
            flight = now.flight
        async with self._reading:  # one journal at a time is enough for a station that flies
            return await asyncio.to_thread(self._flights.of, flight)
