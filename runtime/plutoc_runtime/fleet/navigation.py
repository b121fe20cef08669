"""How drones are flown: the protocol between the fleet and what moves its drones (thesis 4.4).

Metres, seconds. A trip is one job, given once and reported once. What a drone does for itself
(return, land, recover) are single commands, which return when they are done: on arrival, when
landed; they raise `FlightFailed` when the drone cannot finish. A command that is cancelled leaves
the drone hovering where it is. The protocol knows no missions: a job's id only tells one flight
from another.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol, TypeVar

if TYPE_CHECKING:
    from ..domain.model import Point, Telemetry


J_contra = TypeVar("J_contra", contravariant=True)
"""What a drone is to do for a trip: the brain gives a `Flight`."""


class Navigation(Protocol[J_contra]):
    """A team of drones that can be flown, by their ids."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        ...

    def fly(self, job: J_contra, report: Callable[[object], None]) -> None:
        """Take off, fly to the job's stops and do its action.

        `report` is told once, and never from within this call, what the action gave or the
        `FlightFailed` that ended it; with no action to do, None on arrival. It must be told within
        the kernel: from one of its events or coroutines, or by `kernel.post(report, result)`.
        """
        ...

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover.

        Nothing of its job is reported any more; a single command raises `FlightFailed`.
        """
        ...

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        ...

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone that hovers measures under this name."""
        ...

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone that hovers has under this name."""
        ...

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height; does nothing for a drone that flies."""
        ...

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        ...

    async def land(self, drone: str) -> None:
        """Land here."""
        ...

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it is lost."""
        ...
