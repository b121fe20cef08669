"""Reliable commands: each is sent again until it is acknowledged.

They are idempotent: a trajectory to a place stays the same, a landing goes on, and a take-off is refused by
a drone that has begun one, which its state then shows.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, inf
from typing import TYPE_CHECKING

from ..drones.errors import LinkLost, Rejected
from . import messages
from .driver import HIGH_LEVEL

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf

    from .session import CrazyflieSession
    from .state import State

_ACKNOWLEDGED = 0.25
"""The time-out of an answer in seconds; over the radio it comes within ten milliseconds."""
_TIMES = 8
_STOP, _TAKEOFF, _LAND, _GO_TO = 3, 7, 8, 12
_DONE, _WRONG_STATE, _BLOCKED = 0, 1, 16
_SEEN = 0.6
"""Seconds until a new trajectory shows in its state."""


async def enable_high_level(session: CrazyflieSession) -> None:
    """Release the priority of low-level setpoints that were sent since it was started; on the ground only.

    They override its high-level commander, whose commands are then acknowledged and not obeyed. This
    is not acknowledged, so it is sent twice.
    """
    for _ in range(2):
        await session.call(lambda cf: cf.commander.send_notify_setpoint_stop())


async def drop_trajectory(session: CrazyflieSession) -> None:
    """Drop a trajectory that its supervisor has cancelled, and by which no motor turns."""
    key = (HIGH_LEVEL, _STOP)
    await answered(session, key, lambda cf: cf.high_level_commander.stop(), "stop", well=False)


async def takeoff(session: CrazyflieSession, height: float, seconds: float) -> None:
    """Begin a take-off with the present heading; one that is disarmed meanwhile does not."""

    def begin(cf: Cf) -> None:
        cf.high_level_commander.takeoff(height, seconds, yaw=None)

    def begun(state: State) -> bool:
        return state.steered or not state.armed

    key = (HIGH_LEVEL, _TAKEOFF)
    for _ in range(3):
        await enable_high_level(session)  # a setpoint may have been sent while it was armed
        code = (await answered(session, key, begin, "takeoff"))[3]
        if code == _WRONG_STATE and await session.until(begun, _SEEN) is not None:
            return  # the answer to the same command, sent twice
        _check(session, "takeoff", code)
        if await session.until(begun, _SEEN) is not None:
            return
    raise Rejected(messages.not_begun(session.drone, "takeoff"))


async def land(session: CrazyflieSession, seconds: float) -> None:
    """Begin a landing with the present heading.

    It is not repeated when the drone may have landed, as its motors would start again; then its state
    decides.
    """
    over = session.loop.time() + seconds

    def begin(cf: Cf) -> None:
        cf.high_level_commander.land(0.0, seconds, yaw=None)

    code = (await answered(session, (HIGH_LEVEL, _LAND), begin, "land", until=over))[3]
    if code != _WRONG_STATE:  # it answers so if it is landing already
        _check(session, "land", code)


async def go_to(
    session: CrazyflieSession, target: tuple[float, float, float], seconds: float, near: float
) -> None:
    """Begin to fly to a place with the present heading.

    An answer may belong to an earlier such command that was sent twice: only a movement shows that
    this one has arrived.
    """
    x, y, z = target
    yaw = session.now().yaw

    def begin(cf: Cf) -> None:
        cf.high_level_commander.go_to(x, y, z, yaw, seconds)

    def begun(state: State) -> bool:
        return not state.finished or state.distance(target) < near

    for _ in range(3):
        code = (await answered(session, (HIGH_LEVEL, _GO_TO), begin, "go_to"))[3]
        _check(session, "go_to", code)
        if await session.until(begun, _SEEN) is not None:
            return
    raise Rejected(messages.not_begun(session.drone, "go_to"))


async def answered(
    session: CrazyflieSession,
    key: tuple[int, int],
    send: Callable[[Cf], None],
    name: str,
    *,
    well: bool = True,
    until: float = inf,
) -> bytes:
    """Send a command until it is answered; return the answer, four bytes at least.

    Raises what `well` raises, except for commands to a failing drone. From `until` on it is not sent
    again, and counts as done.
    """
    look = session.well if well else session.now
    for _ in range(max(_TIMES, ceil(session.silence / _ACKNOWLEDGED))):
        look()
        if session.loop.time() >= until:
            return bytes(4)
        hearing = session.acknowledged.expect(key)
        try:
            await session.call(send)
            answer = await session.acknowledged.heard(hearing, _ACKNOWLEDGED)
        finally:
            session.acknowledged.drop(key, hearing)
        if answer is not None:
            return answer.ljust(4, b"\0")
    raise LinkLost(f"{session.drone} did not acknowledge the command {name}")


def _check(session: CrazyflieSession, name: str, code: int) -> None:
    """Raise the error in an acknowledgement, if any."""
    if code == _DONE:
        return
    state = session.well()
    if code == _BLOCKED:
        raise Rejected(
            f"{session.drone} refuses the command {name}:"
            f" its supervisor blocks flight ({state.said})"
        )
    if code == _WRONG_STATE:
        raise Rejected(f"{session.drone} refuses the command {name}: not in this state")
    raise Rejected(f"{session.drone} refuses the command {name}: error {code}")
