"""One run to be tried: what is flown, what goes wrong by itself, and what strikes it when."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..simulation.faults import Faults

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from ..model import Mission
    from .blows import Blow


@dataclass(frozen=True, slots=True, kw_only=True)
class Weather:
    """What goes wrong by itself, as shares from 0 to 1 or in seconds."""

    faults: Faults = field(default_factory=Faults)
    """Of flights."""
    hook: float = 0.0
    """Calls of hooks that raise an error that nobody expected."""
    late: float = 0.0
    """Wake-ups that come late."""
    slow: float = 0.0
    """Seconds that the radio takes, each way."""
    disk: float = 0.0
    """Seconds until a row of the journal is durable."""
    jump: float = 0.0
    """Seconds by which the clock of the machine is set on while the app is down."""


FAIR = Weather()


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """All that a run depends on besides the app. The missions are never flown themselves."""

    seed: int
    missions: tuple[Mission[Any], ...]
    fleet: FleetFile
    weather: Weather = FAIR
    blows: tuple[Blow, ...] = ()
    down: float = 1.0
    """Seconds until somebody, or the supervisor, starts the app again."""
    snapshot: bool = False
    """Whether a later life begins with a snapshot instead of the first half of the journal."""
