"""The smooth way from a moving start to a standing end: a polynomial of the 7th order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple


class State(NamedTuple):
    """Where something is along one axis, how fast, and how that changes."""

    position: float
    velocity: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class Profile:
    """One axis of a way: its coefficients, in units of the duration."""

    coefficients: tuple[float, ...]
    duration: float

    def at(self, seconds: float) -> State:
        """Return the state after some seconds; the end, once it is over."""
        s = min(1.0, max(0.0, seconds / self.duration)) if self.duration > 0.0 else 1.0
        position = velocity = acceleration = 0.0
        for c in reversed(self.coefficients):  # all three by Horner's rule
            acceleration = acceleration * s + 2.0 * velocity
            velocity = velocity * s + position
            position = position * s + c
        if s >= 1.0:
            return State(position)
        return State(position, velocity / self.duration, acceleration / self.duration**2)


def profile(start: State, end: float, duration: float) -> Profile:
    """Plan from a state to rest at the end.

    Whoever is moving at the start flies past the end and comes back, if there is no room to brake:
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
