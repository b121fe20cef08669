"""The end: a drone is landed before its link is closed, for closing a link may cut the motors."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from ..errors import FlightFailed
from ..words import place
from .flying import land

if TYPE_CHECKING:
    from .linking import Linking
    from .member import Member

LETTING_GO = 20.0
"""Seconds that a navigation may take to close a link."""
_TIMES, _PAUSE = 3, 1.0
"""How often a drone is told to land that does not; seconds in between."""


async def close(member: Member, linking: Linking) -> None:
    """Land a drone if it flies, wait until it has landed, and let go of it."""
    member.break_off()
    await _land(member, linking)
    linking.stop()
    await member.calls.parted()
    try:
        await member.calls.call("close its link", LETTING_GO, member.navigation.close)
    except FlightFailed as error:
        member.calls.say(str(error))
    member.linked = False
    await member.calls.parted()


async def _land(member: Member, linking: Linking) -> None:
    for _ in range(_TIMES):
        if member.seen.landed:
            return
        await linking.once()
        try:
            await land(member)
        except FlightFailed as error:
            member.calls.say(f"{member.id} was to land: {error}")
            await asyncio.sleep(_PAUSE)
    if not member.seen.landed:
        where = place(member.seen.location)
        member.calls.say(f"{member.id} could not be landed: it may still hover at {where}")
