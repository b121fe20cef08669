"""How any drone is sent on to where what it follows will be, again and again."""

from __future__ import annotations

from math import dist

from ..shared.domain.model import Point
from .protocol import DroneNavigation, Follows

SLOWEST = 0.05
"""Metres per second with which a drone follows what hardly moves."""


async def follow(
    navigation: DroneNavigation, target: Point, speed: float, seconds: float = 0.0
) -> None:
    """Send a drone on to a point, to be there in so many seconds: in a way of its own, or else by `go_to`."""
    if isinstance(navigation, Follows):
        await navigation.follow(target, speed, seconds)
        return
    metres = dist(navigation.telemetry.position, target)
    pace = max(SLOWEST, metres / seconds) if seconds else speed
    await navigation.go_to(target, min(pace, speed))
