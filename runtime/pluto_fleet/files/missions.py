"""The missions file: what is to be flown (docs/files.md)."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.alone.files import MISSIONS, read_mission
from ..shared.domain.values import Table
from .areas import trips_of_areas
from .landmarks import NO_LANDMARKS, Landmarks
from .lists import RowTable, each_row
from .promises import misplaced, read_promises
from .reading import Document, read, top

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Mission

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
    tables = [*each_row(top(document, MISSIONS))]
    missions = list[Any]()
    names = dict[str, Table]()
    for index, table in enumerate(tables):
        if isinstance(table, RowTable) and len(document.problems) > MOST_OF_LISTS:
            break  # the same is wrong in row after row
        given = read_mission(table, index, app, airspace, names)
        given["promises"] = read_promises(table)
        if "area" in table.data:
            given["trips"] += trips_of_areas(table, given["trips"], app, airspace)
        missions.append(app.mission(**given))
    for place, said in [] if document.problems else misplaced(missions, known):
        tables[place].problem(said, "after")
    document.given = [None if isinstance(one, RowTable) else one.data for one in tables]
    return missions
