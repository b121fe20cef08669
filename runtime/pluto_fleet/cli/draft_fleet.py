"""`drones --save`: a fleet file of the drones that have answered: a draft, to be checked before anything flies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import cycle
from math import dist
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.drawings.feature import Unusable
from ..files.drawn_map import CRUISE, plane_around
from ..files.fleet import APART, CRAZYFLIE, fleet_of
from ..files.reading import parsed
from ..files.toml import toml_value
from ..shared import output
from ..shared.domain.airspace import Airspace
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number, place, printable
from .written import write_new

if TYPE_CHECKING:
    from ..app import App
    from ..geodesy import Degrees
    from ..shared.domain.airspace import Corner
    from ..shared.domain.model import Point

_APART_OUTDOORS = 4.0
"""Metres between drones whose places by satellites are metres off."""
_ORIGIN = 0.05
"""Metres from (0, 0): a drone that reports to be so near has just been switched on, and has no fix."""


@dataclass(frozen=True, slots=True)
class Answered:
    """A drone that has answered."""

    uri: str | None
    position: Point
    degrees: Degrees | None = None
    """Where it stands on the Earth, if it tells that."""


def write_fleet(app: App, path: Path, there: Sequence[Answered], navigation: str | None) -> None:
    """Write a fleet file of the drones that have answered; never overwrites a file."""
    if not there:
        raise BadInput(f"{path}: not written, for no drone has answered")
    places = [one.degrees for one in there if one.degrees is not None]
    if len(places) == len(there):
        lines = _file_on_earth(app, path, there, places)
    else:
        lines = _file(app, path, there, navigation or CRAZYFLIE)
    content = "\n".join(lines) + "\n"
    fleet_of(parsed(str(path), content), app)  # check that it is valid
    write_new(path, content, "the fleet")
    output.tell(f"{path}: {counted(len(there), 'drone')}; look at each home before anything flies")


def _file_on_earth(
    app: App, path: Path, there: Sequence[Answered], places: Sequence[Degrees]
) -> Iterator[str]:
    """Yield the lines of a file whose map is around where the drones stand."""
    try:
        plane, size = plane_around(places)
    except Unusable:
        raise BadInput(f"{path}: not written, for they stand more than 10 km apart") from None
    ground = round(min(altitude for _, _, altitude in places), 1)
    origin = {"latitude": plane.latitude, "longitude": plane.longitude, "altitude": ground}
    yield f"# Written by: {app.name} drones --save {printable(str(path))}"
    yield "# Say below how large the field is, and see whether each drone has its home and category."
    yield ""
    yield "[map]"
    yield f"size = {toml_value(size)}  # metres to the east and the north of its origin"
    yield f"origin = {toml_value(origin)}"
    yield f"cruise_height = {number(CRUISE)}"
    yield f"ceiling = {number(2 * CRUISE)}  # nothing flies higher"
    yield ""
    yield "[motion]"
    yield 'legs = "steady"'
    yield ""
    yield "[fleet]"
    yield 'after_trip = "onward"  # to the next one without a landing'
    yield f"apart = {number(_APART_OUTDOORS)}  # metres"
    categories = cycle(category.name for category in app.categories)
    for index, (one, (latitude, longitude, _), category) in enumerate(
        zip(there, places, categories, strict=False), start=1
    ):
        x, y, _ = plane.to_metres((latitude, longitude, 0.0))
        yield ""
        yield "[[drone]]"
        yield f'id = "m{index}"'
        yield f"category = {toml_value(category)}{_choice(app)}"
        yield f"home = {toml_value([round(x, 1), round(y, 1)])}  # where it stood"
        yield f"uri = {toml_value(one.uri)}"


def _file(app: App, path: Path, there: Sequence[Answered], navigation: str) -> Iterator[str]:
    airspace = Airspace()
    yield f"# Written by: {app.name} drones --save {printable(str(path))}"
    yield "# Say below how large the room is, and see whether each drone has its home and category."
    yield ""
    yield "[map]"
    yield f"size = {toml_value([*airspace.size])}  # metres, from the place where positions are (0, 0)"
    yield f"ceiling = {number(airspace.ceiling)}  # nothing flies higher"
    if navigation != CRAZYFLIE:
        yield ""
        yield "[fleet]"
        yield f"navigation = {toml_value(navigation)}"
    categories = cycle(category.name for category in app.categories)
    taken: list[Corner] = []
    for index, (one, category) in enumerate(zip(there, categories, strict=False), start=1):
        yield ""
        yield "[[drone]]"
        yield f'id = "cf{index}"'
        yield f"category = {toml_value(category)}{_choice(app)}"
        yield _home(one.position, airspace, taken)
        if one.uri is not None:
            yield f"uri = {toml_value(one.uri)}"


def _choice(app: App) -> str:
    names = [category.name for category in app.categories]
    return f"  # one of: {', '.join(names)}" if len(names) > 1 else ""


def _home(position: Point, airspace: Airspace, taken: list[Corner]) -> str:
    """Return the line of a drone's home: its reported position, or the next free place of a row."""

    def is_free(spot: Corner) -> bool:
        apart = all(dist(spot, other) >= APART for other in taken)
        return apart and airspace.problem((*spot, 0.0)) is None

    x, y, _ = position
    said = round(x, 2) + 0.0, round(y, 2) + 0.0
    if dist(said, (0.0, 0.0)) > _ORIGIN and is_free(said):
        taken.append(said)
        return f"home = {toml_value([*said])}  # where it stood"
    width, depth = airspace.size
    row = ((float(x), y + 0.5) for y in range(int(depth)) for x in range(1, int(width)))
    free = next(filter(is_free, row))
    taken.append(free)
    return f"home = {toml_value([*free])}  # put it there: it said {place((*said, 0.0))}"
