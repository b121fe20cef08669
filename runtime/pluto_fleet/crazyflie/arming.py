"""Arms a Crazyflie for a take-off, always anew, and by nothing but what it tells after each command.

Its firmware disarms some seconds after a landing, or after an arming that nobody used, and is for a
tenth of a second neither armed nor ready to be. A take-off at that moment is refused, or accepted and
then cancelled. Who has just been armed has all of that time before it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..drones.errors import NotReady
from . import words
from .commander import answered, forget_course, let_commander_rule
from .driver import SUPERVISOR

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf

    from .session import Session
    from .state import State

_ARM = 1
_READY = 7.0
"""Seconds until it can be armed: one that was disarmed may only see that when it would have been so."""
_ARMED = 3.0
"""Seconds until it is armed: some start their motors slowly for that."""
_SHOWS = 0.25
"""Seconds of its own clock after which what it tells is surely later than its answer."""
_DONE = 1


async def arm_anew(session: Session) -> None:
    """Arm it on the ground, whether it is armed or not; raise `NotReady` if it will not.

    Nothing may be disarmed that flies: whoever calls this has seen that it does not.
    """
    state = session.well()
    await let_commander_rule(session)
    if state.has_course:
        await forget_course(session)
    if state.armed:
        await disarm(session)
    if not await _armed(session):
        raise NotReady(words.not_armed(session.drone, session.now().said))


async def disarm(session: Session) -> None:
    """Take its arming away: only ever on the ground, for in the air it falls."""
    await _ask(session, False)


async def _armed(session: Session) -> bool:
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


async def _ask(session: Session, on: bool) -> bool:
    def send(cf: Cf) -> None:
        cf.supervisor.send_arming_request(on)

    answer = await answered(session, (SUPERVISOR, _ARM), send, "arm")
    return answer[1] == _DONE
