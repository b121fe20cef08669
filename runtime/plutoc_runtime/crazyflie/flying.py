"""What a Crazyflie is told to fly, each from the command to what it tells when that is done."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from ..drones.errors import NavigationError, OutsideArea, Rejected, TargetTimeout
from . import commander, words
from .courses import NEAR, SLACK, is_speed, is_target, seconds_for, stop

if TYPE_CHECKING:
    from ..model import Point
    from .session import Session
    from .state import State

_SETTLES = 6.0
"""Seconds after its motors have stopped in which it may still count as flying."""
_SEEN = 1.0
"""Seconds until it shows that a take-off has begun."""


def check(drone: str, target: Point, speed: float) -> None:
    """Refuse, before anything moves, what cannot be flown."""
    if not is_target(target):
        raise OutsideArea(words.outside(drone, target))
    check_speed(drone, speed)


def check_speed(drone: str, speed: float) -> None:
    """Refuse what is no speed."""
    if not is_speed(speed):
        raise Rejected(words.no_speed(drone, speed))


async def takeoff(session: Session, height: float, speed: float) -> None:
    """Arm, rise straight up, and return when it hovers at this height."""
    # a drone that has just landed is disarmed some time soon: not now
    await session.until(lambda state: not state.flies, _SETTLES)
    await commander.arm(session, True)
    height_now = session.well().position[2]
    session.took_off_at, session.commanded = session.loop.time(), True
    seconds = seconds_for(abs(height - height_now), speed)
    try:
        await _begin(session, height, seconds)
    except Rejected:
        with suppress(NavigationError):
            await commander.arm(session, False)
        raise

    def risen(state: State) -> bool:
        return state.finished and abs(state.position[2] - height) < NEAR

    if await session.until(risen, seconds + SLACK) is None:
        off = abs(session.now().position[2] - height)
        raise TargetTimeout(words.not_arrived(session.drone, "risen", off))


async def _begin(session: Session, height: float, seconds: float) -> None:
    """Begin to rise; once more, if it was disarmed at the very moment, as it is some time after use."""
    try:
        await commander.takeoff(session, height, seconds)
    except Rejected:
        if await session.until(lambda state: not state.armed, _SEEN) is None:
            raise
        await commander.arm(session, True)
        await commander.takeoff(session, height, seconds)


async def go_to(session: Session, target: Point, speed: float) -> None:
    """Fly straight to a place, and return when it hovers there."""
    if not session.well().steered:
        raise Rejected(words.not_flying(session.drone))
    if not session.now().finished:  # two courses in one make a third that nobody has asked for
        await hold(session)
    await _course(session, target, seconds_for(session.now().distance(target), speed), "arrived")


async def hold(session: Session) -> None:
    """Stop, and return when it hovers; nothing, if it does not fly."""
    since = session.loop.time() - session.took_off_at
    if since < _SEEN:  # it may be about to
        await session.until(lambda state: state.steered, _SEEN - since)
    if session.well().steered:
        target, seconds = stop(session.before, session.now())
        await _course(session, target, seconds, "stopped")


async def land(session: Session, speed: float) -> None:
    """Come down straight, and return when the motors are off; nothing, if it does not fly."""
    state = session.well()
    if state.steered:
        seconds = seconds_for(max(0.0, state.position[2]), speed)
        session.commanded = True
        await commander.land(session, seconds)
        await _down(session, lambda state: not state.steered, seconds + SLACK)
    # Its motors are off. It says for two more seconds that it flies, and must be let alone so long.
    await _down(session, lambda state: not state.flies, _SETTLES)
    session.commanded = False


async def _course(session: Session, target: Point, seconds: float, what: str) -> None:
    """Send it somewhere, and wait until it is there and hovers."""
    session.commanded = True
    await commander.go_to(session, target, seconds, NEAR)

    def there(state: State) -> bool:
        return state.finished and state.distance(target) < NEAR

    if await session.until(there, seconds + SLACK) is None:
        off = session.now().distance(target)
        raise TargetTimeout(words.not_arrived(session.drone, what, off))


async def _down(session: Session, ready: Callable[[State], bool], limit: float) -> None:
    if await session.until(ready, limit) is None:
        raise TargetTimeout(words.not_landed(session.drone))
