"""Checks before a flight: can the fleet do what the missions ask, and are their names distinguishable?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import dist, inf
from typing import TYPE_CHECKING, Any
from unicodedata import normalize

from ..shared.domain.fields import Entity, FieldType, put_plain
from ..shared.domain.model import AfterTrip
from ..shared.domain.own_fields import OwnField
from ..shared.domain.text import duration, quoted
from ..shared.domain.values import shown
from ..shared.fleet.reach import Miss, chain_of, flight_seconds, miss_of, stops_of
from ..shared.flow.promises import kept_from

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Category, Mission, Point, Trip
    from ..shared.time.hours import Hours
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
    app: App,
    airspace: Airspace,
    drones: Sequence[tuple[Category, Point]],
    chain: Sequence[Trip],
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
            takes += min(_seconds(app, fleet, kind, home, here, chain) for kind, home in drones)
            if fleet.after_trip is not AfterTrip.HOME:
                here = (*chain[-1].target[:2], 0.0)
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
    home: Point,
    here: Point | None,
    chain: Sequence[Trip],
) -> float:
    """Return how long a chain of trips takes from here; None: from home and back. Infinite: it cannot be."""
    if miss_of(app, fleet.airspace, kind, home, chain) is not None:
        return inf
    stops = stops_of(app, kind, fleet.airspace.cruise_height, chain)
    points = [point for point, _ in stops]
    x, y, _ = home if here is None else points[-1]
    actions = sum(seconds for _, seconds in stops)
    return flight_seconds(kind, fleet.airspace, here or home, [*points, (x, y, 0.0)], actions)


def endless(missions: Sequence[Mission[Any]], app: App) -> list[str]:
    """Return a sentence for each mission that repeats until it is stopped."""
    rounds = [
        field.name
        for field in app.fields
        if field.on is Entity.MISSION and field.type is FieldType.ROUNDS
    ]
    return [
        f"mission {quoted(mission.name)} repeats until it is stopped ({name} = true): "
        "say when with --until, such as --until 2h"
        for mission in missions
        for name in rounds
        if getattr(mission, name) is True
    ]


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
