"""After a failed flight: until a drone takes commands again, or somebody has put it home."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import place

from .vehicle import LOOK

if TYPE_CHECKING:
    from .linking import Linking
    from .vehicle import Member

REACH = 120.0
"""Seconds for which a drone that lost its link is connected to again and again."""
SETTLING = 10.0
"""Seconds that one on the ground gets until it is ready: its position may have to settle."""
FETCH = 600.0
"""Seconds within which somebody must have put it home."""
OFTEN = 2.0
"""Seconds between two looks."""


async def reach(member: Member, linking: Linking) -> bool:
    """Wait until a drone takes commands, or is down where only a person can help it.

    False: it is lost, for all that can be done from here.
    """
    if not await linking.within(REACH):
        return False
    if not await _comes_down(member, linking):
        return False
    if not await member.hears_of_care():
        return False
    if not member.seen.landed:
        return member.down is None
    return member.needs_a_hand or await _is_ready(member)


async def _comes_down(member: Member, linking: Linking) -> bool:
    """Wait while a drone lands by itself, or has not yet said whether it flies or lies there."""
    patience = round(SETTLING / LOOK)
    while member.seen.is_rising or (not member.seen.landed and member.down is not None):
        await asyncio.sleep(LOOK)
        patience -= not member.must_land
        if patience < 0 or not (member.linked or await linking.within(REACH)):
            return False
    return True


async def _is_ready(member: Member) -> bool:
    """Say whether one on the ground can fly on, or may be waited for."""
    until = member.calls.clock() + SETTLING
    while (reasons := await _reasons(member)) and member.calls.clock() < until:
        await asyncio.sleep(OFTEN)
    if not reasons:
        member.is_well()
    elif member.has_crashed:
        return False
    else:
        why = f"{member.id} is not ready: {'; '.join(reasons)}"
        member.refuse(FlightFailed(Failure.REFUSED, why), needs_a_hand=True)
    return True


async def fetched(member: Member) -> bool:
    """Wait until a drone stands at home, ready; False: nobody has put it there, or it has crashed.

    One that has crashed on its way is lost: else nobody could say that it was looked after.
    """
    said: tuple[str, ...] = ()
    try:
        async with asyncio.timeout(FETCH):
            while missing := await _missing(member):
                if member.has_crashed or not await member.hears_of_care():
                    return False
                _lands(member)
                if missing != said:
                    member.calls.say(f"{member.id} is waited for: {'; '.join(missing)}")
                    said = missing
                await asyncio.sleep(OFTEN)
    except TimeoutError:
        return False
    member.is_well()
    return True


def _lands(member: Member) -> None:
    """See to it that a drone comes down which nobody commands any more."""
    if member.linked and not member.seen.landed and not member.must_land:
        where = place(member.seen.location)
        why = f"{member.id} could not be flown home: it lands at {where}"
        member.must_come_down(member.down or FlightFailed(Failure.REFUSED, why))


async def _missing(member: Member) -> tuple[str, ...]:
    """Return what keeps it from being flown again."""
    if member.linked and not member.is_docked:
        return (f"put it home, at {place(member.drone.home)}",)
    return await _reasons(member)


async def _reasons(member: Member) -> tuple[str, ...]:
    """Return why it may not fly; one that can be charged where it stands is well, but for that."""
    if not member.linked:
        return (member.out_of_reach,)
    if member.is_docked and member.seen.battery_level < member.drone.category.reserve:
        return member.lacks()
    return (*await member.preflight(), *member.lacks())
