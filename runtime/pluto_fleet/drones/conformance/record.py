"""What was seen of a flight: every command with how it ended, and where the drone was meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from ..telemetry import DroneEvent, DroneTelemetry


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """How a drone really is, by whoever simulates it or sees it from outside."""

    position: Point
    """Metres, in the map's frame."""
    yaw: float
    """Radians."""
    motors: bool
    """Whether they turn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """One look at a drone."""

    at: float
    """`time.monotonic()`."""
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

    @property
    def seconds(self) -> float:
        """How long it took."""
        return self.ended - self.began

    def done(self) -> Step:
        """Return the step itself; raise if the command did."""
        if self.error is not None:
            raise AssertionError(f"{self.name} raised {said(self.error)}") from self.error
        return self


@dataclass(slots=True, kw_only=True)
class Record:
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
    """Where the event loop was held up, a sentence each."""
    left: Sequence[str] = ()
    """What was left after closing."""
    failed: BaseException | None = None
    """What ended it before its end."""

    def step(self, name: str) -> Step:
        """Return a step; raise if the flight did not come to it."""
        if name in self.steps:
            return self.steps[name]
        why = f": {said(self.failed)}" if self.failed is not None else ""
        raise AssertionError(f"the flight never came to {name}{why}") from self.failed

    def during(self, *names: str) -> list[Sample]:
        """Return the looks during some steps, in order."""
        return [sample for sample in self.samples if sample.during in names]


def said(error: BaseException) -> str:
    """Write an error down."""
    return f"{type(error).__name__}: {error}"


def ensure(holds: object, sentence: str | Callable[[], str]) -> None:
    """Fail with this sentence unless something holds."""
    if not holds:
        raise AssertionError(sentence if isinstance(sentence, str) else sentence())
