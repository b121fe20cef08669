"""What is flown, what one run of it came to, and how it is stopped."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

from ..process.text import in_shell

if TYPE_CHECKING:
    from pathlib import Path

    from ..app import App
    from ..files.fleet import FleetFile
    from ..files.stand_ins import StandIns
    from ..jobs.reports import Down
    from ..journal.standing import Standing
    from ..shared.alone.world import Faults
    from ..shared.domain.model import Drone, Mission


class End(Enum):
    """How a run ended, if not by a crash."""

    OVER = "over"
    """Every mission has ended, or waits for an answer of the user."""
    STOPPED = "stopped"
    LOST = "lost"
    """The gateway has died: another one must take over its drones."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightSetup:
    """A journal, and everything that is needed to resume it."""

    app: App
    journal: Path
    missions: Sequence[Mission[Any]]
    fleet: FleetFile
    speed: float
    seed: int
    faults: Faults
    sim: bool = True
    """Whether the drones are simulated."""
    stand_ins: StandIns | None = None
    """The drones that are simulated down to their protocol, if they are."""

    @property
    def in_simulation(self) -> bool:
        """Whether no drone is real."""
        return self.sim or self.stand_ins is not None

    @property
    def charges(self) -> bool:
        """Whether a battery that is low may become full: what is real has its say itself."""
        return self.fleet.charges_at_home or not self.in_simulation

    @property
    def how_to_go_on(self) -> str:
        """How to resume it: a sentence for the user who has stopped it."""
        return how_to_go_on(self.app, self.journal)


def how_to_go_on(app: App, journal: Path) -> str:
    """Return how to resume a flight: a sentence for the user who has stopped it, with the command."""
    return f"to go on: {app.name} resume {in_shell(journal)}"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightResult:
    """The outcome of one run."""

    end: End
    missions: Sequence[Mission[Any]]
    drones: Sequence[Drone]
    records: Standing


class Stops:
    """Stops the app's current run, and those that would follow."""

    def __init__(self) -> None:
        self.asked: Down | None = None
        """How all drones are to come down, once a stop was requested."""
        self.stop_now: Callable[[Down], object] | None = None
        """Stops the current run."""

    def stop(self, how: Down) -> None:
        """Bring all drones down; called in the loop's thread."""
        self.asked = how
        if self.stop_now is not None:
            self.stop_now(how)
