"""Flying a Crazyflie: each command, its trajectory, and waiting until its state shows that it is done.

A trajectory of the high-level commander is a polynomial of the seventh order that begins and ends at
rest: its peak speed is 35/16 of its mean one, and over a short way it is the acceleration that counts.
The firmware's planner plans as fast as it is asked to; the position controller that follows is limited
by parameters, to a metre per second as it comes. A faster trajectory is at its end long before the
drone is, which then arrives in the middle of its way, or not in time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import dist, inf, isfinite, sqrt

from ..drones.protocol import (
    NavigationError,
    NotReady,
    OutsideArea,
    PositionLost,
    Rejected,
    TargetTimeout,
)
from ..shared.domain.model import Point
from ..shared.domain.motion import CLIMB_SPEED, MOST, PEAK, PUSH, SHORTEST, SINKS
from ..shared.domain.text import number
from . import commander, messages, parameters
from .session import CrazyflieSession
from .state import State

NEAR = 0.08
"""Metres from its target within which it has arrived: it sways, and must stay within ten centimetres."""
SLACK = 8.0
"""Seconds that an arrival may be later than the trajectory's end: the drone lags, and settles there.

With beacons as noisy as UWB (0.15 m) that took up to 4.6 s in 400 simulated trajectories."""
REST = 0.15
"""Metres per second below which it hovers: wind and noise make it sway."""

_AHEAD = 0.2
_BRAKE = 3.6
"""The share of its braking distance at which to hover, as it cannot stop at once; and its deceleration, from
one metre per second in one second."""
_SOON = 0.05
_RECENT = 0.5
"""Seconds between two states, by the drone's clock, from which a speed can be computed."""
_LOOK = 0.3
"""Seconds for which it must hover, as an estimate is noisy."""
_FASTEST = 5.0
"""Metres per second; a higher speed is a jump of the position, or of a clock."""
_FARTHEST = 1.0
"""The longest braking distance, in metres."""
_LOWEST = 0.2
"""The lowest height at which it may hover, in metres."""


def shortest_duration(metres: float, speed: float) -> float:
    """Return how long a trajectory must take for its peak speed to stay below this."""
    return max(SHORTEST, PEAK * metres / speed, sqrt(PUSH * metres / MOST))


def hovers(states: Sequence[State], off: Callable[[State], float]) -> bool:
    """Return whether a drone has been near its target and at rest for a moment, by its states.

    The last state is new; `off`: its distance in metres. The end of a trajectory does not mean that the
    drone has come to rest, and one that overshoots is near its target, too, as it passes.
    """
    now = states[-1]
    for then in reversed(states):
        if not off(then) < NEAR:
            return False
        passed = now.since(then)
        if passed >= _LOOK:
            return now.distance(then.position) <= REST * passed
    return False


def braking(before: State | None, state: State) -> tuple[Point, float]:
    """Return where a drone is to hover in order to stop now, and how long that takes.

    That is never far away, even if its telemetry is wrong; if unknown, it is its present position.
    """
    target = state.position
    seconds = SHORTEST
    passed = 0.0 if before is None else state.since(before)
    if before is not None and _SOON <= passed <= _RECENT:
        speed = state.distance(before.position) / passed
        if speed <= _FASTEST:
            seconds = max(SHORTEST, _BRAKE * speed / MOST)
            share = min(_AHEAD * seconds, _FARTHEST / speed if speed else 0.0) / passed
            x, y, z = (
                now + (now - then) * share
                for now, then in zip(state.position, before.position, strict=True)
            )
            target = x, y, z
    return (target[0], target[1], max(_LOWEST, target[2])), seconds


_LIMIT_PARAMETERS = ("posCtlPid.xVelMax", "posCtlPid.yVelMax", "posCtlPid.zVelMax")
DEFAULT_LIMIT = 1.0
"""The firmware's default speed limit in metres per second, until its parameters are known."""
_CLIMB = 2 * CLIMB_SPEED
"""The largest vertical speed of an app, in metres per second."""
_ROUNDING = 1e-3


@dataclass(frozen=True, slots=True)
class SpeedLimits:
    """Metres per second forward, sideways and up; infinite for a firmware without such limits."""

    limits: tuple[float, float, float]

    def seconds(self, start: Point, target: Point, speed: float) -> float:
        """Return the shortest duration of a trajectory that it can follow, below a maximum speed."""
        x, y, z = self.limits  # the first two are along its nose and across, wherever that points
        across = dist(start[:2], target[:2])
        up = abs(target[2] - start[2])
        followed = PEAK * max(across / min(x, y), up / z)
        return max(shortest_duration(dist(start, target), speed), followed)

    def seconds_down(self, height: float, speed: float) -> float:
        """Return the duration of a landing: its motors stop at its end, wherever it is then."""
        return self.seconds((0.0, 0.0, height), (0.0, 0.0, 0.0), min(speed, SINKS * self.limits[2]))

    def seconds_down_blind(self, height: float) -> float:
        """Return the duration of a landing of a drone that drifts: as short as it can follow."""
        return self.seconds((0.0, 0.0, height), (0.0, 0.0, 0.0), self.limits[2])

    def too_slow_for(self, speed: float) -> Iterator[str]:
        """Yield why a drone cannot follow its maximum speed."""
        asked = (speed, speed, min(speed, _CLIMB))
        for name, limit, wanted in zip(_LIMIT_PARAMETERS, self.limits, asked, strict=True):
            if wanted > limit + _ROUNDING:
                yield (
                    f"it is to fly at up to {number(wanted)} m/s, and its firmware follows no course faster"
                    f" than {number(limit)} m/s ({name}): give its category a lower speed, or set that"
                    " parameter"
                )


def speed_limits_of(session: CrazyflieSession) -> SpeedLimits:
    """Return the limits of its parameters; preliminary until all have been read."""
    known = parameters.known(session)
    x, y, z = (_limit(session, known.get(name), name) for name in _LIMIT_PARAMETERS)
    return SpeedLimits((x, y, z))


def _limit(session: CrazyflieSession, value: float | None, name: str) -> float:
    if parameters.element_of(session.cf, name) is None:
        return inf
    return value if value is not None and value > 0.0 else DEFAULT_LIMIT


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
    await hovering(session, lambda state: abs(state.position[2] - height), seconds, "risen")


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
    await hovering(session, lambda state: state.distance(target), seconds, what)


async def hovering(
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
