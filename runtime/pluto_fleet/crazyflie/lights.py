"""Shows which Crazyflie it is: its lights blink, and are afterwards as before."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from . import parameters

if TYPE_CHECKING:
    from .session import Session

_LIGHTS = "led.bitmask"
_OURS, _ALL = 0x80, 0x3F
"""This bit takes the lights from the firmware; these are all of them."""
_TIMES, _SECONDS = 8, 0.25


async def blink(session: Session) -> None:
    """Blink for four seconds, or beep once where its firmware lets nobody have the lights."""
    if parameters.element_of(session.cf, _LIGHTS) is None:
        await session.call(lambda cf: cf.platform.send_user_notification(True))
        return
    before = await parameters.read(session, _LIGHTS)
    try:
        for _ in range(_TIMES):
            for value in (_OURS | _ALL, _OURS):
                await parameters.write(session, _LIGHTS, value)
                await asyncio.sleep(_SECONDS)
    finally:
        await asyncio.shield(parameters.write(session, _LIGHTS, before))
