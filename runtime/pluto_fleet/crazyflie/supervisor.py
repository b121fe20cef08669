"""What is asked of the firmware's supervisor: arming, crash recovery, and the emergency stop.

The firmware disarms some seconds after a landing, or after an arming that was not used, and is for a
tenth of a second neither armed nor ready to be. A take-off at that moment is refused, or accepted and
then cancelled. So a drone is armed anew for each take-off, by nothing but what it tells after each
command: one that has just been armed has all of that time before it.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from ..drones.errors import LinkLost, NotReady
from . import messages
from .commander import answered, drop_trajectory, enable_high_level
from .driver import LOCALIZATION, SUPERVISOR, packet
from .worker import Worker

if TYPE_CHECKING:
    from .session import CrazyflieSession
    from .state import State


_ARM = 1
_READY = 7.0
"""Seconds until it can be armed: one that was disarmed may only see that when it would have been so."""
_ARMED = 3.0
"""Seconds until it is armed: some start their motors slowly for that."""
_SHOWS = 0.25
"""Seconds of its own clock after which what it tells is surely later than its answer."""
_DONE = 1


async def rearm(session: CrazyflieSession) -> None:
    """Arm it on the ground, whether it is armed or not; raise `NotReady` if it will not.

    Nothing may be disarmed that flies: the caller has seen that it does not.
    """
    state = session.well()
    await enable_high_level(session)
    if state.has_trajectory:
        await drop_trajectory(session)
    if state.armed:
        await disarm(session)
    if not await _armed(session):
        raise NotReady(f"{session.drone} will not arm ({session.now().said})")


async def disarm(session: CrazyflieSession) -> None:
    """Take its arming away: only ever on the ground, for in the air it falls."""
    await _ask(session, False)


async def _armed(session: CrazyflieSession) -> bool:
    """Arm it as soon as it can be, unless its build has done that; and see that it is so."""
    at, end = session.well(), session.loop.time() + _READY

    def ready(now: State) -> bool:
        return _is_back(at, now) or (now.can_arm and not now.armed)

    while (left := end - session.loop.time()) > 0.0:
        state = await session.until(ready, left)
        if state is None:
            return False
        if state.armed:
            return True
        if await _ask(session, True):
            return await session.until(lambda now: now.armed and now.can_fly, _ARMED) is not None
        await session.fresh()  # it was not so any more
    return False


def _is_back(at: State, now: State) -> bool:
    """Whether it has armed itself, as some builds do, since it told this."""
    return now.arms_itself and now.since(at) > _SHOWS and now.armed and now.can_fly


async def _ask(session: CrazyflieSession, on: bool) -> bool:
    key = (SUPERVISOR, _ARM)
    answer = await answered(session, key, lambda cf: cf.supervisor.send_arming_request(on), "arm")
    return answer[1] == _DONE


_RECOVER = 2
_RECOVERED = 3.0
"""Seconds until it says that it is as before."""


async def recover_from_crash(session: CrazyflieSession) -> None:
    """Ask it for that; nothing, where it has not crashed. No motor turns by it.

    Raises `NotReady` for one that does not stand upright.
    """
    state = session.now()
    if not state.crashed:
        return
    if state.has_trajectory:  # one that arms itself would fly on along it
        await drop_trajectory(session)
    answer = await answered(
        session,
        (SUPERVISOR, _RECOVER),
        lambda cf: cf.supervisor.send_crash_recovery_request(),
        "recover",
        well=False,
    )
    done = answer[1] == _DONE
    if not done or await session.until(lambda now: not now.crashed, _RECOVERED, well=False) is None:
        raise NotReady(
            f"{session.drone} does not forget that it has crashed: set it upright,"
            " or switch it off and on"
        )


_TIMES, _EACH = 5, 0.2
"""How often it is sent, and for how many seconds its effect is waited for each time."""
_OLD_CHANNEL, _OLD_STOP = 1, b"\3"


async def stop_motors(session: CrazyflieSession) -> None:
    """Send it until it shows, in a thread of its own: what else is to be sent waits, this does not."""
    cf = session.cf
    if cf.platform.get_protocol_version() >= messages.PROTOCOL:
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
    raise LinkLost(f"{session.drone} did not confirm that its motors are off")
