"""Drones that stand where a test wants them."""

from __future__ import annotations

from dataclasses import dataclass

from pluto_fleet.shared.domain.model import Category, Drone, Point, Trip

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


def anyone(drone: Drone) -> bool:
    """Refuse none."""
    return True
