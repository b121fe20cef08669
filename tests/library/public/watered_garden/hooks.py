"""What the app does that its graph does not say."""

from __future__ import annotations

from . import Context, Drone, Mission, Results, Status, Trip, Verdict


async def water(drone: Drone, trip: Trip, context: Context, *, amount: float) -> object:
    """Pour water on the bed below, in two halves."""
    live = context.live(drone)
    for half in (0.5, 1.0):
        context.log(f"{drone.id} pours on {trip.name}")
        await context.sleep(10.0)
        await live.write("tank.poured", half * amount)
    return await live.read("tank.poured")


def dry_beds(mission: Mission, results: Results) -> Verdict:
    """Have each bed watered that was looked at."""
    looked = [result.trip for result in results.new if result.trip.action == "take_photo"]
    beds = tuple(
        Trip(name=f"water {trip.name}", action="water", target=trip.target) for trip in looked
    )
    poured = [result.value for result in results.new if result.trip.action == "water"]
    return Verdict(add=beds, log=(f"looked at {len(looked)}, watered {len(poured)}",))


async def call_back(mission: Mission, context: Context, *, limit: float) -> Status:
    """Give the trip that flies its time, then fail it."""
    trip = mission.current
    if not await context.trip_ended(trip, within=limit):
        return Status.FAILED
    return mission.status


def once_more(mission: Mission, context: Context) -> Status:
    """Fly a failed trip a second time."""
    trip = mission.current
    if trip.attempt >= 2:
        return Status.FAILED
    context.log(f"{trip.name} is tried again")
    trip.reset()
    return Status.STANDBY
