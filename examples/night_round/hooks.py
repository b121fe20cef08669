"""What the drones of a night round hear and see, and what is told of it."""

from __future__ import annotations

from . import Context, Drone, Mission, Photo, Results, Trip, Verdict

LISTENS = 2
"""How often a drone listens at a bed before a nurse is called."""

THINGS = ("bloom", "pest", "disease")
"""What a simulated camera can see: on the floor of a ward it stands for what lies about."""


async def listen(drone: Drone, trip: Trip, context: Context, *, seconds: float) -> float:
    """Hover beside the bed, and return how many breaths a minute the microphone hears."""
    microphone = context.live(drone)
    await context.sleep(seconds)
    return await microphone.read("breaths")


def breathes_calmly(mission: Mission, results: Results, *, beyond: float) -> Verdict:
    """Listen once more where a patient breathes too fast, and then call a nurse.

    `beyond`: by how many breaths a minute more than the mission's `most` a nurse is called at once.
    """
    heard = [result for result in results.new if result.trip.action == "listen"]
    breaths = max((result.value for result in heard if isinstance(result.value, float)), default=0)
    if breaths <= mission.most:
        return Verdict(log=[f"{mission.patient} sleeps: {breaths:.0f} breaths a minute"])
    if breaths <= mission.most + beyond and heard[-1].attempt < LISTENS:
        return Verdict(redo=[heard[-1].trip])
    return Verdict(log=[f"LOOK IN: {mission.patient} breathes {breaths:.0f} times a minute"])


def nothing_lies_about(mission: Mission, results: Results) -> Verdict:
    """Tell what lies on the floor, once for each place."""
    photos = [(one.trip, one.value) for one in results.new if isinstance(one.value, Photo)]
    seen = [trip.name for trip, photo in photos if any(thing in photo.sees for thing in THINGS)]
    found = f"something lies at {', '.join(seen)}" if seen else "nothing lies about"
    return Verdict(log=[f"{mission.name}: {found}; {len(photos)} photos"])
