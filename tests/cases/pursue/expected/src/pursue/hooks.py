"""The hooks of pursue: your code.

plutoc wrote the stubs once, and never touches this file again.

A mission offers `name`, `status`, `reason`, `trips` (still to do, in order), `completed_trips`,
`current` (the trip that flies now, or flies next), `round`, `attempts`.
A trip offers `name`, `status`, `reason`, `action`, `parameters`, `source`, `target`, `item`,
`drone`, `attempt`, `start_time`, `end_time`, `elapsed`, `ended`, `track`, `reach`, `lost_after`,
`along`.
Everything is in SI units: seconds, metres, kilograms; a percentage is a number from 0 to 1.

How to see that a trip takes too long, here with a limit of three minutes, and how to put it back:

    trip = mission.current
    trip.elapsed         # seconds that it has been flying, or flew
    trip.expired(180.0)  # whether that is the limit or more, now
    if not await context.trip_ended(trip, within=180.0):
        ...              # it was still flying at the limit
    trip.reset()         # once it has ended: it is WAITING again, and counts one attempt more

`context.log(text)` writes on the console, `await context.sleep(seconds)` waits, `context.now` is
the time and `context.results` what the app's actions gave. A simulation waits for nothing else:
`asyncio` is for real flights only.
"""

from . import Context, Drone, IntruderEvent, Mission, Status, Trip


async def look(drone: Drone, trip: Trip, context: Context) -> object:
    """Do look on the way: from the launch to the end of the last leg.

    `context.live(drone)` says where the drone is. It may return before; what it returns goes to
    the result store. Raise ActionFailed to fail the trip.
    """
    context.log("look does nothing yet: write it in hooks.py")
    return None


def chase(event: IntruderEvent, context: Context) -> Mission | None:
    """Make a mission of an event; None makes none."""
    context.log("chase does nothing yet: write it in hooks.py")
    return None


def release_seen(mission: Mission, context: Context) -> Status:
    """Say with which status the mission goes on: STANDBY or COMPLETED."""
    context.log("release_seen does nothing yet: write it in hooks.py")
    return mission.status
