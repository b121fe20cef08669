"""How a simulated Crazyflie moves: along what its planner says, or down."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot
from random import Random

from .profile import Profile, State, profile

Point = tuple[float, float, float]

_WANDER, _MOST, _SLOWLY = 0.008, 0.02, 0.5
"""Metres that it is off its way, usually and at most; seconds in which that changes."""
_HARD = 20.0
"""Metres per second squared: what no such drone can follow, and tumbles."""
_FALL, _FASTEST = 9.81, 6.0
_BROKEN = 2.5
"""Metres per second at which it does not stay upright on the ground."""
_LOW = 0.3
"""Metres of height below which it is less and less off its way."""


@dataclass(frozen=True, slots=True)
class Plan:
    """A way that is flown: one axis each, and the heading."""

    axes: tuple[Profile, Profile, Profile]
    yaw: Profile
    began: float
    duration: float
    landing: bool

    def over(self, now: float) -> bool:
        """Whether its end is reached."""
        return now >= self.began + self.duration


@dataclass(slots=True)
class Body:
    """A drone's body; times are handed in."""

    home: Point
    random: Random
    position: Point = field(init=False)
    velocity: Point = (0.0, 0.0, 0.0)
    yaw: float = 0.0
    plan: Plan | None = None
    """None: the motors are off."""
    tumbled: bool = False
    _off: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])

    def __post_init__(self) -> None:
        self.position = self.home

    @property
    def airborne(self) -> bool:
        """Whether it is above the ground."""
        return self.plan is not None or self.position[2] > 0.0

    def fly(self, target: Point, yaw: float, duration: float, now: float, landing: bool) -> None:
        """Leave for a point, from however it is moving now."""
        if self.plan is None:
            self._off = [0.0, 0.0, 0.0]
            axes = tuple(map(State, self.position))
            heading = State(self.yaw)
        else:
            axes = tuple(one.at(now - self.plan.began) for one in self.plan.axes)
            heading = self.plan.yaw.at(now - self.plan.began)
        x, y, z = (profile(*one, duration) for one in zip(axes, target, strict=True))
        turned = profile(heading, yaw, duration)
        self.plan = Plan((x, y, z), turned, now, duration, landing)

    def setpoint(self, now: float) -> Point:
        """Return where it should be now."""
        if self.plan is None:
            return self.position
        x, y, z = (one.at(now - self.plan.began).position for one in self.plan.axes)
        return x, y, z

    def cut(self) -> None:
        """Switch the motors off."""
        self.plan = None

    def step(self, now: float, seconds: float) -> None:
        """Let time pass."""
        if self.plan is None:
            self._fall(seconds)
            return
        x, y, z = (one.at(now - self.plan.began) for one in self.plan.axes)
        if hypot(x.acceleration, y.acceleration, z.acceleration) > _HARD:
            self.tumbled = True
            self.cut()
            return
        self._wander(seconds)
        near = min(1.0, max(0.0, z.position / _LOW))
        place = (x.position + self._off[0], y.position + self._off[1])
        self.position = (*place, max(0.0, z.position + self._off[2] * near))
        self.velocity = (x.velocity, y.velocity, z.velocity)
        self.yaw = self.plan.yaw.at(now - self.plan.began).position
        if self.plan.landing and self.plan.over(now):
            self.cut()
            self.position = (*place, 0.0 if z.position < 0.1 else self.position[2])
            self.velocity = (0.0, 0.0, 0.0)

    def _wander(self, seconds: float) -> None:
        share = min(1.0, seconds / _SLOWLY)
        for axis in range(3):
            push = self.random.gauss(0.0, _WANDER) * (2.0 * share) ** 0.5
            off = self._off[axis] * (1.0 - share) + push
            self._off[axis] = min(_MOST, max(-_MOST, off))

    def _fall(self, seconds: float) -> None:
        x, y, z = self.position
        if z <= 0.0:
            return
        vx, vy, vz = self.velocity
        vz = max(-_FASTEST, vz - _FALL * seconds)
        z += vz * seconds
        self.position, self.velocity = (x + vx * seconds, y + vy * seconds, z), (vx, vy, vz)
        if z <= 0.0:
            self.tumbled = self.tumbled or vz < -_BROKEN
            self.position, self.velocity = (*self.position[:2], 0.0), (0.0, 0.0, 0.0)

    def place(self, position: Point) -> None:
        """Put it somewhere, upright, as a person does."""
        self.cut()
        self.position, self.velocity, self.tumbled = position, (0.0, 0.0, 0.0), False
