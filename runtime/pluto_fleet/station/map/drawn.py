"""The map that users draw on: shared by all pages, and kept in the fleet file itself."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from ...files.landmarks import Picture
from ...shared.domain.errors import BadInput, PlutoError
from ..places import name_of
from ..whole_file import write_whole
from .file import MapFile
from .pictures import floor_plan, safe_name
from .shapes import landmarks_from, picture_of, places_of, zones_of

if TYPE_CHECKING:
    from ...files.landmarks import Landmarks
    from ...shared.domain.airspace import Airspace
    from ..wire import MapData

WITHOUT_A_FLEET_FILE = "map.toml"
"""The file of landmarks where there is no fleet file, in the station's own folder."""

ADDRESS = "/map"
"""The address of the floor plan."""


class StaleMap(PlutoError):
    """The map has changed since: the change was made on an old revision."""


class DrawnMap:
    """The landmarks of a station's map.

    None of them changes how drones fly, so they may be changed while any do.
    """

    def __init__(
        self, airspace: Airspace, file: Path, now: Callable[[], float] = time.time
    ) -> None:
        """`airspace` is the map that is flown on, `file` the fleet file. Raises `BadInput` if that is wrong."""
        self._airspace, self._file = airspace, MapFile(file)
        self.revision = round(now() * 1000)  # from the clock: after a restart it is another
        self.image: Path | None = None
        """The floor plan."""
        self.changed: Callable[[], object] = _ignore
        """Called after each change."""
        self._one_at_a_time = asyncio.Lock()
        self._file.read()
        self._find_image()

    @property
    def landmarks(self) -> Landmarks:
        """All that is drawn."""
        return self._file.landmarks

    def data(self) -> MapData:
        """Return the map for pages."""
        picture, why_not = self.landmarks.picture, self._file.why_not
        shown = picture is not None and self.image is not None
        return {
            "revision": self.revision,
            "places": places_of(self.landmarks),
            "zones": zones_of(self.landmarks),
            "north": self.landmarks.north,
            "image": picture_of(picture, self.address) if picture and shown else None,
            "writable": not why_not,
            "said": why_not,
        }

    @property
    def address(self) -> str:
        """The address of the floor plan, another for each picture."""
        return f"{ADDRESS}?v={sha256(str(self.image).encode()).hexdigest()[:12]}"

    def name_of(self, point: Sequence[float]) -> str | None:
        """Return what a point is called: by the nearest named place, or the zone that it is in."""
        return name_of(self.landmarks, point)

    async def change(self, revision: object, given: Mapping[str, object]) -> None:
        """Take what a page has drawn; what it does not send stays.

        Raises `StaleMap` if that was drawn on an old map, be it that the file was changed by hand
        meanwhile, and `BadInput` if it is no map, or cannot be kept.
        """
        async with self._one_at_a_time:
            await self._check_current(revision)
            await self._keep(landmarks_from(given, self.landmarks, self._airspace))

    async def take_picture(self, revision: object, name: str, content: bytes) -> None:
        """Take a picture as the floor plan, as large as the map until it is laid where it belongs.

        It is kept beside the file, under a name of its own. Raises as `change` does.
        """
        async with self._one_at_a_time:
            await self._check_current(revision)
            if self._file.why_not:
                raise BadInput(self._file.why_not)
            place = self._file.folder / await asyncio.to_thread(safe_name, name, content)
            is_new = not place.exists()
            try:
                if is_new:
                    await asyncio.to_thread(write_whole, place, content, 0o644)
                picture = Picture(file=place.name, size=self._airspace.size)
                await self._keep(replace(self.landmarks, picture=picture))
            except BadInput:
                if is_new:
                    place.unlink(missing_ok=True)
                raise
            except OSError as error:
                why = error.strerror or error
                raise BadInput(f"the floor plan cannot be kept: {why}") from None

    async def _check_current(self, revision: object) -> None:
        if await asyncio.to_thread(self._file.read):
            self._announce()
        if revision != self.revision:
            raise StaleMap(f"the map has been changed meanwhile: it is at {self.revision}")

    async def _keep(self, landmarks: Landmarks) -> None:
        if landmarks != self.landmarks:
            await asyncio.to_thread(self._file.write, landmarks)
            self._announce()

    def _announce(self) -> None:
        self.revision += 1
        self._find_image()
        self.changed()

    def _find_image(self) -> None:
        picture, self.image = self.landmarks.picture, None
        if picture is not None:
            with suppress(
                BadInput
            ):  # it was taken away: a station begins only with one that is there
                self.image = floor_plan(self._file.folder, picture.file)


def _ignore() -> None:
    """Do nothing: no callback is set."""
