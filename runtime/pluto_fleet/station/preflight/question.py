"""What is forecast: the missions of a Start, and the drones as it would find them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ...files.plan_check import endless
from ...flight.simulate import has_traffic
from ...shared.domain.text import duration, percent
from ...shared.fleet.reach import docked
from ..between_flights import BACK, FRESH_FOR, HOVERED, NEVER
from ..rows import words
from ..wait_reasons import level_after, ready_in

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import DroneEntry, FleetFile
    from ...flight.driver import Stands
    from ...gateway.sightings import Sighting
    from ...journal.standing import Standing
    from ...shared.alone.world import Faults
    from ...shared.domain.model import Category, Mission, Point
    from ..wire import Words


@dataclass(frozen=True, slots=True, kw_only=True)
class Present:
    """A drone as a Start would find it."""

    id: str
    at: Point
    battery: float
    """Its level now, from 0 to 1."""
    out: Words | None = None
    """Why no mission would get it, even with a full battery; None: one may."""
    assumed: Words | None = None
    """What is supposed of it, as it is not known; None: nothing is."""
    known: bool = True
    """Whether its battery is known at all."""


def at_rest(
    entry: DroneEntry,
    kind: Category,
    seen: Sighting | None,
    records: Standing,
    *,
    now: float,
    simulated: bool,
    speed: float,
) -> Present:
    """Return a drone while nothing flies, from when it was heard of last.

    `now` is in seconds since 1970. The time of a simulated drone goes on `speed` times as fast.
    """
    out = _out(entry.id, seen, records)
    if entry.id in records.mended:
        level = seen.battery if seen is not None and seen.when else 1.0
        back = words("preflight.brought-back", BACK)
        return Present(id=entry.id, at=entry.home, battery=level, assumed=back, known=False)
    if seen is None:
        never = words("preflight.never-heard", f"{NEVER}: supposed to be charged, in its dock")
        assumed = None if simulated or out else never
        return Present(
            id=entry.id, at=entry.home, battery=1.0, out=out, assumed=assumed, known=simulated
        )
    passed = max(0.0, now - seen.when) * (speed if simulated else 1.0)
    level = level_after(kind, seen.battery, passed, seen.at, entry.home)
    assumed = None
    if not simulated and now - seen.when > FRESH_FOR:
        text = (
            f"heard of {duration(now - seen.when)} ago, at {percent(seen.battery)}:"
            f" supposed to be at {percent(level)} by now"
        )
        assumed = words(
            "preflight.heard-before",
            text,
            seconds=now - seen.when,
            battery=seen.battery,
            supposed=level,
        )
    return Present(id=entry.id, at=seen.at, battery=level, out=out, assumed=assumed)


def _out(id: str, seen: Sighting | None, records: Standing) -> Words | None:
    if id in records.lost:
        why = str(records.lost[id]["reason"])
        return words("preflight.lost", f"lost: {why}" if why else "lost", why=why)
    if id in records.retired:
        return words("preflight.retired", "retired")
    if id in records.mended or seen is None:
        return None
    if seen.why:
        return words("preflight.not-ready", seen.why, why=seen.why)
    return None if seen.landed else words("preflight.in-the-air", HOVERED)


def in_flight(
    entries: Mapping[str, DroneEntry], drones: Mapping[str, Mapping[str, Any]]
) -> Iterator[Present]:
    """Yield the drones while missions fly, as their brain says; those in the air are supposed at home."""
    for id, drone in drones.items():
        x, y, z = drone["at"]
        out = assumed = None
        if drone["status"] == "LOST":
            why = str(drone["unready"])
            out = words("preflight.lost", f"lost: {why}" if why else "lost", why=why)
        elif drone["retired"]:
            out = words("preflight.retired", "retired")
        elif drone["unready"]:
            out = words("preflight.not-ready", str(drone["unready"]), why=str(drone["unready"]))
        elif not drone["landed"]:
            assumed = words(
                "preflight.flies", "it flies: supposed to be in its dock, with what it has now"
            )
        at = (x, y, z) if drone["landed"] else entries[id].home
        yield Present(id=id, at=at, battery=drone["battery"], out=out, assumed=assumed)


UNTIL = 2 * 3600.0
"""Seconds of virtual time after which runs of missions are cut off that would go on for ever."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """A Start that has not happened yet."""

    app: App
    """Its drones move as the fleet's."""
    fleet: FleetFile
    """All drones, also those that no mission would get."""
    missions: Sequence[Mission[Any]]
    beside: Sequence[Mission[Any]] = ()
    """What is left of the missions that fly already."""
    present: Sequence[Present]
    faults: Faults
    seed: int = 0
    runs: int | None = None
    """How many; None: as many as there is time for."""
    revision: int = 0
    is_simpler: bool = False
    """Whether drones are not kept apart in it though they are in flight, as that took too long."""

    @property
    def simpler(self) -> Question | None:
        """The same in a world in which each drone has the air to itself; None: it is that already."""
        if self.is_simpler or not has_traffic(self.fleet):
            return None
        fleet = replace(self.fleet, apart=0.0)
        return None if has_traffic(fleet) else replace(self, fleet=fleet, is_simpler=True)

    @property
    def all(self) -> Sequence[Mission[Any]]:
        """All missions that a run flies, those that fly already first."""
        return [*self.beside, *self.missions]

    @cached_property
    def until(self) -> float | None:
        """When runs are cut off; None: they end by themselves."""
        return UNTIL if endless(self.all, self.app) else None

    @cached_property
    def flown(self) -> FleetFile:
        """The fleet without the drones that no mission would get."""
        there = {one.id for one in self.present if one.out is None}
        return replace(
            self.fleet, drones=tuple(one for one in self.fleet.drones if one.id in there)
        )

    @cached_property
    def stands(self) -> Stands:
        """Where those drones stand, with which charge."""
        return {one.id: (one.at, one.battery) for one in self.present if one.out is None}

    @cached_property
    def entries(self) -> Mapping[str, DroneEntry]:
        """The drones, as their fleet file has them."""
        return {one.id: one for one in self.fleet.drones}

    def kind(self, drone: str) -> Category:
        """Return the category of a drone."""
        return self._kinds[self.entries[drone].category]

    @cached_property
    def _kinds(self) -> Mapping[str, Category]:
        return {category.name: category for category in self.app.categories}

    def ready_in(self, one: Present, wanted: float) -> float | None:
        """Return the seconds until the battery of a drone has this level; None: it never will."""
        is_docked = docked(one.at, self.entries[one.id].home)
        return ready_in(self.kind(one.id), one.battery, wanted, docked=is_docked)
