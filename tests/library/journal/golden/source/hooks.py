"""What the farm's drones do with what they see."""

from __future__ import annotations

from . import Context, Drone, Mission, Results, Trip, Verdict


async def sprinkle(drone: Drone, trip: Trip, context: Context, *, dose: float) -> object:
    """Hover until the dose is shed."""
    await context.sleep(3.0)
    return {"dose": dose, "by": drone.id}


def look_again(mission: Mission, results: Results) -> Verdict:
    """Have one more look at what was photographed first, once."""
    names = {trip.name for trip in mission.completed_trips}
    if mission.name != "North" or "second look" in names:
        return Verdict()
    first = mission.completed_trips[0]
    look = Trip(name="second look", action="measure", target=first.target, delay=10.0)
    return Verdict(add=(look,), log=("one more look",))
