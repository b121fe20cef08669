"""The results of the current flight and of earlier ones, as files and pictures for pages."""

from __future__ import annotations

import asyncio
import json
import shutil
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

from ...shared.domain.errors import BadInput
from . import pictures
from .exif import with_place
from .tables import cells, csv_text, geojson, picture_name, place_of

if TYPE_CHECKING:
    from ...geodesy import Degrees
    from ...process.apart import Answers
    from .flights import Brought, FlightResults, ResultsOfFlights

INDEX = "results.csv"
MISSING = "missing.txt"
PLACES = "geo.txt"
"""As OpenDroneMap reads it: the name of a picture, longitude, latitude, altitude."""


def json_text(data: object) -> str:
    """Return data as JSON in ASCII; numbers that JSON lacks become texts."""
    try:
        return json.dumps(data, separators=(",", ":"), allow_nan=False)
    except ValueError:  # a hook returned NaN or infinity
        return json.dumps(_finite(data), separators=(",", ":"), allow_nan=False)


def _finite(data: object) -> object:
    if isinstance(data, float) and not isfinite(data):
        return str(data)
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return data


AT_ONCE = 2
"""The pictures that are read or made small at once, each in a thread."""


class CurrentResults(Protocol):
    """The results of the current flight."""

    @property
    def pictures(self) -> Mapping[int, str]:
        """The files of photos, by the numbers of their results."""

    def brought(self) -> list[object]:
        """Return the newest results, with their values in full."""


class Files(Protocol):
    """The files of flights."""

    @property
    def results(self) -> ResultsOfFlights:
        """The results in them."""


class Place(Protocol):
    """Where a station keeps its files."""

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
        place: Place,
        files: Answers[Files],
        current: Callable[[], CurrentFlight | None],
    ) -> None:
        self._place, self._files, self._current = place, files, current
        self._reading, self._packing = asyncio.Lock(), asyncio.Lock()
        self._cleared = False
        self._pictures = asyncio.Semaphore(AT_ONCE)

    async def results(self, flight: str) -> str:
        """Return the results as JSON: of the current flight the newest, of another one all."""
        now = self._current()
        if now is None and not flight:
            return json_text([])
        if now is not None and flight in ("", now.flight):
            return json_text(now.feed.brought())
        async with self._reading:  # one journal at a time is enough for a station that flies
            return await self._files.ask(_results, flight)

    async def csv(self, flight: str) -> str:
        """Return the table of values."""
        async with self._reading:
            return await self._files.ask(_csv, self._named(flight))

    async def geojson(self, flight: str) -> str:
        """Return the results that have a place, as GeoJSON."""
        async with self._reading:
            return await self._files.ask(_geojson, self._named(flight))

    async def archive(self, flight: str) -> Path:
        """Write an archive of the pictures into a file, which the caller deletes."""
        id = self._named(flight)
        folder = self._place.own_folder / "archives"
        async with self._packing:
            if not self._cleared:  # a station that was killed may have left some
                self._cleared = True
                await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)
            return await self._files.ask(_archive, id, folder)

    async def picture(self, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        """Return the picture of a result and its media type: as it was taken, or a small JPEG."""
        now = self._current()
        cache = self._place.own_folder / "thumbnails" if small else None
        async with self._pictures:
            if now is not None and flight in ("", now.flight):
                return await asyncio.to_thread(pictures.shown, now, number, cache)
            return await self._files.ask(_picture, self._named(flight), number, cache)

    def _named(self, flight: str) -> str:
        """Return the id of a flight: of the current one if none is named."""
        if flight:
            return flight
        if (now := self._current()) is None:
            raise BadInput("nothing has flown yet: name an earlier flight with ?flight=")
        return now.flight


def _results(files: Files, flight: str) -> str:
    return json_text([{**one.result, "value": one.value} for one in files.results.of(flight).rows])


def _csv(files: Files, flight: str) -> str:
    return csv_text(cells(files.results.of(flight)))


def _geojson(files: Files, flight: str) -> str:
    found = files.results.of(flight)
    return json.dumps(geojson(found, files.results.app), ensure_ascii=False)


def _archive(files: Files, flight: str, folder: Path) -> Path:
    return write_archive(files.results.of(flight), folder)


def _picture(files: Files, flight: str, number: int, cache: Path | None) -> tuple[bytes, str]:
    return pictures.shown(files.results.of(flight), number, cache)


def write_archive(flight: FlightResults, folder: Path) -> Path:
    """Write the archive into a new file of a folder, and return it; the caller deletes it.

    It has `results.csv`, whose column `picture` names the files beside it, and `missing.txt` with a
    sentence for each picture that could not be read, if there are any. Of a map that lies on the Earth the photos
    say where they were taken; so does `geo.txt`, for pictures that cannot.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(suffix=".zip", dir=folder)
    missing = []
    taken = {one.result["number"]: one for one in flight.rows}
    places = {number: place for number, one in taken.items() if (place := _camera(flight, one))}
    with open(descriptor, "wb") as file, ZipFile(file, "w", ZIP_STORED) as archive:
        archive.writestr(INDEX, csv_text(cells(flight)), compress_type=ZIP_DEFLATED)
        for number, named in flight.pictures.items():
            try:
                content, _ = pictures.picture(flight, number)
            except BadInput as why:
                missing.append(f"{why}\n")
            else:
                if number in places:
                    one = taken[number]
                    content = with_place(content, places[number], one.wall, _far(one.value))
                archive.writestr(picture_name(number, named), content)
        if places:
            archive.writestr(PLACES, _places_text(flight, places))
        if missing:
            archive.writestr(MISSING, "".join(missing))
    return Path(name)


def _camera(flight: FlightResults, one: Brought) -> Degrees | None:
    """Return where the camera of a photo was on the Earth, if it is known."""
    if one.result["kind"] != "photo" or one.result["number"] not in flight.pictures:
        return None
    return place_of(flight, one.value["position"])


def _far(photo: Mapping[str, Any]) -> float | None:
    """Return how many times as far away a photo was taken as the ground that it shows is wide, if it says so."""
    height = photo["position"][2]
    wide = max(photo["width"], photo["height"])
    return height / wide if height > 0 and wide > 0 else None


def _places_text(flight: FlightResults, places: Mapping[int, Degrees]) -> str:
    lines = [
        f"{picture_name(number, flight.pictures[number])} {longitude:.8f} {latitude:.8f} {altitude:.3f}\n"
        for number, (latitude, longitude, altitude) in places.items()
    ]
    return "".join(["EPSG:4326\n", *lines])
