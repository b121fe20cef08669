"""How the gateway has drones flown, and how an app commands them through it: jobs are remembered."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Protocol

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.fleet.navigation import Navigation

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain
    from plutoc_runtime.domain.model import Item, Point

    from .reports import Down, DroneReport, FleetReport


Report = Callable[[object], object]
"""Hears what an action gave, or the `FlightFailed` that ended the job."""


class Job(Protocol):
    """What a drone is to do for a trip."""

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: the same flight has the same id in every run."""
        ...

    @property
    def drone(self) -> str:
        """Who flies."""
        ...

    @property
    def stops(self) -> tuple[Point, ...]:
        """Where to fly, in order; which way is navigation's to find."""
        ...

    @property
    def action(self) -> str | None:
        """Which of the built-in actions to do at the last stop; None: hover there."""
        ...

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """How to do it."""
        ...

    @property
    def item(self) -> Item | None:
        """What to pick or to release."""
        ...

    @property
    def seconds(self) -> float:
        """How long the action is expected to take."""
        ...

    def begins(self) -> None:
        """Hear that the action is about to be done: told right before it, never for none.

        If this raises `FlightFailed`, it must not be done.
        """
        ...


class CommandLink(Navigation[Job], Protocol):
    """A navigation that remembers every job, for as long as it listens to this brain."""

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        ...

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        ...

    async def fleet_report(self) -> FleetReport:
        """Ask all drones and the ledger how everything stands; from now on the brain is heard."""
        ...

    def attach(self, id: str, report: Report) -> None:
        """Hear of a job that was given before: when it ends, or now if it has."""
        ...

    def forget(self, id: str) -> None:
        """Forget a job that will not be asked for again: its id may be given anew."""
        ...

    async def bring_down(self, how: Down) -> None:
        """Break off everything and bring all drones down; return when all that can are down."""
        ...


class GatewayLink(CommandLink, Protocol):
    """The same, by a gateway in another process."""

    def on_telemetry(self, watcher: Callable[[], object]) -> None:
        """Call this whenever a drone was heard of."""
        ...

    async def goodbye(self) -> None:
        """Let the gateway end, once all drones are down; nothing is lost by that."""
        ...

    async def close(self) -> None:
        """Hang up: the gateway goes on, and lands everything if no other brain links."""
        ...


def motors_cut(drone: str) -> FlightFailed:
    """Return how everything fails that a drone did when its motors were cut on command."""
    return FlightFailed(Failure.CRASH, f"{drone}'s motors were cut")
