"""The map that users draw on, shared by all pages and kept in the fleet file itself; and the ways over it."""

from __future__ import annotations

import asyncio
import os
import stat
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from itertools import chain
from math import dist, inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...files.areas import OF_LANES, read_lanes
from ...files.drawings.feature import Unusable
from ...files.drawn_map import landmarks_with
from ...files.landmarks import KEYS, NO_LANDMARKS, Landmarks, Picture, read_landmarks
from ...files.reading import Document, PlanTable, decoded, parsed, text_of
from ...files.writing import landmark_tables, with_landmarks
from ...process.whole_file import write_whole
from ...shared.alone.files import read_map
from ...shared.domain import values
from ...shared.domain.airspace import EPSILON, distance, inside
from ...shared.domain.errors import BadInput, PlutoError
from ...shared.domain.text import counted, printable
from ...shared.fleet.reach import flight_seconds
from .pictures import floor_plan, safe_name

if TYPE_CHECKING:
    from ...app import App
    from ...files.lines import Line
    from ...shared.domain.airspace import Airspace, Corner, Polygon
    from ...shared.domain.model import Point
    from ..wire import MapData, Place, Plane, Swept, SweptTrip, Ways, Zone
    from ..wire import Picture as PictureData


class DrawnWays:
    """Answers one question after another in a thread, as each may take seconds."""

    def __init__(self, app: App, airspace: Airspace) -> None:
        self._app = app
        self._airspace = replace(airspace)  # its cache of routes must not be shared by threads
        self._one_at_a_time = asyncio.Lock()

    async def ways(self, pairs: list[list[Any]]) -> Ways:
        """Return the shortest permitted ways: of each pair [from, to] of places [x, y] or [x, y, z].

        A place without z is at the cruise height. Raises `BadInput`.
        """
        read = [self._pair(one, number) for number, one in enumerate(pairs, 1)]
        async with self._one_at_a_time:
            return await asyncio.to_thread(self._find, read)

    async def sweep(self, area: dict[str, object]) -> Swept:
        """Return the trips of an area: those that `[[mission.area]]` of a missions file has.

        `area` has what stands there, but for fields, and may have `before`, the place from which the drones come.
        Raises `BadInput` with all that is wrong.
        """
        async with self._one_at_a_time:
            return await asyncio.to_thread(self._sweep, area)

    def _find(self, pairs: list[tuple[Point, Point]]) -> Ways:
        found: list[list[list[float]] | None] = []
        for start, end in pairs:
            route = self._airspace.route(start, end)
            found.append(None if route is None else [_rounded([*one]) for one in (start, *route)])
        return {"ways": found}

    def _pair(self, given: list[Any], number: int) -> tuple[Point, Point]:
        if len(given) != 2:
            raise BadInput(f"way {number} is no pair of places")
        return self._point(given[0], f"way {number}"), self._point(given[1], f"way {number}")

    def _point(self, given: object, who: str) -> Point:
        try:
            x, y, *height = values.point(given)
        except ValueError as error:
            raise BadInput(f"{who}: {values.shown(given)} {error}") from None
        return x, y, height[0] if height else self._airspace.cruise_height

    def _sweep(self, area: dict[str, object]) -> Swept:
        before = area.pop("before", None)
        come = None if before is None else self._point(before, "before")
        document = Document("", {"area": area})
        table = PlanTable(document, area, ("area",), "the area")
        table.read({"polygon": None}, dict.fromkeys(("action", *OF_LANES)))
        lanes = read_lanes(table, self._app, self._airspace, come)
        document.refuse_if_bad()
        [made] = document.areas
        lines = [line for lane in lanes for line in lane]
        return {
            "trips": [_swept(line) for line in lines],
            "places": made.places,
            "metres": made.metres,
            "outside": made.outside,
            "seconds": self._seconds(lines, str(area.get("action", ""))),
            "forbidden": made.forbidden,
        }

    def _seconds(self, lines: Sequence[Line], action: str) -> float | None:
        """Return how long the fastest drone takes from the first place to the last, with what it does there."""
        if action not in self._app.actions:
            return None
        kinds = [kind for kind in self._app.categories if kind.can(action)]
        busy = self._app.actions[action].lasts({}) * len(lines)
        ends = [(one.start, one.end) if one.places > 1 else (one.end,) for one in lines]
        first, *others = chain.from_iterable(ends)
        times = (flight_seconds(kind, self._airspace, first, others, busy) for kind in kinds)
        return min((one for one in times if one < inf), default=None)


def _swept(line: Line) -> SweptTrip:
    if line.places == 1:
        return {"target": [*line.end], "source": None, "every": None}
    return {"target": [*line.end], "source": [*line.start], "every": round(line.every, 3)}


NEAR = 0.5
"""Metres within which a point is at a named place."""


def name_of(landmarks: Landmarks, point: Sequence[float]) -> str | None:
    """Return the name of the nearest place within half a metre, else of the smallest zone around a point.

    The edge of a zone belongs to it; heights do not count. None: the point has no name.
    """
    x, y = point[:2]
    near = [(dist(one.at[:2], (x, y)), one.name) for one in landmarks.places]
    metres, name = min(near, default=(NEAR + 1.0, ""))
    if metres <= NEAR:
        return name
    around = [zone for zone in landmarks.zones if _contains(zone.corners, (x, y))]
    smallest = min(around, key=lambda zone: _ground(zone.corners), default=None)
    return None if smallest is None else smallest.name


def _contains(corners: Polygon, point: Corner) -> bool:
    edges = zip(corners, (*corners[1:], corners[0]), strict=True)
    return inside(point, corners) or any(distance(point, a, b) <= EPSILON for a, b in edges)


def _ground(corners: Polygon) -> float:
    """Return how much ground a polygon covers, in square metres."""
    edges = zip(corners, (*corners[1:], corners[0]), strict=True)
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges)) / 2


_DIGITS = 3
"""What is drawn is kept to a millimetre, and to a thousandth of a degree."""


def places_of(landmarks: Landmarks) -> list[Place]:
    """Return the named places for pages."""
    found: list[Place] = []
    for one in landmarks.places:
        x, y, *height = one.at
        place: Place = {"name": one.name, "x": x, "y": y}
        found.append({**place, "z": height[0]} if height else place)
    return found


def zones_of(landmarks: Landmarks) -> list[Zone]:
    """Return the zones for pages."""
    return [
        {"name": one.name, "corners": [[x, y] for x, y in one.corners]} for one in landmarks.zones
    ]


def plane_of(landmarks: Landmarks) -> Plane | None:
    """Return where the map lies on the Earth for pages."""
    if landmarks.plane is None:
        return None
    return {
        "latitude": landmarks.plane.latitude,
        "longitude": landmarks.plane.longitude,
        "altitude": landmarks.plane.altitude,
        "bearing": landmarks.plane.bearing,
    }


def picture_of(picture: Picture, address: str) -> PictureData:
    """Return where the floor plan lies for pages."""
    x, y = picture.at
    width, height = picture.size
    return {
        "address": address,
        "x": x,
        "y": y,
        "width": width,
        "height": height,
        "turn": picture.turn,
    }


def landmarks_from(given: Mapping[str, Any], was: Landmarks, airspace: Airspace) -> Landmarks:
    """Return what a page has drawn; what it does not send stays. Raises `BadInput` with all that is wrong."""
    data: dict[str, object] = {"north": was.north, **landmark_tables(was)}
    if given.get("places") is not None:
        data["places"] = [_place(one) for one in given["places"]]
    if given.get("zones") is not None:
        data["zones"] = _rounded(given["zones"])
    if "north" in given:
        data["north"] = _rounded(given["north"])
    if given.get("image") is not None:
        data["image"] = _image(given["image"], was.picture)
    document = Document("", {"map": data})
    landmarks = read_landmarks(PlanTable(document, data, ("map",), "the map"), airspace)
    document.refuse_if_bad()
    picture = landmarks.picture if "image" in given else was.picture
    return replace(landmarks, picture=picture, plane=was.plane)


def _place(given: Mapping[str, Any]) -> object:
    """Return a place as in a file."""
    at = [given[key] for key in ("x", "y") if key in given]
    at += [given["z"]] if given.get("z") is not None else []
    rest = {key: value for key, value in given.items() if key not in ("x", "y", "z")}
    return {**rest, "at": _rounded(at)}


def _image(given: Mapping[str, Any], known: Picture | None) -> dict[str, object]:
    """Return the floor plan as in a file: a page says where it lies, and not which it is."""
    if known is None:
        raise BadInput("the map has no floor plan yet: send its picture first")
    x, y, width, height = (given.get(key) for key in ("x", "y", "width", "height"))
    of_file = {"at": [x, y], "size": [width, height], "turn": given.get("turn", 0.0)}
    return {"file": known.file, **{key: _rounded(value) for key, value in of_file.items()}}


def _rounded(given: Any) -> Any:
    match given:
        case float():
            return round(given, _DIGITS) + 0.0
        case list():
            return [_rounded(one) for one in given]
        case dict():
            return {key: _rounded(one) for key, one in given.items()}
        case _:
            return given


_MARK = "\ufeff".encode()
"""What some editors put before the text."""


class MapFile:
    """A fleet file, or one with a `[map]` alone."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._text: str | None = None
        self.landmarks = NO_LANDMARKS
        """Those of the file when it was read last."""

    @property
    def folder(self) -> Path:
        """Where it lies, and pictures beside it."""
        return self.path.parent

    def read(self) -> bool:
        """Read it; return whether its landmarks have changed. Raises `BadInput` if it cannot be read."""
        text = text_of(self.path) if os.path.lexists(self.path) else None
        if text == self._text:
            return False
        if text is None:
            raise BadInput(f"{self._called} is not there any more: put it back first")
        _, found, _ = self._content(text)
        self._text = text
        before = self.landmarks
        self.landmarks = found
        return found != before

    @property
    def why_not(self) -> str:
        """Why it cannot be written; empty: it can."""
        target = self._target
        may = os.access(target.parent, os.W_OK | os.X_OK)
        if target.exists():
            may = may and os.access(target, os.W_OK)
        return "" if may else f"{self._called} may only be read: nothing is kept that is drawn"

    def write(self, landmarks: Landmarks) -> None:
        """Write other landmarks into it; raise `BadInput` if that cannot be done, and nothing changes then."""
        if self.why_not:
            raise BadInput(self.why_not)
        text = self._text or ""
        airspace, _, rest = self._content(text)
        size = airspace.size
        written = with_landmarks(text, self.landmarks, landmarks, size)
        flown, found, still = self._content(written)
        if (flown, still) != (airspace, rest) or _sorted(found) != _sorted(landmarks):
            raise BadInput(
                f"{self._called} is written so that what is drawn cannot be put into it without changing"
                " more: write [map], and below it [[map.places]] and [[map.zones]]"
            )
        target = self._target
        try:
            mode = stat.S_IMODE(target.stat().st_mode) if target.exists() else 0o644
            begins = target.read_bytes()[: len(_MARK)] if target.exists() else b""
            written_as = (_MARK if begins == _MARK else b"") + written.encode()
            write_whole(target, written_as, mode=mode, durable=True)
        except OSError as error:
            raise BadInput(f"{self._called} cannot be written: {error.strerror or error}") from None
        self._text = written
        self.landmarks = found

    @property
    def _called(self) -> str:
        return printable(str(self.path))

    @property
    def _target(self) -> Path:
        """The file itself, where the path is a link to it."""
        return Path(os.path.realpath(self.path))

    def _content(self, text: str) -> tuple[Airspace, Landmarks, Any]:
        """Return a text's map, its landmarks, and all else in it."""
        document = parsed(self._called, text)
        table = PlanTable(document, document.data).table("map")
        airspace = read_map(table)
        landmarks = read_landmarks(table, airspace)
        document.refuse_if_bad()
        assert airspace is not None  # else there was a problem
        of_map: Any = document.data.get("map", {})
        rest = {key: value for key, value in of_map.items() if key not in KEYS}
        return airspace, landmarks, {**document.data, "map": rest}


def _sorted(landmarks: Landmarks) -> object:
    """Return landmarks to be compared: what is there already keeps its order in a file."""
    return (
        set(landmarks.places),
        set(landmarks.zones),
        landmarks.north,
        landmarks.picture,
    )


WITHOUT_A_FLEET_FILE = "map.toml"
"""The file of landmarks where there is no fleet file, in the station's own folder."""

ADDRESS = "/map"


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
        self._said = ""
        """What the last drawing has brought."""
        self.changed: Callable[[], object] = _ignore
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
            "plane": plane_of(self.landmarks),
            "image": picture_of(picture, self.address) if picture and shown else None,
            "writable": not why_not,
            "said": why_not or self._said,
        }

    @property
    def address(self) -> str:
        """The address of the floor plan, another for each picture."""
        return f"{ADDRESS}?v={sha256(str(self.image).encode()).hexdigest()[:12]}"

    def name_of(self, point: Sequence[float]) -> str | None:
        """Return what a point is called: by the nearest named place, or the zone that it is in."""
        return name_of(self.landmarks, point)

    async def change(self, revision: int, given: Mapping[str, Any]) -> None:
        """Take what a page has drawn; what it does not send stays.

        Raises `StaleMap` if that was drawn on an old map, be it that the file was changed by hand
        meanwhile, and `BadInput` if it is no map, or cannot be kept.
        """
        async with self._one_at_a_time:
            await self._check_current(revision)
            await self._keep(landmarks_from(given, self.landmarks, self._airspace))
            self._said = ""

    async def take_picture(self, revision: int, name: str, content: bytes) -> None:
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
                    await asyncio.to_thread(write_whole, place, content, mode=0o644, durable=True)
                picture = Picture(file=place.name, size=self._airspace.size)
                await self._keep(replace(self.landmarks, picture=picture))
            except BadInput:
                if is_new:
                    place.unlink(missing_ok=True)
                raise
            except OSError as error:
                why = error.strerror or error
                raise BadInput(f"the floor plan cannot be kept: {why}") from None

    async def take_drawing(self, revision: int, name: str, content: bytes) -> None:
        """Take the places and zones of another program's drawing; `said` is then what that was.

        Raises as `change` does, also for a file that is no such drawing.
        """
        async with self._one_at_a_time:
            await self._check_current(revision)
            landmarks, said = await asyncio.to_thread(_drawn_onto, self.landmarks, name, content)
            await self._keep(landmarks)
            self._said = said

    async def _check_current(self, revision: int) -> None:
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


def _drawn_onto(landmarks: Landmarks, name: str, content: bytes) -> tuple[Landmarks, str]:
    """Return landmarks with those of a drawing, and what that was, in lines."""
    drawing = parsed(name, decoded(content, name)).drawing
    if drawing is None:
        raise BadInput(
            f"{name}: is a plan of Pluto, and here a drawing of another program is wanted"
        )
    try:
        changed, taken = landmarks_with(landmarks, drawing)
    except Unusable as error:
        raise BadInput(f"{name}: {error}") from None
    notes = [*taken.notes]
    if taken.no_fly:
        count = len(taken.no_fly)
        areas = f"{counted(count, 'no-fly area')} {'is' if count == 1 else 'are'} left out"
        notes.append(
            f"{areas}: put into the fleet file by pluto-fleet map, before a station begins"
        )
        taken.no_fly.clear()
    return changed, values.shortened([f"{name}: {taken.sentence}", *notes])


def _ignore() -> None:
    """Do nothing: no callback is set."""
