"""The missions file: what shall be flown (docs/files.md)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.text import quoted

from . import errors, values
from .app_fields import read_fields
from .reading import Document, read
from .table import Table
from .trips import read_trips

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission


def load_missions(path: Path, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file; raise `BadInput` with everything that is wrong with it."""
    return missions_of(read(path), app, airspace)


def missions_of(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions of a file that was read, as `load_missions` does."""
    missions = read_missions(document, app, airspace)
    document.refuse_if_bad()
    return missions


def read_missions(document: Document, app: App, airspace: Airspace) -> list[Mission[Any]]:
    """Return the missions as far as they can be read; the document has what is wrong with them."""
    top = Table(document, document.data)
    top.only(("mission",), "a missions file")
    names: dict[str, Table] = {}
    missions = [
        _mission(table, index, app, airspace, names)
        for index, table in enumerate(top.tables("mission", "mission"))
    ]
    if document.data.get("mission", []) == []:
        top.problem(errors.none_given("mission"))
    return missions


def _mission(
    table: Table, index: int, app: App, airspace: Airspace, names: dict[str, Table]
) -> Mission[Any]:
    table.who = f"mission {index + 1}"
    name = table.read("name", values.name) or str(index + 1)
    table.who = f"mission {quoted(name)}"
    other = names.setdefault(name, table)
    if other is not table:
        table.problem(errors.not_unique("mission", name, other.line("name")), "name")
    given = read_fields(table, app, Entity.MISSION, ("name", "trip"))
    trips = read_trips(table, app, airspace)
    return app.mission(name=name, trips=trips, index=index, **given)
