"""What patrols see, what is made of it, and what a broken bound sets free."""

from __future__ import annotations

from . import (
    Context,
    Drone,
    IntruderEvent,
    Mission,
    PicturedEvent,
    Status,
    Trip,
)

LOOKS = 0.25
"""Seconds from one look to the next."""
STAYS = 90.0
"""Seconds for which a drone stays with whom it has a picture of."""
URGENT = 10
"""The priority of a picture that is to be taken within a bound."""


async def look(drone: Drone, trip: Trip, context: Context, reach: float, bound: float) -> None:
    """Say on the way whom the camera sees; each is an intruder once.

    `reach` is how many metres from somebody a camera still has them on its picture, from the usual height; within
    `bound` seconds there is to be one.
    """
    camera = context.live(drone)
    while True:
        for seen in await camera.sees():
            context.emit(
                "intruder",
                id=f"seen {seen.track}",
                at=seen.at,
                track=seen.track,
                kind=seen.kind,
                reach=reach,
                bound=bound,
            )
        await context.sleep(LOOKS)


def chase(event: IntruderEvent, context: Context) -> Mission | None:
    """Take a picture of an intruder, within the bound."""
    if event.at is None or event.track is None:
        return None  # its place is not known
    picture = Trip(
        name="picture",
        action="take_photo",
        target=event.at,
        track=event.track,
        reach=event.reach,
        priority=URGENT,
    )
    return Mission(name=f"chase {event.track}", trips=[picture], promises={"deadline": event.bound})


def tell_pictured(mission: Mission, context: Context) -> None:
    """Say that there is a picture of whom a chase was after."""
    for trip in mission.completed_trips:
        if trip.track is not None and trip.action == "take_photo":
            context.emit(
                "pictured",
                id=f"pictured {trip.track}",
                at=trip.target,
                track=trip.track,
                reach=trip.reach,
            )


def stay_with(event: PicturedEvent, context: Context) -> Mission | None:
    """Stay with an intruder, and take a picture every two seconds."""
    if event.at is None:
        return None
    follow = Trip(
        name="follow",
        action="follow",
        target=event.at,
        track=event.track,
        reach=event.reach,
        parameters={"for": STAYS, "every": 2.0},
    )
    return Mission(name=f"stay with {event.track}", trips=[follow])


def release(mission: Mission, context: Context) -> Status:
    """Let go of who is stayed with: a bound is broken, and the drone is wanted for the others."""
    context.log("let go: there is a picture, and a bound is broken")
    mission.trips.clear()
    return Status.COMPLETED
