"""How drones are flown: the protocol between the fleet and what moves its drones (thesis 4.4).

Metres, seconds. A trip is one job, given once and reported once. Returning home, landing and recovering
are single commands, which return when they are done: when landed; they raise `FlightFailed` when the
drone cannot finish. A cancelled command leaves the drone hovering where it
is. The protocol knows no missions: a job's id only identifies a flight.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, TypeVar

if TYPE_CHECKING:
    from ..domain.model import Telemetry


J_contra = TypeVar("J_contra", contravariant=True)
"""The job for a trip: a `Flight` of the brain."""


class Navigation(Protocol[J_contra]):
    """Commands a team of drones, by their ids."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry, an object that is always current."""
        ...

    def fly(self, job: J_contra, report: Callable[[object], None]) -> None:
        """Take off, fly to the job's stops and do its action.

        `report` is called once, and never from within this call, with the action's result or the
        `FlightFailed` that ended it; with no action to do, with None on arrival. It must be called within
        the kernel: from one of its events or coroutines, or by `kernel.post(report, result)`.
        """
        ...

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; nothing of its job is reported any more."""
        ...

    def settle(self, job: J_contra) -> None:
        """Stop a job, and report it once it is known whether its action was done before."""
        ...

    def attach(self, job: J_contra, report: Callable[[object], None]) -> None:
        """Register for the report of a job that was given before an interruption."""
        ...

    async def hold(self, drone: str) -> None:
        """Hover while an action of the app's own is done, until cancelled."""
        ...

    async def read(self, drone: str, name: str) -> float:
        """Return the value of a hovering drone's sensor or variable."""
        ...

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a hovering drone."""
        ...

    async def home(self, drone: str) -> None:
        """Fly to its dock on the way that it finds, and land there."""
        ...

    async def land(self, drone: str) -> None:
        """Land here."""
        ...

    async def recover(self, drone: str) -> str | None:
        """Bring a drone home after a failed flight, landed; else it is lost: return what it says of that."""
        ...

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        ...
