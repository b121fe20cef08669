"""The hooks of alfalfa: your code.

plutoc wrote the stubs once, and never touches this file again.

A mission offers `name`, `status`, `reason`, `trips` (still to do, in order), `completed_trips`,
`current` (the trip that flies now, or flies next), `round`, `attempts`, `at`, `every`, `safe_time`,
`evaluator`, `repeat`.
A trip offers `name`, `status`, `reason`, `action`, `parameters`, `source`, `target`, `item`,
`drone`, `attempt`, `start_time`, `end_time`, `elapsed`, `ended`, `delay`, `priority`.
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

from . import Context, Drone, Mission, Results, Trip, Verdict


async def pollinate(drone: Drone, trip: Trip, context: Context, *, dose: float) -> object:
    """Do the action pollinate: the drone hovers at the trip's target.

    `dose` is in kilograms.
    `context.live(drone)` asks the drone what it measures, and sets what is built onto it.
    What it returns goes to the result store; raise ActionFailed if it cannot be done.
    """
    context.log("pollinate does nothing yet: write it in hooks.py")
    return None


def find_blooms(mission: Mission, results: Results) -> Verdict:
    """Judge a finished mission by what its actions gave."""
    return Verdict(ok=True, log=("find_blooms accepts every mission as yet: write it in hooks.py",))
