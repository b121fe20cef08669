"""The commands that the gateway can give to each drone, simulated or real.

Metres, seconds. Each command returns when it is done: on arrival, when landed; it raises
`FlightFailed` when the drone cannot finish. A cancelled command leaves the drone hovering
where it is. No-fly areas and other drones are not considered here: see `gateway/executor.py`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Category, Item, Point
    from .reports import DroneReport
    from .telemetry import Telemetry


class FleetDrone(Protocol):
    """What the gateway needs to know about a drone."""

    @property
    def id(self) -> str:
        """Its name in the fleet."""
        ...

    @property
    def category(self) -> Category:
        """Its speed and endurance."""
        ...

    @property
    def home(self) -> Point:
        """Where its dock is."""
        ...

    @property
    def index(self) -> int:
        """Its index in the fleet file."""
        ...


class Controls(Protocol):
    """A team of drones, by their ids, one command at a time for each."""

    @property
    def telemetry(self) -> Mapping[str, Telemetry]:
        """What is known of each drone; the values stay current."""
        ...

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone's hardware cannot do a built-in action, or None."""
        ...

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        """Called at the start of a flight, with its expected duration; None: it is for no job.

        Raises `FlightFailed` if the drone takes no commands.
        """
        ...

    async def takeoff(self, drone: str, height: float) -> None:
        """Take off straight up to a height; does nothing for a drone that flies."""
        ...

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        ...

    async def land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        ...

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        ...

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do a built-in action here, and return its result."""
        ...

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable of a drone, for an action of the app's own."""
        ...

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone, for an action of the app's own."""
        ...

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; a command under way raises `FlightFailed`."""
        ...

    async def cut(self, drone: str) -> None:
        """Switch its motors off now, wherever it is; only ever on a user's explicit command.

        A command in progress raises `FlightFailed`, and the drone takes no commands until `mended`.
        """
        ...

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked anew."""
        ...

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again; False: it is lost."""
        ...

    async def fetched(self, drone: str) -> bool:
        """Wait until a person has put a drone back into its dock, well; False: that does not happen."""
        ...

    def unload(self, drone: str) -> None:
        """Take off what it carries: a person meets it in its dock."""
        ...

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        ...


class ForwardingControls:
    """A wrapper of other controls, which forwards all that is not a command to fly."""

    def __init__(self, controls: Controls) -> None:
        self._controls = controls
        self.telemetry = controls.telemetry
        """What is known of each drone."""

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone's hardware cannot do a built-in action, or None."""
        return self._controls.why_not(drone, action, parameters)

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        """Called at the start of a flight, with its expected duration."""
        self._controls.begins(drone, flight, seconds)

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked anew."""
        self._controls.mended(drone)

    async def fetched(self, drone: str) -> bool:
        """Wait until a person has put a drone back into its dock, well; False: that does not happen."""
        return await self._controls.fetched(drone)

    def unload(self, drone: str) -> None:
        """Take off what it carries: a person meets it in its dock."""
        self._controls.unload(drone)

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again; False: it is lost."""
        return await self._controls.reach(drone)

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        return await self._controls.drone_report(drone)
