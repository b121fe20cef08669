"""Reliable commands, each sent again until it is acknowledged, and requests to the firmware's supervisor.

Commands are idempotent: a trajectory to a place stays the same, a landing goes on, and a take-off is refused
by a drone that has begun one, which its state then shows.

The firmware disarms some seconds after a landing, or after an unused arming, and can then not be armed for a
tenth of a second. A take-off at that moment is refused, or accepted and then cancelled. So a drone is
rearmed for each take-off, verified by its state after each command: a drone that has just been armed has
all of that time left.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from math import ceil, inf
from typing import TYPE_CHECKING

from ..drones.protocol import LinkLost, NotReady, Rejected
from . import messages
from .course import Course
from .driver import HIGH_LEVEL, LOCALIZATION, SUPERVISOR, packet
from .session import CrazyflieSession, Worker
from .state import State

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf


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
    session.sets_out(None)

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
    session.sets_out(Course(session.setpoint, target, seconds))

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
        answer = await session.answer(key, send, _ACKNOWLEDGED)
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


_ARM = 1
_READY = 7.0
"""The time-out until it can be armed, in seconds."""
_ARMED = 3.0
"""The time-out until it is armed, in seconds: some spin up their motors for that."""
_SHOWS = 0.25
"""Seconds of its own clock after which a state is surely newer than its answer."""
_GRANTED = 1


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
    at = session.well()
    end = session.loop.time() + _READY

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
    return answer[1] == _GRANTED


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
    done = answer[1] == _GRANTED
    if not done or await session.until(lambda now: not now.crashed, _RECOVERED, well=False) is None:
        raise NotReady(
            f"{session.drone} does not forget that it has crashed: set it upright,"
            " or switch it off and on"
        )


_STOPS = 5
_EACH = 0.2
"""How often it is sent, and the seconds to wait for its effect each time."""
_OLD_CHANNEL = 1
_OLD_STOP = b"\3"


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
        for _ in range(_STOPS):
            await worker.call(send, 2.5)
            try:
                if await session.until(off, _EACH, well=False) is not None:
                    return
            except LinkLost:  # it may receive even if nothing is received from it
                await asyncio.sleep(_EACH)
    finally:
        worker.end()
    raise LinkLost(f"{session.drone} did not confirm that its motors are off")
