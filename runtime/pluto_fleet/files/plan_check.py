"""Checks before a flight: can the fleet do what the missions ask and promise, and are their names distinguishable?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from graphlib import TopologicalSorter
from math import dist, inf
from typing import Any
from unicodedata import normalize

from ..app import App
from ..shared.domain.airspace import Airspace
from ..shared.domain.fields import Entity, FieldType, put_plain, time_of_day
from ..shared.domain.model import AfterTrip, Category, Mission, Point, Trip
from ..shared.domain.own_fields import OwnField
from ..shared.domain.text import counted, duration, quoted
from ..shared.domain.values import shown
from ..shared.events.declared import FOLLOWING
from ..shared.fleet.reach import Miss, chain_of, flight_seconds, miss_of, stops_of
from ..shared.flow.promises import kept_from
from ..shared.time.hours import DAY, Hours
from .fleet import DroneEntry, FleetFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Unflyable:
    """Trips that one drone must fly together, and no drone of the fleet can."""

    mission: Mission[Any]
    trips: Sequence[Trip]
    reason: str

    @property
    def called(self) -> str:
        """How a message calls them."""
        names = [trip.name if trip.name.isdigit() else quoted(trip.name) for trip in self.trips]
        trips = f"trip {names[0]}" if len(names) == 1 else f"trips {names[0]} to {names[-1]}"
        return f"mission {quoted(self.mission.name)}, {trips}"


def problems(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, airspace: Airspace
) -> list[str]:
    """Return a sentence for each trip that no drone of the fleet could ever do."""
    return [f"{one.called}: {one.reason}" for one in unflyable(missions, app, fleet, airspace)]


def wrong_fields(missions: Sequence[Mission[Any]], app: App) -> Iterator[str]:
    """Yield a sentence for each field of the app's own that a script has left out, or filled in wrongly."""
    own = [one for one in app.fields if isinstance(one, OwnField)]
    for mission in missions:
        who = f"mission {quoted(mission.name)}"
        for of, called in ((mission, who), *((t, f"{who}, trip {t.name}") for t in mission.trips)):
            for field in own:
                if field.on is (Entity.MISSION if of is mission else Entity.TRIP):
                    value = getattr(of, field.name)
                    if value is None and field.hint:
                        yield f"{called}: has no {field.name}"
                    elif wanted := field.wanted(value, ()):
                        yield f"{called}: {field.name} must be {wanted}, not {shown(value)}"
                    else:
                        put_plain(of, field.name, value)


def chains(mission: Mission[Any]) -> Iterator[Sequence[Trip]]:
    """Yield a mission's trips, those together that one drone must fly."""
    rest: Sequence[Trip] = mission.trips
    while rest:
        chain = chain_of(rest)
        rest = rest[len(chain) :]
        yield chain


def unflyable(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, airspace: Airspace
) -> list[Unflyable]:
    """Return the trips that no drone of the fleet could ever do, each with the reason."""
    categories = {category.name: category for category in app.categories}
    drones = [(categories[drone.category], drone.home) for drone in fleet.drones]
    homes: dict[str, list[Point]] = {}
    for category, home in drones:
        homes.setdefault(category.name, []).append(home)
    found = []
    for mission in missions:
        for chain in chains(mission):
            near = partial(dist, chain[0].target)
            nearest = [(categories[name], min(homes[name], key=near)) for name in homes]
            misses = _misses(app, airspace, nearest, chain)
            if misses:  # a farther home may still have a shorter route
                misses = _misses(app, airspace, drones, chain)
            if misses:
                why = "; ".join(dict.fromkeys(miss.reason for miss in misses))
                reason = f"no drone of the fleet can do it: {why}"
                found.append(Unflyable(mission=mission, trips=chain, reason=reason))
    return found


def _misses(
    app: App, airspace: Airspace, drones: Sequence[tuple[Category, Point]], chain: Sequence[Trip]
) -> Sequence[Miss]:
    """Return each category's nearest miss, in the fleet's order; nothing if a drone lacks nothing."""
    best: dict[str, Miss | None] = dict.fromkeys(category.name for category, _ in drones)
    for category, home in drones:
        miss = miss_of(app, airspace, category, home, chain)
        if miss is None:
            return ()
        known = best[category.name]
        if known is None or (-miss.lacks, miss.by) < (-known.lacks, known.by):
            best[category.name] = miss
    return [miss for miss in best.values() if miss is not None]


def uncharged(missions: Sequence[Mission[Any]], app: App, fleet: FleetFile) -> str | None:
    """Return a sentence if no drone is charged at home, and their batteries are likely too few for all."""
    if fleet.charges_at_home:
        return None
    kinds = {category.name: category for category in app.categories}
    drones = [(kinds[drone.category], drone.home) for drone in fleet.drones]
    has = sum((1 - kind.reserve) * kind.endurance for kind, _ in drones)
    takes = 0.0
    here = None
    for mission in missions:
        for chain in chains(mission):
            x, y, _ = chain[-1].target
            takes += min(
                (
                    inf
                    if miss_of(app, fleet.airspace, kind, home, chain)
                    else _seconds(
                        app, fleet, kind, here or home, chain, (x, y, 0.0) if here else home
                    )
                )
                for kind, home in drones
            )
            if fleet.after_trip is not AfterTrip.HOME:
                here = (x, y, 0.0)
    if takes <= has:
        return None
    return (
        f"nothing charges the drones at home, and their batteries last for {duration(has)} in the air: all"
        f" trips, in the order of the file, take about {duration(takes)}; simulate says which missions fail"
    )


def _seconds(
    app: App,
    fleet: FleetFile,
    kind: Category,
    start: Point,
    chain: Sequence[Trip],
    end: Point | None = None,
) -> float:
    """Return how long a chain of trips takes from a start, and on to an end on the ground; infinite: it cannot be."""
    stops = stops_of(app, kind, fleet.airspace.cruise_height, chain)
    points = [point for point, _ in stops]
    if end is not None:
        points.append((end[0], end[1], 0.0))
    busy = sum(seconds for _, seconds in stops)
    return flight_seconds(kind, fleet.airspace, start, points, busy)


def endless(missions: Sequence[Mission[Any]], app: App) -> list[str]:
    """Return a sentence for each mission that repeats until it is stopped."""
    return [
        f"mission {quoted(name)} repeats until it is stopped ({field} = true): "
        "say when with --until, such as --until 2h"
        for name, field in _endless(missions, app).items()
    ]


def _endless(missions: Sequence[Mission[Any]], app: App) -> dict[str, str]:
    """Return by which field missions repeat until they are stopped."""
    fields = [one.name for one in app.fields if one.type is FieldType.ROUNDS]
    return {one.name: key for one in missions for key in fields if getattr(one, key) is True}


def untracked(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, *, real: bool, simulated: bool
) -> str | None:
    """Return a sentence if these follow what moves, and nothing says where that is.

    `real`, `simulated`: which drones may fly them.
    """
    seen = (real and fleet.tracker is not None) or (
        simulated and fleet.world is not None and fleet.world.movers
    )
    follows = any(FOLLOWING in (category.actions or ()) for category in app.categories) or any(
        trip.action == FOLLOWING or getattr(trip, "track", None) is not None
        for mission in missions
        for trip in mission.trips
    )
    if seen or not follows:
        return None
    ways = [
        *(["name a tracker, by tracker = … in [fleet]"] if real else []),
        *(["add [[world.mover]] to a simulated world"] if simulated else []),
    ]
    return f"drones follow what moves, and nothing says where that is: {', or '.join(ways)}"


def look_alikes(
    missions: Sequence[Mission[Any]], drones: Sequence[DroneEntry] = ()
) -> Iterator[str]:
    """Yield a sentence for each two missions, trips of one mission, or drones whose names look the same."""
    for one, other in _alike(mission.name for mission in missions):
        yield _sentence("missions", one, other)
    for one, other in _alike(drone.id for drone in drones):
        yield _sentence("drones", one, other)
    for mission in missions:
        for one, other in _alike(trip.name for trip in mission.trips):
            yield _sentence(f"trips of mission {quoted(mission.name)}", one, other)


def _alike(names: Iterable[str]) -> Iterator[tuple[str, str]]:
    first: dict[str, str] = {}
    for name in names:
        known = first.setdefault(_seen(name), name)
        if known != name:
            yield known, name


def _seen(name: str) -> str:
    """Return a name's appearance: look-alike letters of other alphabets and cases become one."""
    plain = normalize("NFKC", name).translate(_LETTERS).casefold()
    return " ".join(normalize("NFKC", plain).split())


def _sentence(what: str, one: str, other: str) -> str:
    return (
        f"two {what} are easily taken for one another, {quoted(one)} and {quoted(other)}"
        f" ({one!a} and {other!a}): rename one"
    )


_LETTERS = str.maketrans(
    "\u0430\u0435\u043a\u043e\u0440\u0441\u0443\u0445\u0456\u0458\u0455\u0475\u04bb\u04cf\u0501\u051b\u051d"
    "\u0410\u0412\u0415\u041a\u041c\u041d\u041e\u0420\u0421\u0422\u0423\u0425\u0406\u0408\u0405\u04c0"
    "\u0391\u0392\u0395\u0396\u0397\u0399\u039a\u039c\u039d\u039f\u03a1\u03a4\u03a5\u03a7"
    "\u03b1\u03b9\u03ba\u03bd\u03bf\u03c1\u03c5\u03c7\u03f3\u0131\u0251\u0261\u0570\u057d\u0581\u0585"
    "\u2010\u2012\u2013\u2014\u2015\u2212\u2018\u2019\u02bc\u201c\u201d\u2044\u2215"
    "\u1160\u115f\u2800",
    "aekopcyxijsvhldqw"
    "ABEKMHOPCTYXIJSI"
    "ABEZHIKMNOPTYX"
    "aikvopuxjiaghugo"
    "------'''\"\"//"
    "   ",
    "\u034f\u17b4\u17b5"
    + "".join(map(chr, (*range(0x180B, 0x1810), *range(0xFE00, 0xFE10), *range(0xE0100, 0xE01F0)))),
)
"""Letters that look like Latin ones, and signs that look alike, or are invisible."""


LONG = 10.0
"""Seconds of a wait that is worth a line: in a flight it is told then, or at once if it is known to take longer."""


def waits(missions: Sequence[Mission[Any]], hours: Hours) -> Iterator[str]:
    """Yield a sentence for each mission that waits, by the hours from their start on."""
    for mission in missions:
        promises = kept_from(mission.promises, hours)
        after = ", ".join(map(quoted, promises.get("after", ())))
        opens = promises.get("opens", 0.0)
        at = getattr(mission, "at", None)
        delay = getattr(mission.trips[0], "delay", None)
        begins = 0.0 if at is None else hours.next(at, 0.0)
        why, seconds = max(
            ("its window has not opened", opens),
            ("its first trip is not to start before", begins),
            ("its first trip has a delay", delay or 0.0),
            key=lambda one: one[1],
        )
        who = f"mission {quoted(mission.name)}: waits"
        if after:
            yield f"{who} until {after} {'have' if ', ' in after else 'has'} completed"
        if seconds > LONG:
            start = hours.said(0.0)
            end = hours.said(seconds)
            yield f"{who} {duration(seconds)} if it is started at {start}, until {end}: {why}"


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

    Bounds from below: no flight of any order is shorter. So what is told here is impossible; what is not may still
    be late, which `simulate` tells. Faults, charging and drones in each other's way are left out.
    `hours` from their start on; None: it is not known when that is.
    """
    if not any(one.promises for one in missions):
        return []
    bounds = _Bounds(app, fleet)
    flights = {one.name: [*map(bounds.flight, chains(one))] for one in missions}
    if hours is not None:
        missions = [replace(m, promises=kept_from(m.promises, hours)) for m in missions]
    named = {one.name: one for one in missions}
    order = TopologicalSorter({one.name: one.promises.get("after", ()) for one in missions})
    found = [*_in_vain(missions, app)]
    ends = dict[str, float]()
    for name in order.static_order():
        if name in named:
            late = _too_late(named[name], flights[name], ends)
            found += [f"mission {quoted(name)}: {late}"] if late else []
    return found or [*_too_many(missions, flights, fleet)]


def _in_vain(missions: Sequence[Mission[Any]], app: App) -> Iterator[str]:
    """Yield why missions never begin that come after one without a last round."""
    endless = _endless(missions, app)
    for mission in missions:
        for name in filter(endless.__contains__, mission.promises.get("after", ())):
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
    opens = promises.get("opens")
    due = promises.get("deadline")
    if isinstance(opens, str) and isinstance(due, str):
        return (time_of_day(due) - time_of_day(opens)) % DAY
    return due - opens if isinstance(opens, float) and isinstance(due, float) else None


def _moments(promises: Mapping[str, Any]) -> tuple[float, float | None]:
    """Return from when to when a mission may fly, as far as that does not depend on the time of day."""
    opens = promises.get("opens", 0.0)
    due = promises.get("deadline")
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
        self._app = app
        self._fleet = fleet
        self._homes: list[tuple[Category, list[Point]]] = []
        for kind in app.categories:
            homes = [one.home for one in fleet.drones if one.category == kind.name]
            self._homes += [(kind, homes)] if homes else []

    def flight(self, chain: Sequence[Trip]) -> _Flight:
        """Return the flight of trips that one drone flies together."""
        able = [one for one in self._homes if all(one[0].can(trip.action) for trip in chain)]
        goes_home = self._fleet.after_trip is AfterTrip.HOME
        below = chain[0].source or chain[0].target
        least = partial(min, default=0.0)
        done = list[float]()
        again = list[float]()
        for length in range(1, len(chain) + 1):
            part = chain[:length]
            done.append(
                least(self._seconds(kind, at, part) for kind, homes in able for at in homes)
            )
            near = least(self._seconds(kind, below, part) for kind, _ in able)
            again.append(done[-1] if goes_home else near)
        end = chain[-1].target
        if goes_home:
            space = self._fleet.airspace
            back = least(
                flight_seconds(kind, space, end, [(x, y, 0.0)], 0.0)
                for kind, homes in able
                for x, y, _ in homes
            )
        elif self._fleet.after_trip is AfterTrip.ONWARD:
            back = 0.0
        else:
            back = least(kind.motion.lands(end[2], kind.speed) for kind, _ in able)
        return _Flight(done=tuple(done), again=tuple(again), back=back)

    def _seconds(self, kind: Category, above: Point, chain: Sequence[Trip]) -> float:
        """Return the least from a place, or from the ground below; what cannot be flown is told elsewhere."""
        goes_on = self._fleet.after_trip is AfterTrip.ONWARD
        start = above if goes_on else (*above[:2], 0.0)
        least = _seconds(self._app, self._fleet, kind, start, chain)
        return 0.0 if least == inf else least
