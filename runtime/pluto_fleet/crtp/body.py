"""The motion of a simulated Crazyflie: by its planner, by low-level setpoints, or falling.

The planner's way is a polynomial of the 7th order from a moving start to a standing end. The drone
follows late, and no faster than its position controller lets it: a position error becomes a velocity,
which is limited; the velocity follows with a lag. In height the error is also summed up, which
overshoots, and sinks back slowly. Measured on real firmware (2026.08), and here:

                                         measured    here
    6 m planned at 3 m/s, near and at rest  2.8 s late  2.8 s late
    15 m planned at 2 m/s                   16.6 s      17.4 s
    a hold at 0.93 m/s shoots on            0.58 m      0.54 m
    a take-off to 1.5 m rises to            1.60 m      1.60 m
    one to 1.6 m rises to                   1.706 m     1.70 m
    and is three seconds later at           1.655 m     1.65 m

The estimate of its position has a variance and an error. A position that comes in is a fix. The variance depends on how noisy fixes are and how often they
come; without any it grows with the square of the time, and the estimate leaves the truth likewise.
Largest of the three axes' variances on real firmware (2026.08), and here, in square metres:

                                 measured          here
    100 Hz, 1 cm                   0.00044           0.00044
    20 Hz, 1 cm                    0.00064           0.00061
    10 Hz, 1 cm                    0.00084           0.00085
    like UWB: 5-15 cm, 100 Hz      0.0015 to 0.003   0.0012 to 0.0030
    11 s without a fix             2.5               2.5
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import ceil, cos, hypot, pi, sin, sqrt
from random import Random
from typing import NamedTuple

from .flight_log import Point

NOISE = 0.01
RATE = 100.0
"""The noise of fixes in metres, and their rate per second."""
_LEAST = 0.00022
_PER_NOISE = 0.018
_PER_GAP = 0.004
"""Square metres: at best, for each metre of noise, for each second between fixes."""
_GROWS = 2.5 / 11.0**2
"""Square metres of variance, and metres of error, after a second without a fix."""
_MOST_UNSURE = 100.0
"""The largest variance, in square metres."""
_LONGEST_GAP = 0.5
"""The longest interval of consecutive fixes, in seconds."""
_NEVER = -1e9


@dataclass(slots=True)
class Estimator:
    """The estimate of one drone's position; times are handed in."""

    random: Random
    own: bool = True
    """Whether it localizes itself; else it depends on positions from outside."""
    noise: float = NOISE
    rate: float = RATE
    """Of its own fixes."""
    blind: bool = False
    """Whether no fix arrives any more."""
    _fixed_at: float = _NEVER
    _gap: float = 1.0 / RATE
    _away: tuple[float, float] = field(init=False)
    """The direction in which its estimate drifts."""

    def __post_init__(self) -> None:
        self._turn()

    def told(self, now: float) -> None:
        """Process a position from outside."""
        if not self.blind:
            if 0.0 < now - self._fixed_at < _LONGEST_GAP:
                self._gap = now - self._fixed_at
            self._fixed_at = now

    def step(self, now: float) -> None:
        if self.own and not self.blind:
            self._gap = 1.0 / self.rate
            self._fixed_at = now - now % self._gap

    def lose(self, on: bool) -> None:
        """Block all fixes, or unblock them."""
        if on and not self.blind:
            self._turn()
        self.blind = on

    def variance(self, now: float) -> float:
        """Return the variance of its position, in square metres."""
        age = now - self._fixed_at
        settled = _LEAST + _PER_NOISE * self.noise + _PER_GAP * self._gap
        return min(_MOST_UNSURE, settled + _GROWS * age * age)

    @property
    def sway(self) -> float:
        """The factor of its sway relative to the usual noise; assumed, not measured."""
        return sqrt(self.noise / NOISE)

    def error(self, now: float) -> Point:
        """Return the error of its estimate; zero before the first fix."""
        if self._fixed_at == _NEVER:
            return (0.0, 0.0, 0.0)
        age = now - self._fixed_at
        if age < _LONGEST_GAP:
            return (0.0, 0.0, 0.0)
        off = min(_MOST_UNSURE, _GROWS * (age - _LONGEST_GAP) ** 2)
        return (off * self._away[0], off * self._away[1], 0.0)

    def _turn(self) -> None:
        angle = self.random.uniform(-pi, pi)
        self._away = (cos(angle), sin(angle))


class AxisState(NamedTuple):
    """Position, velocity and acceleration along one axis."""

    position: float
    velocity: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class Profile:
    """One axis of a trajectory: its coefficients, in units of the duration."""

    coefficients: tuple[float, ...]
    duration: float

    def at(self, seconds: float) -> AxisState:
        """Return the state after some seconds; the final one after the end."""
        s = min(1.0, max(0.0, seconds / self.duration)) if self.duration > 0.0 else 1.0
        position = velocity = acceleration = 0.0
        for c in reversed(self.coefficients):  # all three by Horner's rule
            acceleration = acceleration * s + 2.0 * velocity
            velocity = velocity * s + position
            position = position * s + c
        if s >= 1.0:
            return AxisState(position)
        return AxisState(position, velocity / self.duration, acceleration / self.duration**2)


def profile(start: AxisState, end: float, duration: float) -> Profile:
    """Plan a profile from a state to rest at the end.

    A drone that is moving at the start flies past the end and comes back, if there is no room to brake:
    as the firmware's planner does.
    """
    v, a = start.velocity * duration, start.acceleration * duration**2
    d = end - start.position - v - a / 2.0
    e, f = -(v + a), -a
    return Profile(
        (
            start.position,
            v,
            a / 2.0,
            0.0,
            35.0 * d - 15.0 * e + 2.5 * f,
            -84.0 * d + 39.0 * e - 7.0 * f,
            70.0 * d - 34.0 * e + 6.5 * f,
            -20.0 * d + 10.0 * e - 2.0 * f,
        ),
        duration,
    )


Limits = tuple[float, float, float]
"""Metres per second: forwards, sideways and upwards."""

_GAIN = 2.0
_GAIN_UP = 1.8
"""Metres per second for each metre of error: across, and in height."""
_SUMMED = 0.37
_LEAKS = 60.0
"""The integral gain of the height, and the seconds in which the integral decays: an error in height
decays at the rate of _SUMMED / _GAIN_UP + 1 / _LEAKS."""
_MOST_SUMMED = 0.58
"""Metres times seconds: the limit of the integral, which is reached on the first metre of a climb."""
_LAGS = (0.3, 0.3, 0.15)
"""The time constants of the velocity, on each axis."""
_OVERHEAD = 1.1
"""The firmware lets a drone fly this much faster than its parameters say."""
_LEAST_UP = 0.5
"""Metres per second upwards that it is always allowed."""


@dataclass(slots=True)
class Tracking:
    """The position and velocity of a body while its motors turn."""

    position: list[float]
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    _sum: float = 0.0

    def step(self, target: Point, error: Point, yaw: float, limits: Limits, seconds: float) -> None:
        x, y, z = (
            wanted - (here + off)
            for wanted, here, off in zip(target, self.position, error, strict=True)
        )
        c, s = cos(yaw), sin(yaw)
        forwards = _limited(_GAIN * (c * x + s * y), limits[0])
        sideways = _limited(_GAIN * (c * y - s * x), limits[1])
        up = _GAIN_UP * z + _SUMMED * self._sum
        limit = max(_LEAST_UP, limits[2])
        if abs(up) < _OVERHEAD * limit:  # against integral wind-up
            self._sum += (z - self._sum / _LEAKS) * seconds
            self._sum = min(_MOST_SUMMED, max(-_MOST_SUMMED, self._sum))
        wanted = (c * forwards - s * sideways, s * forwards + c * sideways, _limited(up, limit))
        for axis, lag in enumerate(_LAGS):
            share = min(1.0, seconds / lag)
            self.velocity[axis] += (wanted[axis] - self.velocity[axis]) * share
            self.position[axis] += self.velocity[axis] * seconds
        if self.position[2] <= 0.0:
            self.position[2], self.velocity[2] = 0.0, max(0.0, self.velocity[2])


def _limited(velocity: float, limit: float) -> float:
    most = _OVERHEAD * limit
    return min(most, max(-most, velocity))


_WANDER, _MOST, _SLOWLY = 0.008, 0.02, 0.5
"""Metres that it is off its way, usually and at most, where it knows it to a centimetre; seconds in
which that changes."""
_HARD = 20.0
"""Metres per second squared at which a drone loses control, and tumbles."""
_FALL, _FASTEST = 9.81, 6.0
_BROKEN = 2.5
"""Metres per second of an impact after which it is not upright."""
_LOW = 0.3
"""Metres of height below which its deviation decreases."""
_STEP = 0.02
"""The largest time step of its motion, in seconds."""


@dataclass(frozen=True, slots=True)
class Trajectory:
    """A trajectory: a profile for each axis, and the heading."""

    axes: tuple[Profile, Profile, Profile]
    yaw: Profile
    began: float
    duration: float
    landing: bool

    def over(self, now: float) -> bool:
        return now >= self.began + self.duration


@dataclass(slots=True)
class Body:
    """A drone's body; times are handed in."""

    home: Point
    random: Random
    position: Point = field(init=False)
    velocity: Point = (0.0, 0.0, 0.0)
    yaw: float = 0.0
    plan: Trajectory | None = None
    """The planner's trajectory, unless low-level setpoints have priority."""
    setpoint: Point | None = None
    """The target of the last low-level setpoint; None: motors off."""
    preempted: bool = False
    """Whether low-level setpoints have priority: from the first one on, until released."""
    planner_off: bool = False
    """Whether a low-level setpoint has switched the planner off, and nothing was planned since."""
    error: Point = (0.0, 0.0, 0.0)
    """The error of its position estimate."""
    sway: float = 1.0
    """The factor of its deviation, by the noise of its position fixes."""
    limits: Limits = (1.0, 1.0, 1.0)
    """The speed limits of its position controller."""
    tumbled: bool = False
    _off: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    _tracking: Tracking | None = None

    def __post_init__(self) -> None:
        self.position = self.home

    @property
    def motors(self) -> bool:
        return self._flown is not None or self.setpoint is not None

    @property
    def airborne(self) -> bool:
        """Whether it is above the ground, or about to leave it."""
        return self.motors or self.position[2] > 0.0

    @property
    def estimate(self) -> Point:
        x, y, z = (here + off for here, off in zip(self.position, self.error, strict=True))
        return x, y, z

    @property
    def _flown(self) -> Trajectory | None:
        """The plan, if it is in effect."""
        return None if self.preempted else self.plan

    def fly(self, target: Point, yaw: float, duration: float, now: float, landing: bool) -> None:
        """Plan a trajectory to a point from the present planned state."""
        if self.plan is None:
            axes = tuple(map(AxisState, self.estimate))
            heading = AxisState(self.yaw)
        else:
            axes = tuple(one.at(now - self.plan.began) for one in self.plan.axes)
            heading = self.plan.yaw.at(now - self.plan.began)
        x, y, z = (profile(*one, duration) for one in zip(axes, target, strict=True))
        turned = profile(heading, yaw, duration)
        self.plan = Trajectory((x, y, z), turned, now, duration, landing)
        self.planner_off = False
        if not self.preempted:
            self.setpoint = None

    def obey(self, setpoint: Point | None) -> None:
        """Follow a low-level setpoint, which overrides and ends the plan."""
        self.cut()
        self.preempted = self.planner_off = True
        self.setpoint = setpoint

    def release(self) -> None:
        self.preempted = False

    def planned(self, now: float) -> Point:
        return self.estimate if self.plan is None else _at(self.plan, now)

    def cut(self) -> None:
        self.plan = self.setpoint = self._tracking = None

    def step(self, now: float, seconds: float) -> None:
        steps = max(1, ceil(seconds / _STEP))
        for left in range(steps - 1, -1, -1):
            self._step(now - left * seconds / steps, seconds / steps)

    def _step(self, now: float, seconds: float) -> None:
        if not self.motors:
            self._fall(seconds)
            return
        plan = self._flown
        if plan is not None and _push(plan, now) > _HARD:
            self.tumbled = True
            self.cut()
            return
        if self._tracking is None:
            self._off = [0.0, 0.0, 0.0]
            self._tracking = Tracking([*self.position], [*self.velocity])
        target = self.setpoint if plan is None else _at(plan, now)
        assert target is not None
        self._tracking.step(target, self.error, self.yaw, self.limits, seconds)
        self._wander(seconds)
        x, y, z = self._tracking.position
        near = min(1.0, z / _LOW)
        vx, vy, vz = self._tracking.velocity
        self.velocity = (vx, vy, vz)
        self.position = (x + self._off[0], y + self._off[1], max(0.0, z + self._off[2] * near))
        if plan is not None:
            self.yaw = plan.yaw.at(now - plan.began).position
            if plan.landing and plan.over(now):
                self.cut()

    def _wander(self, seconds: float) -> None:
        share = min(1.0, seconds / _SLOWLY)
        for axis in range(3):
            push = self.random.gauss(0.0, self.sway * _WANDER) * (2.0 * share) ** 0.5
            off = self._off[axis] * (1.0 - share) + push
            most = self.sway * _MOST
            self._off[axis] = min(most, max(-most, off))

    def _fall(self, seconds: float) -> None:
        x, y, z = self.position
        if z <= 0.0:
            self.velocity = (0.0, 0.0, 0.0)
            return
        vx, vy, vz = self.velocity
        vz = max(-_FASTEST, vz - _FALL * seconds)
        z += vz * seconds
        self.position, self.velocity = (x + vx * seconds, y + vy * seconds, z), (vx, vy, vz)
        if z <= 0.0:
            self.tumbled = self.tumbled or vz < -_BROKEN
            self.position, self.velocity = (*self.position[:2], 0.0), (0.0, 0.0, 0.0)

    def place(self, position: Point) -> None:
        """Put it somewhere, upright."""
        self.cut()
        self.position, self.velocity, self.tumbled = position, (0.0, 0.0, 0.0), False


def _at(plan: Trajectory, now: float) -> Point:
    x, y, z = (one.at(now - plan.began).position for one in plan.axes)
    return x, y, z


def _push(plan: Trajectory, now: float) -> float:
    x, y, z = (one.at(now - plan.began).acceleration for one in plan.axes)
    return hypot(x, y, z)
