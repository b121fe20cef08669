"""Hooks."""

from . import Context, Drone, Trip


async def pollinate(drone: Drone, trip: Trip, context: Context, *, dose: float) -> object
    return dose
