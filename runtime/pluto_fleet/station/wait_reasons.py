"""Why a mission waits for a drone, which free drone is ready, and when a battery is high enough."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from math import ceil, floor, inf
from typing import TYPE_CHECKING, Any

from ..shared.domain.app import moving
from ..shared.domain.motion import charged, charging
from ..shared.domain.status import IN_THE_AIR, DroneStatus
from ..shared.domain.text import percent
from ..shared.fleet.reach import LOW, Reach, chain_of, docked, miss_of
from ..shared.fleet.reach import docked as stands_in_its_dock
from ..shared.hooks.plain_data import trip_of
from .rows import words

if TYPE_CHECKING:
    from ..journal.standing import Record
    from ..shared.brain import Brain
    from ..shared.domain.app import App
    from ..shared.domain.fleet_data import DroneData, FleetData
    from ..shared.domain.model import Category, Point, Trip
    from .wire import Scalar, Words

    Facts = dict[str, Scalar | list[str]]


def to_fly(kind: Category) -> float:
    """Return the level from which a drone has more in its battery than its way home takes."""
    return min(1.0, kind.reserve + LOW)


def ready_in(kind: Category, level: float, wanted: float, *, docked: bool) -> float | None:
    """Return the seconds until a battery has the level that is wanted; None: it never will.

    A drone charges only in its dock, if its fleet does at all. Levels are from 0 to 1; 0 seconds: it has it already.
    """
    if level >= wanted:
        return 0.0
    if not docked or wanted > 1.0 or kind.charge_time == inf:
        return None
    return charging(level, wanted, kind.charge_time, kind.motion.taper)


def level_after(kind: Category, level: float, seconds: float, at: Point, home: Point) -> float:
    """Return the level of a battery so many seconds later, of a drone that stands on the ground."""
    if seconds <= 0.0 or kind.charge_time == inf or not stands_in_its_dock(at, home):
        return level
    return charged(level, seconds, kind.charge_time, kind.motion.taper)


LOOK_EVERY = 3.0
"""Seconds after which a reason is updated."""
MISSIONS_A_LOOK = 10
"""The most missions whose reasons are updated in one sample: there may be hundreds."""

_FREE, _LOST, _CHARGING = (
    one.value for one in (DroneStatus.FREE, DroneStatus.LOST, DroneStatus.CHARGING)
)
_DOES = {
    "LOST": ("lost", "lost"),
    "BUSY": ("flying", "flying"),
    "RETURNING": ("returning", "coming home"),
    "CHARGING": ("charging", "charging"),
    "RECOVERING": ("recovering", "recovering"),
    "OFFLINE": ("offline", "not asked yet"),
}
"""By status: the name of its fact, and the English."""


class WaitReasons:
    """The reasons of waiting missions, cached between updates."""

    def __init__(self, app: App, fleet: FleetData, clock: Callable[[], float]) -> None:
        self._app = moving(app, fleet.motion, charges=fleet.charges_at_home)
        self._fleet, self._clock = fleet, clock
        self._reach = Reach(self._app, fleet.airspace)
        self._kinds = {category.name: category for category in self._app.categories}
        self._drones: Mapping[str, Any] = {}
        """Where each stood when the sample began."""
        self._known: dict[tuple[str, str], tuple[float, Words | None]] = {}
        """By mission and trip: when it was asked, and the reason."""
        self._needs: dict[str, tuple[float, float]] = {}
        """Of each drone that is too low: when it was asked, and the level for the nearest trip."""
        self._entries = {one.id: one for one in fleet.drones}
        self._left = MISSIONS_A_LOOK

    def look(self, brain: Brain, fleet: FleetData) -> None:
        """Begin a sample of all missions and drones; drones may have joined the fleet."""
        self._fleet = fleet
        self._entries = {one.id: one for one in fleet.drones}
        now, self._left, self._drones = self._clock(), MISSIONS_A_LOOK, brain.drones()
        self._known = {
            which: (asked, said)
            for which, (asked, said) in self._known.items()
            if now - asked < 2 * LOOK_EVERY
        }
        self._needs = {
            id: (asked, level)
            for id, (asked, level) in self._needs.items()
            if now - asked < 2 * LOOK_EVERY and self._drones[id].get("aside")
        }

    def why(self, mission: str, todo: Sequence[Record]) -> Words | None:
        """Return why no drone flies the next trip of those that a mission has to do; None: not known yet."""
        which, now = (mission, todo[0]["name"] if todo else ""), self._clock()
        asked, said = self._known.get(which, (-LOOK_EVERY, None))
        if self._left and todo and now - asked >= LOOK_EVERY:
            self._left -= 1
            said = self._why_no_drone(chain_of([trip_of(self._app, one) for one in todo]))
            self._known[which] = now, said
        return said

    def why_low(self, drone: Mapping[str, Any]) -> str:
        """Return why a free drone is not ready; empty: it is."""
        if drone["status"] != _FREE:
            return ""
        if drone["aside"]:
            return "its battery is too low for every trip that waits"
        return "its battery has little more than its reserve" if drone["low"] else ""

    @property
    def takes(self) -> float | None:
        """The level below which all drones are that are too low; None: none is, or it is not known."""
        return max((self._wanted(id) for id in self._needs), default=None)

    def _wanted(self, id: str) -> float:
        """Return to which level a drone is charged: for its share of what waits, as its queue does it."""
        kind = self._kinds[self._entries[id].category]
        _, least = self._needs.get(id, (0.0, to_fly(kind)))
        share = -(-len(self._known) // len(self._entries))
        return max(least, min(1.0, kind.reserve + share * (least - kind.reserve)))

    def ready_in(self, id: str, drone: Mapping[str, Any], low: bool) -> float | None:
        """Return the seconds until a drone is charged that is too `low`, or charging; None: it is, or never."""
        if not low and drone["status"] != _CHARGING:
            return None
        one, (x, y, z) = self._entries[id], drone["at"]
        kind, stands = self._kinds[one.category], drone["landed"] and docked((x, y, z), one.home)
        return ready_in(kind, round(drone["battery"], 3), self._wanted(id), docked=stands)

    def _why_no_drone(self, chain: Sequence[Trip]) -> Words:
        """Return what keeps each drone of the fleet from flying a chain of trips."""
        free = retired = 0
        low: list[tuple[float, float]] = []
        status: Counter[str] = Counter()
        cannot: Counter[str] = Counter()
        for one in self._fleet.drones:
            drone = self._drones[one.id]
            if drone["retired"] and drone["status"] != _LOST:
                retired += 1
            elif drone["status"] != _LOST and (why := self._never(one, drone, chain)):
                cannot[why] += 1
            elif drone["status"] != _FREE:
                status[drone["status"]] += 1
            elif drone.get("aside"):
                x, y, z = drone["at"]
                kind = self._kinds[one.category]
                needs = self._reach.level(kind, one.home, (x, y, z), chain)
                _, least = self._needs.get(one.id, (0.0, needs))
                self._needs[one.id] = self._clock(), min(needs, least)
                low.append((needs, drone["battery"]))
            else:
                free += 1
        facts: Facts = {"free": free} if free else {}
        is_full = free > 0 and self._is_full()
        parts = [f"{free} free{', but no more may fly at once' if is_full else ''}"] if free else []
        if low:
            more, said = _too_low(low)
            facts |= more
            parts.append(said)
        for does, number in status.items():
            name, english = _DOES[does]
            facts[name] = number
            parts.append(f"{number} {english}")
        if retired:
            facts["retired"] = retired
            parts.append(f"{retired} retired")
        if cannot:
            never = [f"{n} cannot: {why}" for why, n in cannot.items()]
            facts["cannot"] = never
            parts += never
        text = f"waits for a drone ({'; '.join(parts)})" if parts else "waits for a drone"
        return words("wait.drone-full" if is_full else "wait.drone", text, **facts)

    def _never(self, one: DroneData, drone: Mapping[str, Any], chain: Sequence[Trip]) -> str:
        """Return why a drone can never fly it; no route is searched for one that may just be busy."""
        kind, trip = self._kinds[one.category], chain[0]
        heavy = trip.item is not None and trip.item.mass > kind.payload
        if drone.get("aside") or heavy or not kind.can(trip.action):
            miss = miss_of(self._app, self._fleet.airspace, kind, one.home, chain)
            return miss.reason if miss else ""
        return ""

    def _is_full(self) -> bool:
        """Return whether no more drones may fly at once."""
        most = self._fleet.max_airborne
        flying = sum(DroneStatus(drone["status"]) in IN_THE_AIR for drone in self._drones.values())
        return most is not None and flying >= most


def _too_low(low: Sequence[tuple[float, float]]) -> tuple[Facts, str]:
    """Return how many are too low, and of the nearest what it needs and has, as facts and in English."""
    said = f"{len(low)} free, but too low"
    needs, has = min(low, key=lambda one: (one[0] - one[1], one[1], one[0]))
    if needs > 1:
        return {"low": len(low)}, said
    takes, level = ceil(needs * 100) / 100, floor(has * 100) / 100
    said += f": it takes {percent(takes)}, the nearest has {percent(level)}"
    return {"low": len(low), "takes": takes, "has": level}, said
