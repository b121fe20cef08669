"""Flying a Crazyflie: each command, and waiting until its state shows that it is done."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from math import inf, isfinite

from ..drones.protocol import (
    NavigationError,
    NotReady,
    OutsideArea,
    PositionLost,
    Rejected,
    TargetTimeout,
)
from ..shared.domain.model import Point
from ..shared.domain.text import number
from . import commander, messages
from .session import CrazyflieSession
from .state import State
from .trajectory import NEAR, SLACK, braking, hovers, speed_limits_of

_SETTLES = 6.0
"""Seconds after its motors have stopped within which it may still report to fly."""
_SEEN = 1.0
"""Seconds until its state shows that a take-off has begun."""


def check(drone: str, target: Point, speed: float) -> None:
    """Refuse an invalid target or speed before anything moves."""
    if not all(map(isfinite, target)) or target[2] <= 0.0:
        raise OutsideArea(
            f"{drone} cannot go to ({', '.join(map(number, target))}): it must be finite, and above the ground"
        )
    check_speed(drone, speed)


def check_speed(drone: str, speed: float) -> None:
    if not 0.0 < speed < inf:
        raise Rejected(f"{drone} cannot fly at {number(speed)} m/s: a speed must be above 0")


async def takeoff(session: CrazyflieSession, height: float, speed: float) -> None:
    """Arm, take off straight up, and return when it hovers at this height."""
    x, y, z = session.well().position
    session.commanded = True
    seconds = speed_limits_of(session).seconds((x, y, z), (x, y, height), speed)
    try:
        if not await _begun(session, height, seconds) and not await _begun(
            session, height, seconds
        ):
            raise Rejected(
                f"{session.drone} accepted the take-off, and was disarmed at once, twice"
            )
    except (NotReady, Rejected):
        with suppress(NavigationError):
            if not (await session.fresh()).flies:
                await commander.disarm(session)
        raise
    await _hovering(session, lambda state: abs(state.position[2] - height), seconds, "risen")


async def _begun(session: CrazyflieSession, height: float, seconds: float) -> bool:
    """Begin a take-off; return False if it was disarmed just then."""
    await session.fresh()
    if await session.until(lambda state: not state.flies, _SETTLES) is None:
        raise Rejected(f"{session.drone} cannot take off: it says that it still flies")
    await commander.rearm(session)
    session.took_off_at = session.loop.time()
    try:
        await commander.takeoff(session, height, seconds)
    except Rejected:
        if await _is_disarmed(session):
            return False
        raise
    return not await _is_disarmed(session)


async def _is_disarmed(session: CrazyflieSession) -> bool:
    """Return whether it is disarmed within a moment, so that the take-off was not obeyed."""
    return await session.until(lambda state: not state.armed, _SEEN) is not None


async def go_to(session: CrazyflieSession, target: Point, speed: float) -> None:
    """Fly straight to a place, and return when it hovers there."""
    if not session.well().steered:
        raise Rejected(f"{session.drone} does not fly: it must take off first")
    if not session.now().finished:  # two trajectories in one blend into a third
        await hold(session)
    seconds = speed_limits_of(session).seconds(session.now().position, target, speed)
    await _fly_to(session, target, seconds, "arrived")


async def hold(session: CrazyflieSession) -> None:
    """Stop, and return when it hovers; nothing, if it does not fly."""
    await _may_rise(session)
    if session.well().steered:
        target, seconds = braking(session.before, session.now())
        if not session.doubts:
            await _fly_to(session, target, seconds, "stopped")
        else:  # at an unknown position: the best that can be done
            await commander.go_to(session, target, seconds, NEAR)
            await session.until(lambda state: state.finished, seconds + SLACK)


async def _may_rise(session: CrazyflieSession) -> None:
    """After a recent take-off command, wait until its state shows whether it rises."""
    since = session.loop.time() - session.took_off_at
    if since < _SEEN:
        await session.until(lambda state: state.steered, _SEEN - since)


async def land(session: CrazyflieSession, speed: float) -> None:
    """Land straight down, and return when the motors are off; does nothing if it does not fly.

    One that has just landed would start its motors again: its newest state decides.
    """
    await _may_rise(session)
    state = await session.fresh()
    if state.steered:
        limits = speed_limits_of(session)
        height = max(0.0, state.position[2])
        if session.doubts:  # the longer it flies, the farther it drifts
            seconds = limits.seconds_down_blind(height)
        else:
            seconds = limits.seconds_down(height, speed)
        session.commanded = True
        await commander.land(session, seconds)
        await _down(session, lambda state: not state.steered, seconds + SLACK)
    # Its motors are off. It reports to fly for two more seconds, and must get no command meanwhile.
    await _down(session, lambda state: not state.flies, _SETTLES)
    session.commanded = False


async def _fly_to(session: CrazyflieSession, target: Point, seconds: float, what: str) -> None:
    """Send it somewhere, and wait until it hovers there."""
    session.commanded = True
    await commander.go_to(session, target, seconds, NEAR)
    await _hovering(session, lambda state: state.distance(target), seconds, what)


async def _hovering(
    session: CrazyflieSession, off: Callable[[State], float], seconds: float, what: str
) -> None:
    """Wait until it is at the end of its trajectory, near and at rest, and knows where that is.

    Raises `PositionLost` for one that does not know any more where it is.
    """

    def there(state: State) -> bool:
        variance = session.confidence.variance
        if session.adrift and variance is not None:
            raise PositionLost(messages.lost_its_place(session.drone, variance))
        return state.finished and not session.doubts and hovers(session.recent, off)

    if await session.until(there, seconds + SLACK) is None:
        missing = number(off(session.now()))
        raise TargetTimeout(f"{session.drone} has not {what} in time: {missing} m are missing")


async def _down(session: CrazyflieSession, ready: Callable[[State], bool], limit: float) -> None:
    if await session.until(ready, limit) is None:
        raise TargetTimeout(f"{session.drone} has not come down in time")
