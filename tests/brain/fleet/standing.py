"""Drones that stand where a test wants them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pluto_fleet.shared.domain.model import Category, Drone, Point, Trip
from pluto_fleet.shared.domain.motion import Motion
from pluto_fleet.shared.fleet.policies import Able
from pluto_fleet.shared.fleet.telemetry import KnownState

SCOUT = Category(name="scout")


@dataclass(frozen=True)
class Standing:
    """The telemetry of a drone that waits in its dock."""

    location: Point
    battery_level: float = 1.0
    landed: bool = True
    silence: float = 0.0


def drone(index: int, place: Point) -> Drone:
    """Return a drone that stands there."""
    return Drone(
        id=f"cf{index}", category=SCOUT, home=place, telemetry=Standing(place), index=index
    )


def fleet(*places: Point) -> list[Drone]:
    """Return a drone for each place."""
    return [drone(index, place) for index, place in enumerate(places)]


def trip(target: Point, source: Point | None = None) -> Trip:
    """Return a trip to there."""
    return Trip(name="A", action="take_photo", target=target, source=source)


@dataclass(frozen=True, eq=False)
class Offer:
    """What a policy for all that wait asks of a request."""

    goal: Point
    able: Able


def offer(goal: Point, able: Able | None = None) -> Any:
    """Return a request for a drone there."""
    return Offer(goal=goal, able=able or anyone)


def anyone(drone: Drone) -> bool:
    """Refuse none."""
    return True


class StillClock:
    """A clock that stands still."""

    now = 0.0


def known(place: Point, level: float, motion: Motion) -> KnownState:
    """Return what is known of a drone that stands there with this battery."""
    state = KnownState(StillClock(), place, motion)
    state.take({"at": place, "battery": level})
    return state
