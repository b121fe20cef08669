"""The drones as a Start would find them: as the station knows them now, or as it must suppose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...shared.domain.text import duration, percent
from ..between_flights import BACK, FRESH_FOR, HOVERED, NEVER
from ..charging import level_after
from ..words import words

if TYPE_CHECKING:
    from ...files.drones import DroneEntry
    from ...gateway.sightings import Sighting
    from ...journal.standing import Standing
    from ...shared.domain.model import Category, Point
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
