"""The missions file: what is to be flown (docs/files.md)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from datetime import date, time
from graphlib import CycleError, TopologicalSorter
from itertools import chain
from pathlib import Path
from typing import Any

from ..app import App
from ..shared.alone.files import MISSIONS, read_mission
from ..shared.domain.airspace import Airspace
from ..shared.domain.fields import time_of_day
from ..shared.domain.model import Mission
from ..shared.domain.quantities import Type
from ..shared.domain.text import quoted
from ..shared.domain.values import LARGEST, Quantity, Read, Table
from .areas import is_side_by_side, trips_of_areas
from .landmarks import NO_LANDMARKS, Landmarks
from .lists import RowTable, each_row
from .reading import Document, PlanTable, near, read, top

MOST_OF_LISTS = 1_000
"""After so many problems no further row of a list is read."""


def load_missions(
    path: Path, app: App, airspace: Airspace, landmarks: Landmarks = NO_LANDMARKS
) -> list[Mission[Any]]:
    """Return the missions of a file; raise `BadInput` with everything that is wrong with it.

    `landmarks` are the places and zones that it may name.
    """
    document = read(path)
    document.landmarks = landmarks
    return missions_of(document, app, airspace)


def missions_of(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file that was read, as `load_missions` does."""
    missions = read_missions(document, app, airspace)
    document.refuse_if_bad()
    return missions


def read_missions(
    document: Document, app: App, airspace: Airspace, known: Collection[str] = ()
) -> list[Mission[Any]]:
    """Return the missions as far as they are valid; the document collects what is wrong.

    `known` are the missions that fly already.
    """
    if document.drawing is not None:
        from .drawn_missions import take_drawing  # most plans are none

        take_drawing(document, app)
    missions = list[Any]()
    tables = list[PlanTable]()
    names = dict[str, Table]()
    for table in [*each_row(top(document, MISSIONS))]:
        if isinstance(table, RowTable) and len(document.problems) > MOST_OF_LISTS:
            break  # the same is wrong in row after row
        for given in _of_table(table, len(missions), app, airspace, names):
            missions.append(app.mission(**given))
            tables.append(table)
    for place, said in [] if document.problems else misplaced(missions, known):
        tables[place].problem(said, "after")
    document.given = [None if isinstance(one, RowTable) else one.data for one in tables]
    return missions


def _of_table(
    table: PlanTable, index: int, app: App, airspace: Airspace, names: dict[str, Table]
) -> Iterable[dict[str, Any]]:
    """Return what the missions of a table are made of: one, or one for each lane of an area."""
    given = read_mission(table, index, app, airspace, names)
    given["promises"] = read_promises(table)
    if "area" not in table.data:
        return [given]
    lanes = trips_of_areas(table, given["trips"], app, airspace)
    if not is_side_by_side(table):
        return [{**given, "trips": [*given["trips"], *chain.from_iterable(lanes)]}]
    found = list[dict[str, Any]]()
    for number, lane in enumerate(lanes):
        name = f"{given['name']} {number + 1}"
        table.differs("name", name, "mission", names)
        found.append({**given, "name": name, "index": index + number, "trips": lane})
    return found


_FROM_START = Quantity(Type.TIME, 0.0, LARGEST)


def moment(value: object) -> float | str:
    """Read a time of day as a text, or how much time from the start on."""
    if isinstance(value, time) or (isinstance(value, str) and ":" in value):
        time_of_day(value)
        return f"{value:%H:%M:%S}" if isinstance(value, time) else value
    try:
        return _FROM_START(value)
    except ValueError as error:
        hint = '; or a time of day, like "08:30"' if isinstance(value, str | date) else ""
        raise ValueError(f"{error}{hint}") from None


def window(value: object) -> tuple[float | str, float | str]:
    """Read when something may begin, and when it is to have ended."""
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError('is not a list of two times, like ["08:00", "08:30"]')
    if value[1] == "":
        raise ValueError("needs an end as well, by which it is due")
    try:
        opens, closes = map(moment, value)
    except ValueError as error:
        raise ValueError(f"has an element that {error}") from None
    if isinstance(opens, str) and isinstance(closes, str):
        none = time_of_day(opens) == time_of_day(closes)
    else:
        none = isinstance(opens, float) and isinstance(closes, float) and closes <= opens
    if none:
        raise ValueError("has no time between its two")
    return opens, closes


def after(value: object) -> list[str]:
    """Read the name of a mission, or of several."""
    names = value if isinstance(value, list) else [value]
    if not all(isinstance(one, str) for one in names):
        raise ValueError('is not a list of missions, like ["Mission 1"]')
    return [*dict.fromkeys(names)]


KEYS: dict[str, Read] = {"deadline": moment, "window": window, "after": after}
"""How a mission's file says what is promised, and how each is read."""


def promised(given: dict[str, Any]) -> Mapping[str, Any]:
    """Take a mission's promises out of what its file gives; raise `ValueError` if they are too many."""
    deadline, window, after = (given.pop(key, None) for key in KEYS)
    if deadline is not None and window is not None:
        raise ValueError("has a deadline and a window, which ends with a deadline: leave out one")
    opens, closes = window or (None, deadline)
    found = {"deadline": closes, "opens": opens, "after": after}
    return {name: value for name, value in found.items() if value not in (None, [])}


def read_promises(table: Table) -> Mapping[str, Any]:
    """Return what is promised of a mission, and note what is wrong with it."""
    given = {key: table.value(key, read) for key, read in KEYS.items() if key in table.data}
    try:
        return promised(given)
    except ValueError as error:
        table.problem(str(error), "window")
        return {}


def misplaced(
    missions: Sequence[Mission[Any]], known: Collection[str]
) -> Iterator[tuple[int, str]]:
    """Yield what is wrong with the order of missions, each with the index of one: no such mission, a circle.

    `known` are missions that were started before.
    """
    places = {mission.name: place for place, mission in enumerate(missions)}
    after = {mission.name: mission.promises.get("after", ()) for mission in missions}
    for name, earlier in after.items():
        for one in earlier:
            if one not in places and one not in known:
                said = f"comes after {quoted(one)}, and there is no such mission"
                yield places[name], said + near(one, places)
    try:
        TopologicalSorter(after).prepare()
    except CycleError as error:
        last, *others = reversed(error.args[1])
        way = ", which comes after ".join(map(quoted, others))
        none = (
            "itself: it can never begin" if others == [last] else f"{way}: none of them can begin"
        )
        yield places[last], f"comes after {none}"
