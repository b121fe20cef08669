"""How one drone of the team flies: each command under a limit, one after the other in its lane."""

from __future__ import annotations

import asyncio
from functools import partial
from math import dist, inf
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import percent, place

from .seen import RISING
from .vehicle import LAND, RISE, SLOW

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .vehicle import Member

CUT = 2.0
"""Seconds within which motors must be off that a person wants off."""
DOWN = 3.0
"""Seconds after a landing until a drone must have told that it flies no more."""


async def takeoff(member: Member, height: float) -> None:
    """Rise straight up to a height; does nothing for a drone that flies."""
    await member.lane.run(RISE, partial(_take_off, member, height))


async def _take_off(member: Member, height: float) -> None:
    member.check()
    if not member.seen.landed:
        return
    reasons = await member.preflight()
    level, reserve = member.seen.battery_level, member.drone.category.reserve
    if level < reserve:
        left = f"{percent(level)} in its battery, and {percent(reserve)} are its reserve"
        reasons = (*reasons, left)
    if reasons:
        why = f"{member.id} is not ready: {'; '.join(reasons)}"
        raise FlightFailed(Failure.REFUSED, why)
    member.seen.rises_until, member.looked_after = inf, False
    try:
        await member.go(
            "take off", height / member.climb, member.navigation.takeoff, height, member.climb
        )
    finally:
        if member.linked:  # until it says whether it flies: the command may have reached it
            member.seen.rises_until = member.calls.clock() + RISING


async def go_to(member: Member, target: Point) -> None:
    """Fly straight to a point."""
    await member.lane.run("fly", partial(_fly_to, member, target))


async def _fly_to(member: Member, target: Point) -> None:
    member.check()
    in_the_air(member)
    await fly(member, target)


async def fly(member: Member, target: Point) -> None:
    """Fly straight to a point, whatever it takes no commands for."""
    seconds = dist(member.seen.location, target) / min(member.speed, SLOW)
    what = f"arrive at {place(target)}"
    await member.go(what, seconds, member.navigation.go_to, target, member.speed)


async def land(member: Member) -> None:
    """Land here; does nothing for a drone that stands on the ground."""
    await member.lane.run(LAND, partial(come_down, member))


async def come_down(member: Member) -> None:
    """Land here, whatever it takes no commands for, if only it is linked."""
    if member.seen.landed:
        return
    if member.is_cut:
        raise _cut(member)
    if not member.linked:
        member.check()
    seconds = max(0.0, member.seen.location[2]) / member.climb
    await member.go("land", seconds, member.navigation.land, member.climb)
    member.seen.rises_until = -inf
    # what it told last may be older than that
    if not await member.until(lambda: member.seen.landed, DOWN):
        raise FlightFailed(Failure.ACTION, f"{member.id} was to land, and flies all the same")


async def hold(member: Member) -> None:
    """Hover, until it is told not to or something goes wrong."""
    await member.lane.run("hover", partial(_hold, member))


async def _hold(member: Member) -> None:
    member.check()
    in_the_air(member)
    await asyncio.get_running_loop().create_future()


async def cut(member: Member) -> None:
    """Switch its motors off, now: whatever it does ends so, and it does not even hover."""
    member.is_cut = True
    member.lane.release()
    try:
        await member.calls.call("switch its motors off", CUT, member.navigation.emergency_stop)
    except FlightFailed:  # it could not be told: it flies on
        member.is_cut = False
        raise
    member.must_land = False
    member.refuse(_cut(member))


def _cut(member: Member) -> FlightFailed:
    return FlightFailed(Failure.CRASH, f"{member.id}'s motors were cut")


def in_the_air(member: Member) -> None:
    """Raise `FlightFailed` for a drone that stands on the ground."""
    if member.seen.landed:
        where = place(member.seen.location)
        reason = f"{member.id} is on the ground at {where}: it must take off first"
        raise FlightFailed(Failure.REFUSED, reason)
