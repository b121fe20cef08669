"""Lets a Crazyflie forget a crash, once somebody has looked after it: until then it does not arm."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..drones.errors import NotReady
from . import words
from .commander import answered, forget_course
from .driver import SUPERVISOR

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf

    from .session import Session

_RECOVER, _DONE = 2, 1
_SHOWS = 3.0
"""Seconds until it says that it is as before."""


async def recover(session: Session) -> None:
    """Ask it for that; nothing, where it has not crashed. No motor turns by it.

    Raises `NotReady` for one that does not stand upright.
    """
    state = session.now()
    if not state.crashed:
        return
    if state.has_course:  # one that arms itself would fly on along it
        await forget_course(session)

    def send(cf: Cf) -> None:
        cf.supervisor.send_crash_recovery_request()

    answer = await answered(session, (SUPERVISOR, _RECOVER), send, "recover", well=False)
    done = answer[1] == _DONE
    if not done or await session.until(lambda now: not now.crashed, _SHOWS, well=False) is None:
        raise NotReady(words.not_recovered(session.drone))
