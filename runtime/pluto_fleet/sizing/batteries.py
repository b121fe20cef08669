"""Batteries that are swapped by a person instead of charged in the dock.

A swap is simulated as a charge that is as short. The batteries that were taken out are charged outside
of the drones, in the time that the app says; the most that are charging at once is how many spare ones
are needed, so that a full one is at hand for every swap.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from heapq import heappop, heappush
from typing import TYPE_CHECKING, Any

from ..shared.domain.motion import charging
from ..shared.fleet.reach import docked

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..shared.domain.trace import Event

FULL = 0.999
"""A battery that is as full as this is not swapped."""


def swapping(app: App, seconds: float) -> App:
    """Return the app with batteries that are swapped within so many seconds."""
    given: Any = app.given

    def faster(one: Any) -> Any:
        return replace(one, charge_time=min(one.charge_time, seconds))

    return replace(
        app,
        categories=tuple(map(faster, app.categories)),
        given=replace(given, categories=tuple(map(faster, given.categories))),
    )


def most_charging(
    app: App, fleet: FleetFile, events: Iterable[Event]
) -> tuple[tuple[str, int], ...]:
    """Return how many batteries of each category are charging at once, at most.

    `app` says how long that takes. A drone's battery is swapped whenever it has landed in its dock.
    """
    categories = {category.name: category for category in app.categories}
    drones = {drone.id: drone for drone in fleet.drones}
    flown = dict.fromkeys(drones, False)
    chargers: dict[str, list[float]] = {}
    """When each battery will be full, by category."""
    most: dict[str, int] = {}
    for event in events:
        what = event["event"]
        if what == "trip.launched":
            flown[str(event["drone"])] = True
        elif what in _DOCKED and flown[(id := str(event["drone"]))]:
            drone = drones[id]
            now = event["t"]
            level = event["battery"]
            if level >= FULL or not docked(tuple(event["at"]), drone.home):
                continue
            flown[id] = False
            on = chargers.setdefault(drone.category, [])
            while on and on[0] <= now:
                heappop(on)
            kind = categories[drone.category]
            heappush(on, now + charging(level, 1.0, kind.charge_time, kind.motion.taper))
            most[drone.category] = max(most.get(drone.category, 0), len(on))
    return tuple(sorted(most.items()))


_DOCKED = ("drone.free", "drone.charging")
