"""Jobs for drones, and the interface by which an app gives them to the gateway."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from ..shared.domain.errors import Failure, FlightFailed

if TYPE_CHECKING:
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item, Point
    from .flown import Flown
    from .reports import Down, DroneReport, FleetReport
    from .telemetry import Telemetry


UNCERTAIN = "uncertain"
MISHAPS = ("lost", "crash", "battery", UNCERTAIN)
"""What can happen to simulated drones: a lost link, a fall, an empty battery, and an action of which no report comes."""

Report = Callable[[object], object]
"""Called with the action's result, or the `FlightFailed` that ended the job."""


class Job(Protocol):
    """A drone's job for a trip."""

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: a flight has the same id in every run."""
        ...

    @property
    def drone(self) -> str:
        """Who flies."""
        ...

    @property
    def stops(self) -> tuple[Point, ...]:
        """The points to fly to, in order; navigation finds the route."""
        ...

    @property
    def action(self) -> str | None:
        """The built-in action at the last stop; None: hover there."""
        ...

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """The parameters of the action."""
        ...

    @property
    def item(self) -> Item | None:
        """The item to pick or release."""
        ...

    @property
    def seconds(self) -> float:
        """The expected duration of the action."""
        ...

    @property
    def beside(self) -> bool:
        """Whether the action may be done beside the last stop, where another drone has that place."""
        ...

    def begins(self) -> None:
        """Called right before the action is done; not called if there is none.

        If this raises `FlightFailed`, the action must not be done.
        """
        ...


class CommandLink(Protocol):
    """How a brain commands its drones, by their ids, as long as it is the one in command.

    Metres, seconds. A trip is one job, given once and reported once, and remembered. Other commands
    return when they are done, and raise `FlightFailed` when the drone cannot finish. A cancelled command
    leaves the drone hovering where it is.
    """

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry, an object that is always current."""
        ...

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command that moves it, or acts; not while it waits for its way."""
        ...

    def fly(self, job: Job, report: Report) -> None:
        """Take off, fly to the job's stops and do its action.

        `report` is called once, and never from within this call, with the action's result or the
        `FlightFailed` that ended it; with no action to do, with None on arrival. It is called within
        the kernel: from one of its events or coroutines, or by `kernel.post(report, result)`.
        """
        ...

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover.

        Nothing of its job is reported any more; a single command raises `FlightFailed`.
        """
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

    async def join(self, joining: Mapping[str, Any]) -> str:
        """Take a drone into the fleet, given as plain data; return why that cannot be, or nothing."""
        ...

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a simulated drone; return why it cannot, or nothing.

        `uncertain` returns when the action of that job was done, and no report comes of it.
        """
        ...

    async def home(self, drone: str) -> None:
        """Fly to its dock, and land there."""
        ...

    async def land(self, drone: str) -> None:
        """Land here."""
        ...

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it is lost."""
        ...

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        ...

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        ...

    async def fleet_report(self) -> FleetReport:
        """Query all drones and the ledger; from now on this brain is in command."""
        ...

    def attach(self, id: str, report: Report) -> None:
        """Register for the report of an earlier job: called when it ends, or now if it has."""
        ...

    def forget(self, id: str) -> None:
        """Forget a job that is not needed any more: its id may be used again."""
        ...

    async def bring_down(self, how: Down) -> None:
        """Abort everything and bring all drones down; return when all that can have landed."""
        ...


class GatewayLink(CommandLink, Protocol):
    """A command link to a gateway in another process."""

    def on_telemetry(self, watcher: Callable[[], object]) -> None:
        """Call this at each update of the telemetry."""
        ...

    def on_flown(self, hear: Callable[[Flown], object]) -> None:
        """Call this with each command that a drone has flown, as plain data."""
        ...

    async def goodbye(self) -> None:
        """Allow the gateway to exit once all drones have landed."""
        ...

    async def close(self) -> None:
        """Close the connection: the gateway goes on, and lands all drones unless another brain connects."""
        ...


def motors_cut(drone: str) -> FlightFailed:
    """Return the failure of a drone's command when its motors were cut."""
    return FlightFailed(Failure.CRASH, f"{drone}'s motors were cut")
