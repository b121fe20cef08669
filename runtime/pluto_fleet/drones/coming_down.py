"""A drone that comes down by itself: its battery is low, or it is where none may be."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import FlightFailed
from plutoc_runtime.fleet.landing_sites import free_spot

from .flying import come_down as descend
from .flying import fly
from .stray import is_over_no_fly
from .vehicle import LAND

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.model import Point

    from .vehicle import Member

_PAUSE = 1.0
"""Seconds until it is tried again."""
_BESIDE = 0.5
"""Metres from other drones at which one lands that may not land below."""


async def come_down(member: Member, airspace: Airspace, others: Sequence[Point]) -> None:
    """Land here; who is over a no-fly area flies out of it first, the shortest way.

    One that does not know where it is goes nowhere: it stops, and lands.
    """
    try:
        await member.lane.run(LAND, partial(_down, member, airspace, others))
    except FlightFailed as error:
        member.calls.say(f"{member.id} was to land: {error}")
        await asyncio.sleep(_PAUSE)


async def _down(member: Member, airspace: Airspace, others: Sequence[Point]) -> None:
    here = member.seen.location
    if member.adrift:
        await member.hover()
    elif is_over_no_fly(airspace, here):
        x, y, _ = free_spot(airspace, here, others, _BESIDE)
        try:
            await fly(member, (x, y, min(max(here[2], _BESIDE), airspace.ceiling)))
        except FlightFailed as error:
            member.calls.say(f"{member.id} was to leave the no-fly area: {error}")
    await descend(member)
