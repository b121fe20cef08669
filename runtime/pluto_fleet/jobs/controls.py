"""The commands that the gateway can give to each drone, simulated or real, in metres and seconds.

No-fly areas and other drones are not considered here: see `gateway/executor.py`.
"""

from __future__ import annotations

from collections.abc import Coroutine, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ..shared.domain.model import Category, Point  # settings are read by these types

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.actions import Plain
    from ..shared.domain.fleet_data import FleetData
    from ..shared.domain.model import Item
    from .reports import DroneReport
    from .telemetry import Telemetry


@dataclass(frozen=True, slots=True, kw_only=True)
class FleetDrone:
    """A drone of a fleet, real or simulated."""

    id: str
    category: Category
    home: Point
    index: int = 0
    """Its index in the fleet file."""


def fleet_drones(app: App, fleet: FleetData) -> list[FleetDrone]:
    """Return the drones of a fleet file."""
    categories = {category.name: category for category in app.categories}
    return [
        FleetDrone(id=one.id, category=categories[one.category], home=one.home, index=index)
        for index, one in enumerate(fleet.drones)
    ]


class TakeOff(NamedTuple):
    """Take off straight up to a height; nothing for a drone that flies."""

    height: float


class GoTo(NamedTuple):
    """Fly straight to a point."""

    target: Point
    seconds: float = 0.0
    """Seconds that it may take its time for, at least; 0: as fast as it flies."""


class Land(NamedTuple):
    """Land here; nothing for a drone that stands on the ground."""


class Hold(NamedTuple):
    """Hover, for as long as an action of the app's own takes; it never ends by itself."""


class Act(NamedTuple):
    """Do a built-in action here; what comes of it is its result."""

    action: str
    parameters: Mapping[str, Plain]
    item: Item | None
    flight: str | None = None
    """The job that it is done for, by the id of its flight."""


class Read(NamedTuple):
    """Return a sensor or variable, for an action of the app's own."""

    name: str


class Write(NamedTuple):
    """Set a parameter, for an action of the app's own."""

    name: str
    value: float


class Trigger(NamedTuple):
    """Do a built-in action at once, be the drone on its way or not; what comes of it is its result."""

    action: str
    parameters: Mapping[str, Plain]


class See(NamedTuple):
    """Return what moves in the view of its camera, as `Sighting`s."""


class Cut(NamedTuple):
    """Switch its motors off now, wherever it is; only ever on a user's explicit command.

    A command in progress raises `FlightFailed`, and the drone takes no commands until `mended`.
    """


Command = TakeOff | GoTo | Land | Hold | Act | Trigger | See | Read | Write | Cut


class Controls(Protocol):
    """A team of drones, by their ids, one command at a time for each."""

    @property
    def telemetry(self) -> Mapping[str, Telemetry]:
        """What is known of each drone; the values stay current."""

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone's hardware cannot do a built-in action, or None."""

    def begins(self, drone: str, flight: str | None, seconds: float) -> None:
        """Called at the start of a flight, with its expected duration; None: it is for no job.

        Raises `FlightFailed` if the drone takes no commands.
        """

    def do(self, drone: str, command: Command) -> Coroutine[Any, Any, Any]:
        """Carry out a command, and return when it is done: on arrival, when landed.

        Raises `FlightFailed` when the drone cannot finish. Cancelled, it leaves the drone hovering.
        """

    def turn(self, drone: str, command: GoTo) -> bool:
        """Send a drone elsewhere that is on its way to a point, without a stop; False: it is not.

        The command under way is done, then, when it has arrived there.
        """

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; a command under way raises `FlightFailed`."""

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked anew."""

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again; False: it is lost."""

    async def fetched(self, drone: str) -> bool:
        """Wait until a person has put a drone back into its dock, well; False: that does not happen."""

    def unload(self, drone: str) -> None:
        """Take off what it carries: a person meets it in its dock."""

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""


class ForwardingControls:
    """A wrapper of other controls, which forwards all that is no command."""

    def __init__(self, controls: Controls) -> None:
        self._controls = controls
        self.telemetry = controls.telemetry
        self.why_not = controls.why_not
        self.begins = controls.begins
        self.turn = controls.turn
        self.break_off = controls.break_off
        self.mended = controls.mended
        self.reach = controls.reach
        self.fetched = controls.fetched
        self.unload = controls.unload
        self.drone_report = controls.drone_report
