"""How drones move and charge: one model for simulations, plans and checks, in closed formulas.

A Crazyflie flies each leg on a polynomial of the 7th order, from rest to rest (Bitcraze, high-level commander), a
multicopter outdoors on an S-curve, with a limited jerk. Seconds, metres, shares of a battery.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from hashlib import sha256
from itertools import pairwise
from math import dist, inf, sqrt
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

Vector = tuple[float, float, float]
CLIMB_SPEED = 0.3  # metres a second, straight up and down; on smooth legs about the mean
PEAK = 2.19  # peak speed over mean speed of a smooth leg
PUSH, MOST = 7.52, 4.0  # a smooth leg's peak acceleration over metres / s²; its limit in m/s²
SHORTEST = 1.0  # seconds of a smooth leg at least: 3 m in half a second have flipped a drone
TURNS = 1.0  # metres a second by which its velocity changes in a second, on its way from one leg to another
STOPS = 0.8  # seconds in which a drone that comes at its speed comes to rest
SINKS = 0.5  # the share of its limit up to which a drone lands closely enough to touch down
_TAIL = 3.0  # standard deviations within which all durations lie
_TAKE_OFFS = 10.0  # how much more what a take-off takes besides its climb varies than all else


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """How the drones of a fleet move, beside the speed of their category."""

    legs: str = "straight"
    """`smooth`: the category's speed is the peak; `steady`: as `straight`, with what multicopters are usually set to."""
    limit: float = 100.0  # metres per second that the position controller follows
    acceleration: float = 0.0  # m/s² at the ends of a leg that is not smooth; 0: at once
    jerk: float = 0.0  # m/s³ with which that acceleration comes and goes; 0: at once
    airspeed: float = 100.0  # metres per second through the air, at most
    wind: tuple[float, ...] = ()  # metres per second to which it blows, along x and y
    effort: float = 1.0  # what a second in that wind takes of the battery, over one in calm air
    up: float = CLIMB_SPEED  # metres per second straight up, where that is not smooth
    down: float = CLIMB_SPEED  # the same straight down
    low: float = 0.0  # metres above the ground below which it sinks more slowly
    touch_down: float = CLIMB_SPEED  # metres per second below that height
    take_off: float = 0.0  # seconds of a take-off besides its climb
    settles: float = 0.0  # seconds after each leg in the air until it hovers at rest
    landing: float = 0.0  # seconds from the touch-down until it counts as landed
    pace: float = 1.0  # the factor of all durations of legs
    spread: float = 0.0  # the standard deviation of what a leg takes, as a share of it
    action_spread: float = 0.0  # the same of what an action takes
    drain: float = 1.0  # the battery that a second in the air takes, times the flight time
    taper: float = 0.0  # the last share of a battery, which charges ever more slowly
    slack: float = 0.0  # metres of position error: real drones are kept apart by this much more

    @property
    def smooth(self) -> bool:
        """Whether each leg begins and ends at rest."""
        return self.legs == "smooth"

    @property
    def exact(self) -> Motion:
        """The same without its spread."""
        return replace(self, spread=0.0, action_spread=0.0)

    def rises(self, metres: float, speed: float) -> float:
        """Return the seconds of a take-off, from the command until it hovers."""
        return self.take_off + self.climb(metres, speed) + self.settles

    def flies(self, metres: float, speed: float) -> float:
        """Return the seconds of a leg, until it hovers at its end."""
        return self.leg(metres, speed) + self.settles

    def lands(self, metres: float, speed: float) -> float:
        """Return the seconds of a landing, until it counts as landed."""
        return self.sink(metres, speed) + self.landing

    def leg(self, metres: float, speed: float) -> float:
        """Return the seconds of a leg at a category's speed, until its end."""
        if not self.smooth:
            return self.pace * self._steadily(metres, min(speed, self.limit))
        followed = PEAK * metres / min(speed, self.limit)
        return self.pace * max(SHORTEST, followed, sqrt(PUSH * abs(metres) / MOST))

    def shortness(self, speed: float) -> float:
        """Return how many seconds a short leg can take more than its share of a long one."""
        if not self.smooth:  # one that peaks a little lower has 1/8 more, at most
            return self.pace * 9 / 8 * self._quickens(min(speed, self.limit))
        most = PUSH / MOST * min(speed, self.limit) / (4 * PEAK)  # sqrt(pm) <= am + p / 4a
        return self.pace * max(SHORTEST, most)

    def climb(self, metres: float, speed: float) -> float:
        """Return the seconds straight up."""
        if self.smooth:
            return self.leg(metres, min(speed, 2 * CLIMB_SPEED))
        return self.pace * self._steadily(metres, self.up)

    def sink(self, metres: float, speed: float) -> float:
        """Return the seconds straight down, to the ground."""
        if self.smooth:
            return self.climb(metres, min(speed, SINKS * self.limit))
        low = min(metres, self.low)
        return self.pace * (self._steadily(metres - low, self.down) + low / self.touch_down)

    def _steadily(self, metres: float, speed: float) -> float:
        """Return the seconds from rest to rest, by way of a speed that a short way does not reach."""
        if not self.acceleration or not metres:
            return metres / speed
        half = self.acceleration**2 / self.jerk / 2 if self.jerk else 0.0
        peak = sqrt(half * half + self.acceleration * metres) - half
        if peak < 2 * half:  # too short for the acceleration, too
            peak = (metres * sqrt(self.jerk) / 2) ** (2 / 3)
        return metres / min(speed, peak) + self._quickens(min(speed, peak))

    def _quickens(self, speed: float) -> float:
        """Return the seconds from rest to a speed."""
        if not self.acceleration:
            return 0.0
        rises = self.acceleration / self.jerk if self.jerk else 0.0
        even = speed / self.acceleration
        return even + rises if even >= rises else 2 * sqrt(speed / self.jerk)

    def against(self, here: Vector, there: Vector, speed: float) -> float:
        """Return the speed over ground at which a leg is flown in the wind."""
        metres = dist(here[:2], there[:2])
        if not self.wind or not metres:
            return speed
        along = sum(w * (b - a) / metres for w, a, b in zip(self.wind, here, there, strict=False))
        rest = self.airspeed**2 + along**2 - sum(w * w for w in self.wind)
        return min(speed, max(0.1, along + sqrt(max(0.0, rest))))

    def at_speed(self, metres: float, speed: float) -> float:
        """Return the seconds in which a drone flies so far without a stop."""
        return self.pace * metres / min(speed, self.limit)

    def sent_on(self, velocity: Vector, here: Vector, there: Vector, speed: float) -> float:
        """Return the seconds of a leg on which a drone on its way is sent elsewhere, and its autopilot turns it."""
        metres = dist(here, there)
        rate = TURNS if self.smooth else 2 * self.acceleration or inf
        part = min(speed, self.limit) / metres
        ahead = tuple(part * (b - a) for a, b in zip(here, there, strict=True))
        seconds = self.at_speed(metres, speed) + self.pace * dist(velocity, ahead) / rate
        return max(seconds, self.descent(here, there))

    def descent(self, here: Vector, there: Vector) -> float:
        """Return the seconds that a leg takes at least as it leads down: a multicopter sinks slowly, in any leg."""
        metres = here[2] - there[2]
        if self.legs != "steady" or metres <= 0:
            return 0.0
        # `settles` counts with a brake from a higher speed
        return self.pace * (metres / self.down + self._quickens(self.down) / 2)

    def stops(self, speed: float) -> float:
        """Return the seconds after a leg that was flown at speed, and not from rest, until a drone hovers."""
        if self.smooth:
            return self.pace * STOPS
        return self.settles + self.pace * self._quickens(min(speed, self.limit)) / 2

    def stages(
        self, way: Sequence[Vector], speed: float, rises: bool, lands: bool
    ) -> Iterator[tuple[Vector, float, float, float]]:
        """Yield where each leg of a way ends, with the seconds before, on and after it; it may begin or end below."""
        if rises:
            yield way[0], self.take_off, self.climb(way[0][2], speed), self.settles
        for here, there in pairwise(way):
            seconds = self.leg(dist(here, there), self.against(here, there, speed))
            yield there, 0.0, max(seconds, self.descent(here, there)), self.settles
        if lands:
            x, y, z = way[-1]
            yield (x, y, 0.0), 0.0, self.sink(z, speed), self.landing


def varied(motion: Motion, seed: int) -> Motion:
    """Return how all drones move in the flight of a seed: not in two at quite the same pace."""
    pace = motion.pace * varies(motion.spread, f"{seed}/pace")
    later = varies(_TAKE_OFFS * motion.spread, f"{seed}/take-off")
    return replace(motion, pace=pace, take_off=motion.take_off * max(0.0, later))


def varies(spread: float, chance: str) -> float:
    """Return by which factor something differs from what is expected; `chance` decides, and nothing else."""
    if not spread:
        return 1.0
    # a sum of 32 even numbers is as good as normally distributed; to seed a `Random` takes ten times as long
    drawn = (sum(sha256(chance.encode()).digest()) - 32 * 127.5) / sqrt(32 * (256**2 - 1) / 12)
    return 1.0 + spread * max(-_TAIL, min(_TAIL, drawn))


def smoothly(part: float) -> float:
    """Return the share of a smooth leg that is flown after this share of its time."""
    return part**4 * (35 - 84 * part + 70 * part**2 - 20 * part**3)


def charged(level: float, seconds: float, full: float, taper: float) -> float:
    """Return the level after charging for a time; `full`: the seconds from empty to full."""
    now = _progress(level, full, taper) + seconds
    tail = full - full * (1 - taper) / (1 + taper)  # the seconds in which it slows down
    if now <= full - tail:
        return now * (1 + taper) / full
    return 1.0 - taper * (max(0.0, full - now) / (tail or full)) ** 2


def charging(level: float, target: float, full: float, taper: float) -> float:
    """Return the seconds that it takes to charge from one level to another."""
    if full == inf:
        return inf if target > level else 0.0
    if not taper:
        return (target - level) * full
    return _progress(target, full, taper) - _progress(level, full, taper)


def _progress(level: float, full: float, taper: float) -> float:
    """Return the seconds from empty to a level."""
    if level <= 1 - taper:
        return level * full / (1 + taper)
    tail = full - full * (1 - taper) / (1 + taper)
    return full - tail * sqrt(max(0.0, 1 - level) / taper)


STRAIGHT = Motion()  # straight legs at the category's speed, that take nothing beside

STEADY = Motion(
    legs="steady",
    acceleration=3.0,
    jerk=4.0,
    airspeed=15.0,
    up=1.5,
    down=1.5,
    low=7.0,
    touch_down=0.7,
    settles=2.25,
    landing=1.7,
    slack=0.7,
)
"""A multicopter as PX4 sets it; the durations were measured with a simulated one (docs/motion.md)."""

CRAZYFLIE = Motion(
    legs="smooth",
    limit=1.0,
    take_off=1.94,
    settles=0.15,
    landing=2.1,
    spread=0.01,
    action_spread=0.03,
    taper=0.2,
    slack=0.15,
)
"""A Crazyflie by its firmware's limits; the durations were measured (docs/motion.md)."""


def motion_of(given: Mapping[str, Any]) -> Motion:
    """Return what the `[motion]` of a fleet file says; what it does not say is a Crazyflie's."""
    usual = {"straight": STRAIGHT, "steady": STEADY}.get(given.get("legs", ""), CRAZYFLIE)
    return replace(usual, **given)
