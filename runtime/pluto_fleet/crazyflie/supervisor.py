"""Requests to the firmware's supervisor: arming, crash recovery, and the emergency stop.

The firmware disarms some seconds after a landing, or after an unused arming, and can then not be armed for a
tenth of a second. A take-off at that moment is refused, or accepted and then cancelled. So a drone is
rearmed for each take-off, verified by its state after each command: a drone that has just been armed has
all of that time left.
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
"""The time-out until it can be armed, in seconds."""
_ARMED = 3.0
"""The time-out until it is armed, in seconds: some spin up their motors for that."""
_SHOWS = 0.25
"""Seconds of its own clock after which a state is surely newer than its answer."""
_DONE = 1


async def rearm(session: CrazyflieSession) -> None:
    """Rearm it on the ground, whether it is armed or not; raise `NotReady` if that fails.

    It must not fly, as disarming would drop it: the caller has checked that.
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
    """Disarm it; only on the ground, as in the air it would fall."""
    await _ask(session, False)


async def _armed(session: CrazyflieSession) -> bool:
    """Arm it as soon as possible, unless it arms automatically, and verify that."""
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
        await session.fresh()  # the state was outdated
    return False


def _is_back(at: State, now: State) -> bool:
    """Whether it has armed itself since this state, as some builds do."""
    return now.arms_itself and now.since(at) > _SHOWS and now.armed and now.can_fly


async def _ask(session: CrazyflieSession, on: bool) -> bool:
    key = (SUPERVISOR, _ARM)
    answer = await answered(session, key, lambda cf: cf.supervisor.send_arming_request(on), "arm")
    return answer[1] == _DONE


_RECOVER = 2
_RECOVERED = 3.0
"""The time-out of a crash recovery, in seconds."""


async def recover_from_crash(session: CrazyflieSession) -> None:
    """Request a crash recovery; does nothing if it has not crashed. Starts no motor.

    Raises `NotReady` if it is not upright.
    """
    state = session.now()
    if not state.crashed:
        return
    if state.has_trajectory:  # one that arms itself would continue it
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
"""How often it is sent, and the seconds to wait for its effect each time."""
_OLD_CHANNEL, _OLD_STOP = 1, b"\3"


async def stop_motors(session: CrazyflieSession) -> None:
    """Send an emergency stop until it takes effect, in a thread of its own, ahead of all other commands."""
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
            except LinkLost:  # it may receive even if nothing is received from it
                await asyncio.sleep(_EACH)
    finally:
        worker.end()
    raise LinkLost(f"{session.drone} did not confirm that its motors are off")
