"""Switches the motors off, in the air too: only ever because a person has said just that."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from ..drones.errors import LinkLost
from . import words
from .driver import LOCALIZATION, packet
from .worker import Worker

if TYPE_CHECKING:
    from .session import Session
    from .state import State

_TIMES, _EACH = 5, 0.2
"""How often it is sent, and for how many seconds its effect is waited for each time."""
_OLD_CHANNEL, _OLD_STOP = 1, b"\3"


async def cut(session: Session) -> None:
    """Send it until it shows, in a thread of its own: what else is to be sent waits, this does not."""
    cf = session.cf
    if cf.platform.get_protocol_version() >= words.PROTOCOL:
        send = cf.supervisor.send_emergency_stop
    else:

        def send() -> None:
            cf.send_packet(packet(LOCALIZATION, _OLD_CHANNEL, _OLD_STOP))

    def off(state: State) -> bool:
        return not state.steered and (state.locked or state.crashed or not state.flies)

    worker = Worker(f"the emergency stop of {session.drone}")
    try:
        for _ in range(_TIMES):
            await worker.call(send, 2.5)
            try:
                if await session.until(off, _EACH, well=False) is not None:
                    return
            except LinkLost:  # it may hear, though it is not heard
                await asyncio.sleep(_EACH)
    finally:
        worker.end()
    raise LinkLost(words.not_stopped(session.drone))
