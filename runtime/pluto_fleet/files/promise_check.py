"""Which promises of a plan cannot be kept by any order of its flights, and why.

Bounds from below: no flight of any order is shorter. So what is told here is impossible; what is not may
still be late, which `simulate` tells. Faults, charging and drones in each other's way are left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from graphlib import TopologicalSorter
from math import inf
from typing import TYPE_CHECKING, Any

from ..shared.domain.fields import FieldType, time_of_day
from ..shared.domain.model import AfterTrip
from ..shared.domain.text import counted, duration, quoted
from ..shared.fleet.reach import flight_seconds, stops_of
from ..shared.flow.promises import kept_from
from ..shared.time.hours import DAY
from .plan_check import chains

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.model import Category, Mission, Point, Trip
    from ..shared.time.hours import Hours
    from .fleet import FleetFile

_SLACK = 1e-6
"""Seconds that sums of floats may be wrong by."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Flight:
    """A trip, or trips that one drone flies together, at its shortest: seconds from the launch."""

    done: tuple[float, ...]
    """Until each trip is done, by a drone that starts at home."""
    again: tuple[float, ...]
    """The same by a drone that may stand where the plan may have left it."""
    back: float
    """From the last one until its drone can fly again."""


def impossible(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, hours: Hours | None = None
) -> list[str]:
    """Return a sentence for each promise that no order of flights can keep.

    `hours` from their start on; None: it is not known when that is.
    """
    if not any(one.promises for one in missions):
        return []
    bounds = _Bounds(app, fleet)
    flights = {one.name: bounds.flights(one) for one in missions}
    if hours is not None:
        missions = [replace(m, promises=kept_from(m.promises, hours)) for m in missions]
    named = {one.name: one for one in missions}
    order = TopologicalSorter({one.name: one.promises.get("after", ()) for one in missions})
    found, ends = [*_in_vain(missions, app)], dict[str, float]()
    for name in order.static_order():
        if name in named:
            late = _too_late(named[name], flights[name], ends)
            found += [f"mission {quoted(name)}: {late}"] if late else []
    return found or [*_too_many(missions, flights, fleet)]


def _in_vain(missions: Sequence[Mission[Any]], app: App) -> Iterator[str]:
    """Yield why missions never begin that come after one without a last round."""
    rounds = [one.name for one in app.fields if one.type is FieldType.ROUNDS]
    endless = {one.name for one in missions if any(getattr(one, key) is True for key in rounds)}
    for mission in missions:
        for name in endless.intersection(mission.promises.get("after", ())):
            who = f"mission {quoted(mission.name)}: it comes after {quoted(name)}"
            yield f"{who}, which repeats until it is stopped, and never completes"


def _too_late(
    mission: Mission[Any], flights: Sequence[_Flight], ends: dict[str, float]
) -> str | None:
    """Return why a mission cannot end in time; note when it ends at the soonest."""
    promises = mission.promises
    opens, due = _moments(promises)
    before = max(promises.get("after", ()), key=lambda name: ends.get(name, 0.0), default="")
    begins = max(opens, ends.get(before, 0.0))
    end = begins
    for flight in flights:
        began = end
        for first, again in zip(flight.done, flight.again, strict=True):
            end = max(first, began + again)
    ends[mission.name] = end
    takes = duration(end - begins)
    if (length := _window(promises)) is not None and length < 0.0:
        return f"it is due {duration(-length)} before its window opens"
    if length is not None and begins == opens:
        least = sum(flight.again[-1] for flight in flights) if due is None else end - begins
        said = f"its window lasts {duration(length)}, and it takes {duration(least)} at the least"
        return said if least > length + _SLACK else None
    if due is None or end <= due + _SLACK:
        return None
    if not begins:
        return f"it is due after {duration(due)}, and takes {takes} at the least"
    return (
        f"it comes after {quoted(before)}, which ends after {duration(begins)} at the soonest; it takes"
        f" {takes} more at the least, and is due after {duration(due)}"
    )


def _window(promises: Mapping[str, Any]) -> float | None:
    """Return how long a window lasts; None: it is none."""
    opens, due = promises.get("opens"), promises.get("deadline")
    if isinstance(opens, str) and isinstance(due, str):
        return (time_of_day(due) - time_of_day(opens)) % DAY
    return due - opens if isinstance(opens, float) and isinstance(due, float) else None


def _moments(promises: Mapping[str, Any]) -> tuple[float, float | None]:
    """Return from when to when a mission may fly, as far as that does not depend on the time of day."""
    opens, due = promises.get("opens", 0.0), promises.get("deadline")
    if isinstance(opens, str) or isinstance(due, str):
        return 0.0, None
    return opens, due


def _too_many(
    missions: Sequence[Mission[Any]], flights: Mapping[str, Sequence[_Flight]], fleet: FleetFile
) -> Iterator[str]:
    """Yield why missions that could be in time one by one cannot be so all together: too few drones."""
    dues = {one.name: due for one in missions if (due := _moments(one.promises)[1]) is not None}
    count = len(fleet.drones)
    for due in sorted({*dues.values()}):
        names = [name for name, limit in dues.items() if limit <= due]
        works = [one for name in names for one in flights[name]]
        least = sum(one.again[-1] + one.back for one in works)
        least -= sum(sorted((one.back for one in works), reverse=True)[:count])
        if works and least > count * due + _SLACK:
            who = (
                f"mission {quoted(names[0])}" if len(names) == 1 else counted(len(names), "mission")
            )
            yield (
                f"no order keeps the deadlines: {who} due after {duration(due)} or sooner"
                f" take {duration(least)} of flights at the least, and"
                f" {counted(count, 'drone')} can fly for {duration(count * due)} until then"
            )
            return


class _Bounds:
    """The least that flights of an app take with a fleet."""

    def __init__(self, app: App, fleet: FleetFile) -> None:
        self._app, self._fleet = app, fleet
        self._categories = {one.name: one for one in app.categories}
        self._homes: dict[str, list[Point]] = {}
        for drone in fleet.drones:
            self._homes.setdefault(drone.category, []).append(drone.home)

    def flights(self, mission: Mission[Any]) -> list[_Flight]:
        """Return a mission's flights, in their order."""
        return [self._flight(chain) for chain in chains(mission)]

    def _flight(self, chain: Sequence[Trip]) -> _Flight:
        kinds = [self._categories[name] for name in self._homes]
        able = [one for one in kinds if all(one.can(trip.action) for trip in chain)]
        home = self._fleet.after_trip is AfterTrip.HOME
        done, again = list[float](), list[float]()
        for length in range(1, len(chain) + 1):
            part = chain[:length]
            homes = [self._from_home(one, part) for one in able]
            done.append(min(homes, default=0.0))
            near = (
                done[-1] if home else min((self._from_here(one, part) for one in able), default=0.0)
            )
            again.append(near)
        back = min((self._back(one, chain[-1].target, home) for one in able), default=0.0)
        return _Flight(done=tuple(done), again=tuple(again), back=back)

    def _from_home(self, kind: Category, chain: Sequence[Trip]) -> float:
        return min(self._seconds(kind, (x, y, 0.0), chain) for x, y, _ in self._homes[kind.name])

    def _from_here(self, kind: Category, chain: Sequence[Trip]) -> float:
        """Return the least of a drone that stands below the chain's first point, wherever that is."""
        x, y, _ = chain[0].source or chain[0].target
        return self._seconds(kind, (x, y, 0.0), chain)

    def _seconds(self, kind: Category, start: Point, chain: Sequence[Trip]) -> float:
        space = self._fleet.airspace
        stops = stops_of(self._app, kind, space.cruise_height, chain)
        busy = sum(seconds for _, seconds in stops)
        least = flight_seconds(kind, space, start, [point for point, _ in stops], busy)
        return 0.0 if least == inf else least  # what cannot be flown is told elsewhere

    def _back(self, kind: Category, target: Point, home: bool) -> float:
        down = kind.motion.lands(target[2], kind.speed)
        if not home:
            return down
        space = self._fleet.airspace
        ways = (
            flight_seconds(kind, space, target, [(a, b, 0.0)], 0.0)
            for a, b, _ in self._homes[kind.name]
        )
        return min(ways)
