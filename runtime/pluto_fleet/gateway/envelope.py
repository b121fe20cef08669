"""The geofence: a target outside is refused, independently of the brain, and never adjusted."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.text import number
from .traffic.legs import leg_problem
from .traffic.way_back import way_back

if TYPE_CHECKING:
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point


class Envelope:
    """The permitted space: inside the map, outside the no-fly areas, between ground and ceiling."""

    def __init__(self, airspace: Airspace) -> None:
        self._airspace = airspace

    def problem(self, points: Iterable[Point]) -> str | None:
        """Return why no drone may be sent to these points, or None."""
        for point in points:
            problem = self._airspace.problem(point)
            if problem is not None:
                return problem
        return None

    def check(self, target: Point) -> None:
        """Raise `FlightFailed` if no drone may be sent to this point."""
        problem = self._airspace.problem(target)
        if problem is not None:
            raise FlightFailed(Failure.REFUSED, problem)

    def check_height(self, height: float) -> None:
        """Raise `FlightFailed` if a height is outside."""
        ceiling = self._airspace.ceiling
        if not 0 <= height <= ceiling:
            reason = f"{number(height)} m is not between the ground and {number(ceiling)} m"
            raise FlightFailed(Failure.REFUSED, reason)

    def straight(self, start: Point, target: Point) -> tuple[Point, ...]:
        """Return the points of a straight leg; one that has drifted out flies back in first."""
        airspace = self._airspace
        back: tuple[Point, ...] = ()
        if airspace.problem(start) is not None:
            start = way_back(airspace, start)
            back = (start,)
        problem = airspace.problem(target) or leg_problem(airspace, start, target)
        if problem is not None:
            raise FlightFailed(Failure.REFUSED, problem)
        return (*back, target)
