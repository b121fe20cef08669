"""What the lives of one app in real time share, and what comes of one."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path

    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission
    from plutoc_runtime.domain.trace import Event

    from ..files.fleet import FleetFile
    from ..jobs.job import GatewayLink
    from ..jobs.reports import Down
    from ..journal.fold import Records
    from ..process.realtime import RealTime

    Connect = Callable[[RealTime, int, Callable[[], object]], Awaitable[GatewayLink]]


class End(Enum):
    """How a life ended, if not by a crash."""

    OVER = "over"
    """Every mission has ended, or waits for a person."""
    STOPPED = "stopped"
    LOST = "lost"
    """The gateway has gone: the drones must be asked by another one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightConfig:
    """What all lives of one app share."""

    app: App
    missions: Sequence[Mission[Any]]
    """As they were planned."""
    fleet: FleetFile
    connect: Connect
    """Reaches the gateway, and starts it if there is none: kernel, epoch, what to call if it dies."""
    note: Path
    """Where to say how commands reach the app."""
    tell: Callable[[Event], object]
    """Shows an event, once it is on record."""
    speed: float = 1.0
    sim: bool = True
    """Whether drones are simulated: then a lost one is always carried home."""
    patient: bool = False
    """Whether it goes on for as long as a mission waits for a person's decision."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightResult:
    """What came of one life."""

    end: End
    missions: Sequence[Mission[Any]]
    drones: Sequence[Drone]
    records: Records


class Stops:
    """Stops the app's present life, and each that would follow."""

    def __init__(self) -> None:
        self.asked: Down | None = None
        """How all drones shall come down, once that was asked for."""
        self.stop_now: Callable[[Down], object] | None = None
        """Stops the life that is being lived."""

    def stop(self, how: Down) -> None:
        """Bring all drones down; called in the loop's thread."""
        self.asked = how
        if self.stop_now is not None:
            self.stop_now(how)
