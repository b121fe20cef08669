"""What the drones over the alfalfa do with what they see (thesis 6.1.2)."""

from __future__ import annotations

from . import (
    ActionFailed,
    Context,
    Drone,
    Mission,
    Photo,
    Point,
    Results,
    Trip,
    Verdict,
)

DOSE = 20e-6
"""Kilograms of pollen for each bloom on a photo."""

TANK = 200e-6
"""Kilograms of pollen that a carrier takes along."""

RATE = 10e-6
"""Kilograms of pollen that it sheds in a second."""

SICK = ("pest", "disease")


async def pollinate(drone: Drone, trip: Trip, context: Context, *, dose: float) -> object:
    """Hover over the blooms until the dose is shed; what was shed goes to the result store."""
    if dose > TANK:
        raise ActionFailed(f"{dose * 1e6:.0f} mg is more than {drone.id} takes along")
    await context.sleep(dose / RATE)
    context.log(f"{drone.id} pollinated {place(trip.target)} with {dose * 1e6:.0f} mg")
    return dose


def find_blooms(mission: Mission, results: Results) -> Verdict:
    """Tell the farmer of sick plants, and have what blooms pollinated once.

    A place that a mission, this one or another, has pollinated in any round is left alone: the
    store keeps the results of all missions.
    """
    done = {result.trip.target for result in results.all if result.trip.action == "pollinate"}
    warnings: list[str] = []
    blooms: dict[Point, Trip] = {}
    for result in results.new:
        if not isinstance(result.value, Photo):
            continue
        sees, where = result.value.sees, result.trip.target
        warnings += [f"WARNING: {what} at {place(where)}" for what in SICK if what in sees]
        if "bloom" in sees and where not in done:
            blooms[where] = Trip(
                name=f"pollinate {result.trip.name}",
                action="pollinate",
                target=where,
                parameters={"dose": min(TANK, DOSE * sees.count("bloom"))},
            )
    return Verdict(add=tuple(blooms.values()), log=tuple(warnings))


def place(point: Point) -> str:
    """Return a place as the farmer reads it."""
    return f"({point[0]:.1f}, {point[1]:.1f})"
