"""The end: a drone is landed before its link is closed, for closing a link may cut the motors."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import FlightFailed
from plutoc_runtime.domain.text import place

from .flying import DOWN, land
from .linking import CONNECT
from .vehicle import AMPLE, SPARE

if TYPE_CHECKING:
    from .linking import Linking
    from .vehicle import Member

LETTING_GO = 20.0
"""Seconds that a navigation may take to close a link."""
_TIMES, _PAUSE = 3, 1.0
"""How often a drone is told to land that does not; seconds in between."""


async def close(team: Sequence[tuple[Member, Linking]]) -> None:
    """Land all that fly, wait until they have landed, and let go of each.

    One limit holds for all landings: who must be connected to first has as long as who flies highest.
    """
    slowest = max((_seconds(member) for member, _ in team), default=0.0)
    until = asyncio.get_running_loop().time() + CONNECT + slowest
    await asyncio.gather(*(_close(member, linking, until) for member, linking in team))


def _seconds(member: Member) -> float:
    """Return for how long a landing from where it is may take."""
    return max(0.0, member.seen.location[2]) / member.climb * AMPLE + SPARE + DOWN


async def _close(member: Member, linking: Linking, until: float) -> None:
    member.break_off()
    with suppress(TimeoutError):
        async with asyncio.timeout_at(until):
            await _land(member, linking)
    if not member.seen.landed:
        member.lane.release()  # what was told to land comes down as far as it can
        where = place(member.seen.location)
        member.calls.say(f"{member.id} could not be landed: it may still hover at {where}")
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
