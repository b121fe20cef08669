"""What the app does with its photos, and how a drone takes along what it finds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from . import Context, Drone, Mission, Photo, Result, Results, Trip, Verdict

GRIP_SECONDS = 4.0
"""How long the magnet of a fetcher needs to get hold of a thing."""

SHARP = 0.7
"""A photo less sharp than this proves nothing by what it does not show."""

LOOKS = 3
"""How often a place is photographed at most."""


async def bring_back(drone: Drone, trip: Trip, context: Context, *, thing: str) -> object:
    """Get hold of the thing below. The dock is on its owner's desk: the way home delivers it."""
    await context.sleep(GRIP_SECONDS)
    context.log(f"{drone.id} brings the {thing} home")
    return thing


def who_saw_it(mission: Mission, results: Results) -> Verdict:
    """Send a fetcher to where the thing was seen best; look again where a photo is blurred."""
    thing = wanted(mission)
    if any(result.trip.action == "bring_back" for result in results.new):
        return Verdict(log=(f"{thing} brought back",))
    photos = list(photos_of(results.new))
    seen = [(photo.sharpness, result.trip) for result, photo in photos if thing in photo.sees]
    if seen:
        _, trip = max(seen, key=lambda sight: sight[0])
        fetch = Trip(
            name=f"bring the {thing}",
            action="bring_back",
            target=trip.target,
            parameters={"thing": thing},
        )
        return Verdict(add=(fetch,), log=(f"{thing} seen: {trip.name}",))
    blurred = tuple(
        result.trip
        for result, photo in photos
        if photo.sharpness < SHARP and result.attempt < LOOKS
    )
    if blurred:
        return Verdict(redo=blurred, log=(f"looking again, blurred photos: {len(blurred)}",))
    return Verdict(log=(f"{thing} not found here",))


def wanted(mission: Mission) -> str:
    """Return what a mission looks for: its name up to the colon, as in `keys: kitchen`."""
    return mission.name.partition(":")[0].strip()


def photos_of(results: Sequence[Result]) -> Iterator[tuple[Result, Photo]]:
    """Yield the results that are photos."""
    for result in results:
        if isinstance(result.value, Photo):
            yield result, result.value
