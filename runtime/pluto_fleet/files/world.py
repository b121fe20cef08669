"""What a simulation makes the drones see: `[world]`, which real flights ignore."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.fleet_data import Feature, Source, WorldData
from plutoc_runtime.domain.quantities import Type

from . import values
from .limits import RADIUS

if TYPE_CHECKING:
    from .table import Table


def read_world(top: Table) -> WorldData | None:
    """Return the world that the file describes, if it does."""
    table = top.table("world")
    if table is None:
        return None
    table.only(("background", "feature", "source"), "[world]")
    features = [_feature(entry) for entry in table.tables("feature", "world.feature")]
    sources = [_source(entry) for entry in table.tables("source", "world.source")]
    return WorldData(
        features=tuple(feature for feature in features if feature is not None),
        sources=tuple(source for source in sources if source is not None),
        background=_background(table),
    )


def _background(table: Table) -> dict[str, float]:
    given = table.table("background")
    if given is None:
        return {}
    read = {quantity: given.read(quantity, values.real) for quantity in given.data}
    return {quantity: value for quantity, value in read.items() if value is not None}


def _feature(entry: Table) -> Feature | None:
    entry.who = "[[world.feature]]"
    entry.only(("kind", "at", "radius"), "a feature")
    kind = entry.read("kind", values.name, required=True)
    at = entry.read("at", values.corner, required=True)
    if "radius" not in entry.data:
        return None if kind is None or at is None else Feature(kind=kind, at=at)
    radius = entry.read("radius", partial(values.quantity, kind=Type.LENGTH, limit=RADIUS))
    if kind is None or at is None or radius is None:
        return None
    return Feature(kind=kind, at=at, radius=radius)


def _source(entry: Table) -> Source | None:
    entry.who = "[[world.source]]"
    entry.only(("quantity", "at", "peak", "radius"), "a source")
    quantity = entry.read("quantity", values.name, required=True)
    at = entry.read("at", values.corner, required=True)
    peak = entry.read("peak", values.real, required=True)
    radius = entry.read(
        "radius", partial(values.quantity, kind=Type.LENGTH, limit=RADIUS), required=True
    )
    if quantity is None or at is None or peak is None or radius is None:
        return None
    return Source(quantity=quantity, at=at, peak=peak, radius=radius)
