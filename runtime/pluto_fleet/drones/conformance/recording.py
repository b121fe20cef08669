"""The record of a flight: its commands with their outcomes, samples of the drone, and what follows from
them: how far it moved, how fast, how often it sent telemetry.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, dist, hypot, isfinite, sin

from ...shared.domain.errors import Failure
from ...shared.domain.model import Point
from ..protocol import DroneEvent, DroneTelemetry


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """The true state of a drone, by its simulation or as measured from outside."""

    position: Point
    """Metres, in the map's frame."""
    yaw: float
    """Radians."""
    motors: bool
    """Whether they turn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """One sample of a drone."""

    at: float
    """By the loop's time, which is `time.monotonic()`."""
    during: str
    """The name of the step."""
    telemetry: DroneTelemetry
    truth: Truth | None


@dataclass(slots=True, kw_only=True)
class Step:
    """One command, and how it ended."""

    name: str
    began: float
    ended: float
    value: object = None
    error: BaseException | None = None
    before: Sample
    after: Sample

    def done(self) -> Step:
        """Return the step itself; raise its error if the command failed."""
        if self.error is not None:
            raise AssertionError(f"{self.name} raised {described(self.error)}") from self.error
        return self


@dataclass(slots=True, kw_only=True)
class FlightRecord:
    """One flight."""

    made: type
    """The class of its navigation."""
    steps: dict[str, Step] = field(default_factory=dict)
    """By name, in order."""
    samples: list[Sample] = field(default_factory=list)
    events: list[DroneEvent] = field(default_factory=list)
    events_error: BaseException | None = None
    events_ended: bool = False
    blocked: Sequence[str] = ()
    """Where the event loop was blocked, a sentence for each."""
    left: Sequence[str] = ()
    """The resources left after closing."""
    failed: BaseException | None = None
    """The error that ended it early."""

    def step(self, name: str) -> Step:
        """Return a step; raise if the flight did not reach it."""
        if name in self.steps:
            return self.steps[name]
        why = f": {described(self.failed)}" if self.failed is not None else ""
        raise AssertionError(f"the flight never came to {name}{why}") from self.failed

    def during(self, *names: str) -> list[Sample]:
        return [sample for sample in self.samples if sample.during in names]


def described(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


WINDOW = 0.5
"""Seconds over which a speed is averaged: positions are noisy."""
MARGIN, JITTER = 1.1, 0.1
"""Tolerances of a measured speed, as a share, and of the delay of telemetry, in seconds."""
_GROUND = 0.1
"""Metres above the ground below which motors may be switched off."""
_KNOWN = tuple(failure.name for failure in Failure if failure is not Failure.UNKNOWN)


def moved(samples: Sequence[Sample]) -> float:
    """Return its largest distance from its first position."""
    if not samples:
        return 0.0
    first = samples[0]
    told = max(dist(one.telemetry.position, first.telemetry.position) for one in samples)
    true = max(
        dist(one.truth.position, first.truth.position) if one.truth and first.truth else 0.0
        for one in samples
    )
    return max(told, true)


def stands_still(samples: Sequence[Sample], tolerance: float) -> bool:
    """Return whether it neither moved nor had its motors on."""
    turned = any(one.telemetry.flying or (one.truth and one.truth.motors) for one in samples)
    return moved(samples) <= tolerance and not turned


def fell(record: FlightRecord, speed: float) -> bool:
    """Return whether its motors went off in the air: higher than it can have sunk since the last sample."""
    looks = [
        (
            (one.at, one.truth.position[2], one.truth.motors)
            if one.truth
            else (one.telemetry.time, one.telemetry.position[2], one.telemetry.flying)
        )  # the telemetry by then
        for one in record.samples
    ]
    ground = looks[0][1] + _GROUND if looks else 0.0
    return any(
        was_on and not is_on and height > ground + 1.5 * speed * (now - then)
        for (then, height, was_on), (now, _, is_on) in pairwise(looks)
    )


def off_course(samples: Sequence[Sample], start: Point, along: Point) -> float:
    """Return its largest distance from a straight line."""
    return max((_beside(one.telemetry.position, start, along) for one in samples), default=0.0)


def _beside(point: Point, start: Point, along: Point) -> float:
    way = [a - b for a, b in zip(point, start, strict=True)]
    far = max(0.0, sum(a * b for a, b in zip(way, along, strict=True)))
    return hypot(*(a - far * b for a, b in zip(way, along, strict=True)))


def too_fast(samples: Sequence[Sample], speed: float, noise: float) -> float | None:
    """Return a speed above the limit; None: there was none.

    As telemetry arrives with varying delay, speeds are averaged.
    """
    told = [one.telemetry for one in samples if isfinite(one.telemetry.time)]
    begin = 0
    for now in told:
        while now.time - told[begin].time > WINDOW:
            begin += 1
        seconds, way = now.time - told[begin].time, dist(now.position, told[begin].position)
        if seconds > WINDOW / 2 and way > speed * (seconds + JITTER) * MARGIN + noise:
            return way / seconds
    return None


def stood(samples: Sequence[Sample], start: float, end: float, slowest: float) -> float | None:
    """Return how many seconds after the first sample it was slower than this, between two times; None: never."""
    told = [one for one in samples if start < one.at < end]
    begin = 0
    for now in told:
        while now.at - told[begin].at > WINDOW:
            begin += 1
        seconds = now.telemetry.time - told[begin].telemetry.time
        way = dist(now.telemetry.position, told[begin].telemetry.position)
        if seconds > WINDOW / 2 and way < slowest * seconds:
            return now.at - samples[0].at
    return None


def looks_without_news(samples: Sequence[Sample]) -> int:
    """Return the most samples in a row without new telemetry."""
    most = row = 0
    for earlier, later in pairwise(samples):
        row = row + 1 if later.telemetry.time == earlier.telemetry.time else 0
        most = max(most, row)
    return most


def units_differ(samples: Sequence[Sample], tolerance: float, speed: float) -> str | None:
    """Return in what telemetry and truth differ by more than a drone's own error, or None.

    Telemetry is a little old, and a busy machine samples late: it may have flown on meanwhile.
    """
    for earlier, one in pairwise(samples):
        if one.truth is None or not isfinite(one.telemetry.time):
            continue  # unknown, or no telemetry yet
        position, yaw = one.telemetry.position, one.telemetry.yaw
        off = dist(position, one.truth.position)
        late = one.at - min(earlier.at, one.telemetry.time)
        if off > tolerance + 2 * speed * late:
            return (
                f"it says it is at {_written(position)} m, and is at "
                f"{_written(one.truth.position)} m: which units, and which frame?"
            )
        if hypot(cos(yaw) - cos(one.truth.yaw), sin(yaw) - sin(one.truth.yaw)) > 0.3:
            return f"it says its yaw is {yaw:.2f} rad, and it is {one.truth.yaw:.2f}"
    return None


def _written(point: Point) -> str:
    return f"({', '.join(f'{value:.2f}' for value in point)})"


def known_failures(record: FlightRecord) -> list[str]:
    """Return the errors of the commands that are not failures known to the runtime."""
    return [
        f"{step.name} raised {described(step.error)}"
        for step in record.steps.values()
        if step.error is not None and getattr(step.error, "failure", None) not in _KNOWN
    ]
