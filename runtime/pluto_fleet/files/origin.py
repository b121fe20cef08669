"""Where a map lies on the Earth: `origin` and `bearing` of a fleet file's `[map]`."""

from __future__ import annotations

from math import degrees, pi

from ..geodesy import LocalPlane
from ..shared.domain.quantities import Type
from ..shared.domain.text import number
from ..shared.domain.values import Keys, Quantity, Table

LATITUDE = Quantity(Type.FLOAT, -90.0, 90.0)
LONGITUDE = Quantity(Type.FLOAT, -180.0, 180.0)
ALTITUDE = Quantity(Type.LENGTH, -500.0, 9_000.0)
"""Of any ground, above sea level."""
BEARING = Quantity(Type.ANGLE, -2 * pi, 2 * pi)


def read_plane(table: Table) -> LocalPlane | None:
    """Return where the map of `[map]` lies on the Earth, if it says so, and note what is wrong with that."""
    if "origin" not in table.data:
        if "bearing" in table.data:
            said = (
                "bearing says how a map lies on the Earth, and it has no origin: say where that is"
            )
            table.problem(said, "bearing")
        return None
    before = len(table.problems)
    needed: Keys = {"latitude": LATITUDE, "longitude": LONGITUDE}
    given = table.table("origin").read(needed, {"altitude": ALTITUDE})
    bearing = table.value("bearing", BEARING) or 0.0
    return LocalPlane(**given, bearing=bearing) if len(table.problems) == before else None


def north_by(table: Table, given: float | None) -> float:
    """Return by how many degrees north is turned from up, clockwise: as is given, or by the map's bearing."""
    if "origin" not in table.data:
        return given or 0.0
    try:
        bearing = BEARING(table.data.get("bearing", 0.0))
    except ValueError:  # which is told where it is read
        bearing = 0.0
    north = round(-degrees(bearing), 9) + 0.0
    if given is not None and abs(given - north) % 360 > 0.001:
        said = f"north is turned by {number(north)} degrees, by the map's bearing: leave it out"
        table.problem(said, "north")
    return north
