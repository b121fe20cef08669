"""Writing a fleet file with the drones that answer: a draft, to be checked before anything flies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import cycle
from math import dist
from pathlib import Path
from typing import TYPE_CHECKING

from ..files.fleet import APART, CRAZYFLIE, fleet_of
from ..files.reading import parsed
from ..files.toml import toml_value
from ..shared import output
from ..shared.domain.airspace import Airspace
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number, place, printable
from .drone_status import heard
from .written import write_new

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Corner
    from .drone_status import DroneAnswer


_ORIGIN = 0.05
"""Metres from (0, 0): a drone that reports to be so near has just been switched on, and has no fix."""


def write_fleet(app: App, path: Path, told: Sequence[DroneAnswer], navigation: str | None) -> None:
    """Write a fleet file of the drones that have answered; never overwrites a file."""
    there = [answer for answer in told if heard(answer) is not None]
    if not there:
        raise BadInput(f"{path}: not written, for no drone has answered")
    content = "\n".join(_file(app, path, there, navigation or CRAZYFLIE)) + "\n"
    fleet_of(parsed(str(path), content), app)  # check that it is valid
    write_new(path, content, "the fleet")
    output.tell(f"{path}: {counted(len(there), 'drone')}; look at each home before anything flies")


def _file(app: App, path: Path, there: Sequence[DroneAnswer], navigation: str) -> Iterator[str]:
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
    for index, (answer, category) in enumerate(zip(there, categories, strict=False), start=1):
        yield ""
        yield "[[drone]]"
        yield f'id = "cf{index}"'
        yield f"category = {toml_value(category)}{_choice(app)}"
        yield _home(answer, airspace, taken)
        if answer.asked.uri is not None:
            yield f"uri = {toml_value(answer.asked.uri)}"


def _choice(app: App) -> str:
    names = [category.name for category in app.categories]
    return f"  # one of: {', '.join(names)}" if len(names) > 1 else ""


def _home(answer: DroneAnswer, airspace: Airspace, taken: list[Corner]) -> str:
    """Return the line of a drone's home: its reported position, or the next free place of a row."""

    def is_free(spot: Corner) -> bool:
        apart = all(dist(spot, other) >= APART for other in taken)
        return apart and airspace.problem((*spot, 0.0)) is None

    telemetry = heard(answer)
    x, y, _ = telemetry.position if telemetry is not None else (0.0, 0.0, 0.0)
    said = round(x, 2) + 0.0, round(y, 2) + 0.0
    if dist(said, (0.0, 0.0)) > _ORIGIN and is_free(said):
        taken.append(said)
        return f"home = {toml_value([*said])}  # where it stood"
    width, depth = airspace.size
    row = ((float(x), y + 0.5) for y in range(int(depth)) for x in range(1, int(width)))
    free = next(filter(is_free, row))
    taken.append(free)
    return f"home = {toml_value([*free])}  # put it there: it said {place((*said, 0.0))}"
