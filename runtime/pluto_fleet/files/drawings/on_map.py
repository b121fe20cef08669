"""From degrees to the metres of a map."""

from __future__ import annotations

from contextlib import suppress

from ...geodesy import LocalPlane
from .feature import Spot, Unusable


def metres_of(plane: LocalPlane, spot: Spot, who: str) -> list[float]:
    """Return [x, y] of a spot on a map, or [x, y, z] if it says how high it is; raise `Unusable` if it is off it."""
    above = plane.altitude + (spot.height or 0.0)
    altitude = above if spot.altitude is None else spot.altitude
    try:
        x, y, z = plane.to_metres((spot.latitude, spot.longitude, altitude))
    except ValueError as error:
        raise Unusable(f"{who} {error}{_advice(plane, spot)}") from None
    has_height = (spot.height, spot.altitude) != (None, None)
    return [_tidy(one) for one in ((x, y, z) if has_height else (x, y))]


def _tidy(metres: float) -> float:
    """Round to a tenth of a millimetre, so that files stay legible."""
    return round(metres, 4) + 0.0


def _advice(plane: LocalPlane, spot: Spot) -> str:
    with suppress(ValueError):
        plane.to_metres((spot.longitude, spot.latitude, plane.altitude))
        return "; its latitude and longitude are the wrong way round"
    return "; `pluto-fleet map` makes a fleet file whose map lies there"
