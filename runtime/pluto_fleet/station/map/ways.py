"""The ways that drones take around no-fly areas, and the places of an area, for pages that draw them."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...files.areas import read_places
from ...files.reading import Document, PlanTable
from ...shared.domain import values
from ...shared.domain.errors import BadInput

if TYPE_CHECKING:
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Point
    from ..wire import Swept, Ways

_DIGITS = 3


class DrawnWays:
    """Answers one question after another in a thread, as each may take seconds."""

    def __init__(self, airspace: Airspace) -> None:
        self._airspace = replace(airspace)  # its cache of routes must not be shared by threads
        self._one_at_a_time = asyncio.Lock()

    async def ways(self, pairs: list[list[Any]]) -> Ways:
        """Return the shortest permitted ways: of each pair [from, to] of places [x, y] or [x, y, z].

        A place without z is at the cruise height. Raises `BadInput`.
        """
        read = [self._pair(one, number) for number, one in enumerate(pairs, 1)]
        async with self._one_at_a_time:
            return await asyncio.to_thread(self._find, read)

    async def sweep(self, area: dict[str, object]) -> Swept:
        """Return the targets of an area's trips: those that `[[mission.area]]` of a missions file has.

        `area` has its `polygon` and `spacing`, and may have a `height`, and `before`, the place from which
        the drones come. Raises `BadInput` with all that is wrong.
        """
        async with self._one_at_a_time:
            return await asyncio.to_thread(self._sweep, area)

    def _find(self, pairs: list[tuple[Point, Point]]) -> Ways:
        found: list[list[list[float]] | None] = []
        for start, end in pairs:
            route = self._airspace.route(start, end)
            found.append(None if route is None else [_rounded(one) for one in (start, *route)])
        return {"ways": found}

    def _pair(self, given: list[Any], number: int) -> tuple[Point, Point]:
        if len(given) != 2:
            raise BadInput(f"way {number} is no pair of places")
        return self._point(given[0], f"way {number}"), self._point(given[1], f"way {number}")

    def _point(self, given: object, who: str) -> Point:
        try:
            x, y, *height = values.point(given)
        except ValueError as error:
            raise BadInput(f"{who}: {values.shown(given)} {error}") from None
        return x, y, height[0] if height else self._airspace.cruise_height

    def _sweep(self, area: dict[str, object]) -> Swept:
        before = area.pop("before", None)
        come = None if before is None else self._point(before, "before")
        document = Document("", {"area": area})
        table = PlanTable(document, area, ("area",), "the area")
        table.read({"polygon": None, "spacing": None}, {"height": None})
        places = read_places(table, self._airspace, come)
        document.refuse_if_bad()
        [made] = document.areas
        return {
            "targets": [[*place] for place in places],
            "metres": made.metres,
            "forbidden": made.forbidden,
        }


def _rounded(point: Point) -> list[float]:
    return [round(number, _DIGITS) for number in point]
