"""The timer of drugs distribution, written by hand: the thesis's third exercise."""

from __future__ import annotations

from . import Context, Mission, Status


async def limit_trip(mission: Mission, context: Context, *, limit: float) -> Status:
    """Give the trip that flies now `limit` seconds from its start, then fail it.

    FAILED fails the trip and calls its drone back. In every other case the trip has ended by
    itself, and the mission stands as that has left it.
    """
    trip = mission.current  # asked now: when it has ended, another one is current
    if not await context.trip_ended(trip, within=limit):
        context.log(f"trip {trip.name} is called back after {trip.elapsed:.0f} s")
        return Status.FAILED
    return mission.status
