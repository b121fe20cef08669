"""The map: its bounds, its no-fly areas, and the way around them."""

from __future__ import annotations

from dataclasses import dataclass

from .model import Point

Corner = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Airspace:
    """A rectangle from (0, 0), in metres, less the polygons that no drone may enter."""

    size: tuple[float, float] = (20.0, 20.0)
    cruise_height: float = 1.2
    ceiling: float = 10.0
    no_fly: tuple[tuple[Corner, ...], ...] = ()

    def problem(self, point: Point) -> str | None:
        """Return why a drone may not be at this point, or None."""
        raise NotImplementedError

    def route(self, start: Point, end: Point) -> tuple[Point, ...] | None:
        """Return the shortest permitted way, the end included and the start not, or None."""
        raise NotImplementedError
