"""The navigation protocol: what a class must have to fly one drone for an app (thesis 4.4).

Metres, seconds, radians, volts, in the map's frame: a class that wraps a library that counts in feet or
from the place of take-off converts, here and nowhere else. `docs/navigation.md` has one in forty
lines, and `conformance` tests any.

The rules for all commands:

- They are coroutines on asyncio's event loop, and *return when it is done*: on arrival by the
  drone's telemetry (within 0.1 m indoors, within half a metre by satellites), hovering, landed. A command
  that returns earlier lets an app do its action somewhere else.
- They *raise one `NavigationError` per failure* (below), as soon as it is known: a drone that is
  silent for longer than `DroneSetup.silence` during a command is `LinkLost`, one that fell is `Crashed`, one
  that answers but does not arrive is `TargetTimeout`. None waits without a limit.
- They *refuse what they cannot do before anything moves*, and never do something like it instead. A
  target that is no finite number or below the ground is `OutsideArea`, a speed that is not above 0
  is `Rejected`.
- One command at a time. The runtime may *cancel* it, as asyncio does: let the `CancelledError` out
  at once and wait for nothing on the way. The drone may go on for that moment; `hold` is called
  next, or, on its way to what moves, `go_to` with where that will be. Telemetry goes on meanwhile, and so it does during every command.
- *Nothing may block the event loop* for more than 50 ms: all drones are flown by it. A library
  that blocks is called in a thread of the navigation's own, a daemon, with limits; what that thread
  receives comes back by `loop.call_soon_threadsafe`.

What counts of an error is its attribute `failure`, and not its class: a navigation in another package need
not import these, but only give its exceptions this attribute. Their text is a reason for a person, such as
"cf1 stopped answering 1.2 s ago".
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Protocol, runtime_checkable

from ..geodesy import LocalPlane
from ..jobs.reports import SILENCE
from ..shared.domain.actions import Plain
from ..shared.domain.airspace import Airspace
from ..shared.domain.model import Item, Point, Sighting


class NavigationError(Exception):
    """A drone could not carry out a command, for a reason outside the software.

    Any other exception of a navigation is a bug in it: the flight fails with that reason, and the
    traceback goes to the log.
    """

    failure: ClassVar[str] = "ACTION"
    """LINK, CRASH, BATTERY, REFUSED or ACTION: the kind of failure for the app."""


class LinkLost(NavigationError):
    """It does not answer, or has sent nothing for longer than it may.

    Its position is unknown; it is reconnected, and flown home if it still hovers.
    """

    failure = "LINK"


class Crashed(NavigationError):
    """It fell, hit something or lies on its back: it needs a person."""

    failure = "CRASH"


class Locked(NavigationError):
    """Its motors are locked until it is restarted."""

    failure = "CRASH"


class PositionLost(NavigationError):
    """It has lost its position: it lands, and does no action there.

    Also sent as an event, as a drone without a command must come down as well.
    """

    failure = "LINK"


class BatteryLow(NavigationError):
    """Its battery is too low for this."""

    failure = "BATTERY"


class Rejected(NavigationError):
    """It answered, and refuses: a command at the wrong moment, or an unknown name."""

    failure = "REFUSED"


class NotReady(NavigationError):
    """It is not in a state to fly; `preflight` says why."""

    failure = "REFUSED"


class OutsideArea(NavigationError):
    """The target is not permitted: refused before it moves, and never adjusted."""

    failure = "REFUSED"


class TargetTimeout(NavigationError):
    """It is healthy and answers, but has not arrived in ample time."""

    failure = "ACTION"


class ActionNotDone(NavigationError):
    """An action failed; the drone is healthy."""

    failure = "ACTION"


LINK_LOST = "link lost"
"""It does not answer any more."""
CRASHED = "crashed"
"""It fell, hit something or lies on its back."""
LOCKED = "locked"
"""It will not fly until it is restarted."""
BATTERY_LOW = "battery low"
"""It must land now, where it is."""
POSITION_LOST = "position lost"
"""It has lost its position: it must land now, wherever it is."""
ACTS_BY_ITSELF = "acts by itself"
"""Its own failsafe flies it, or a person: nothing is ordered of it until it has landed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneTelemetry:
    """The state of one drone; a new object for each message."""

    time: float
    """When it was received, by `time.monotonic()`; minus infinity: nothing was received yet.

    Silence is detected by this: it must not be the time of the access.
    """
    position: Point
    """Metres, in the map's frame: x and y along the map, z up from its ground."""
    yaw: float
    """Its heading: radians, 0 along x, counter-clockwise."""
    voltage: float
    """The present voltage, or 0 if unknown."""
    battery_level: float
    """The charge of the battery, from 0 to 1, corrected for its load; 1 for a drone that never tells it."""
    flying: bool
    """Whether it flies: from when it leaves the ground until its motors are off."""
    battery_told: bool = True
    """False: the level is not known yet, and stands for nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEvent:
    """Something that happened to a drone without a command."""

    kind: str
    """`LINK_LOST`, `CRASHED`, `LOCKED`, `BATTERY_LOW`, `POSITION_LOST` or `ACTS_BY_ITSELF`; others are only logged."""
    reason: str
    """A sentence for a person, without the drone's name: "it lies on its back"."""


InView = Callable[[Point, float, float], tuple[Sighting, ...]]
"""Returns what moves in a rectangle of the map: around a place, so many metres along x and along y."""


def nothing_in_view(place: Point, width: float, height: float) -> tuple[Sighting, ...]:
    """Return nothing, as for a fleet without a tracker."""
    return ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneSetup:
    """One drone of the fleet file, for the navigation that is to fly it."""

    id: str
    """Its name in the fleet file, for your error messages."""
    uri: str | None
    """Its address, in its library's format; None: the fleet file has none."""
    home: Point
    """Its home, in the map's frame."""
    speed: float
    """The maximum speed of its category, in metres per second."""
    options: Mapping[str, object]
    """The table `[navigation.NAME]` of the fleet file, overridden by the drone's `[drone.options]`."""
    folder: Path
    """An existing folder for files such as photos, shared by all drones."""
    silence: float = SILENCE
    """Seconds for which it may tell nothing in the air before its link counts as lost."""
    plane: LocalPlane | None = None
    """Where the map lies on the Earth; None: the fleet file does not say."""
    airspace: Airspace | None = None
    """The map, for drones that keep within it by themselves as well; None: it is only asked how it is."""
    in_view: InView = nothing_in_view
    """What the fleet's tracker sees where a camera looks that cannot tell by itself what moves."""


class DroneNavigation(Protocol):
    """One drone. The class is called with a `DroneSetup`; it opens nothing before `connect`."""

    async def connect(self) -> None:
        """Connect to the drone, and return once `telemetry` has its position.

        Called again after the link was lost, as often as it takes: begin anew then, whether the drone
        hovers or is on the ground. Raises `LinkLost` if it does not answer; the runtime waits 15 s.
        Arms nothing, and starts no motor.
        """

    async def preflight(self) -> Sequence[str]:
        """Return why it must not take off now, as short reasons; nothing: it is ready.

        Called before the first flight and before every take-off: quick, and harmless at any time.
        """

    async def takeoff(self, height: float, speed: float) -> None:
        """Take off straight up, and hover at this height above the map's ground.

        Arms if that is needed. Raises `NotReady` if `preflight` would have a reason.
        """

    async def go_to(self, target: Point, speed: float) -> None:
        """Fly straight to a point, never faster than this, and hover there.

        The speed is a limit, not a wish: a course that eases in and out peaks above its mean.
        Raises `Rejected` for a drone that does not fly.
        """

    async def hold(self) -> None:
        """Stop here, and return once it hovers; does nothing for a drone on the ground.

        Called after a command was cancelled, and at any other time.
        """

    async def land(self, speed: float) -> None:
        """Land straight down, and return when the motors are off.

        Does nothing for a drone on the ground.
        """

    async def emergency_stop(self) -> None:
        """Switch the motors off at once, wherever it is: it falls.

        Called only on a user's explicit command, and by no other command of a navigation.
        """

    async def close(self) -> None:
        """Close the link; `events` ends, and no thread, task or socket is left.

        This must not cut motors: a library that does so when it closes must land first, or wait.
        Called once, usually after a landing; it may be unconnected, or lost.
        """

    @property
    def telemetry(self) -> DroneTelemetry:
        """The latest state, without waiting; at least five times a second new while connected.

        The last known one while it is silent; its `time` shows that.
        """

    def events(self) -> AsyncIterator[DroneEvent]:
        """Return an iterator of what happens to it without a command, until `close`.

        Iterated over once. Yield each event once, when it begins.
        """


# Optional abilities, each recognised by the names of its methods


@runtime_checkable
class Acts(Protocol):
    """A drone that can do some of the built-in actions."""

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why it cannot do an action, as a sentence, or None; called before anything flies.

        It depends on the hardware: "cf1 has no camera". Called once it is connected.
        """

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        """Do an action where it hovers, and return its result.

        `measure` returns a number, `take_photo` a `Photo`, the others None. Raises `ActionNotDone`.
        """


@runtime_checkable
class ActsOnTheWay(Protocol):
    """A drone that can do some of the built-in actions while it flies, such as `take_photo`."""

    async def trigger(self, action: str, parameters: Mapping[str, Plain]) -> object:
        """Do an action at once, without a stop, and return its result as `act` does.

        Called during other commands. Raises `ActionNotDone`, also for an action that needs a stop.
        """
        ...


@runtime_checkable
class Follows(Protocol):
    """A drone that flies on to where something that moves will be, in a way of its own.

    Any other is sent there by `go_to`, while it is on its way by the one before, which was cancelled.
    """

    async def follow(self, target: Point, speed: float, seconds: float) -> None:
        """Fly on to a point without a stop, never faster than this, and hover there unless called anew.

        To be there in so many seconds, or as soon as the speed allows; 0: at once. Called again and again,
        before it has arrived: the call before is cancelled then.
        """
        ...


@runtime_checkable
class Sees(Protocol):
    """A drone whose camera tells what moves in its view."""

    async def sees(self) -> Sequence[Sighting]:
        """Return what moves in its view now, each with the id by which it is tracked; called as it flies."""
        ...


@runtime_checkable
class Readable(Protocol):
    """A drone with sensors, variables or parameters that an app's own actions may use."""

    async def read(self, name: str) -> float:
        """Return a sensor or variable; raise `Rejected` if there is none of this name."""

    async def write(self, name: str, value: float) -> None:
        """Set a parameter, and return once it is set; raise `Rejected` if there is none of this name."""


@runtime_checkable
class Locatable(Protocol):
    """A drone that accepts its position, as measured from outside."""

    async def locate(self, position: Point) -> None:
        """Send it its position in the map's frame, many times a second; without waiting for an answer."""


@runtime_checkable
class CaredFor(Protocol):
    """A drone that must be notified of its repair before it flies again."""

    async def looked_after(self) -> None:
        """Reset its state, such as a crash; starts no motor.

        Called only on a user's explicit command, for a drone on the ground.
        """


@runtime_checkable
class Identifiable(Protocol):
    """A drone that can identify itself."""

    async def identify(self) -> None:
        """Blink or beep for some seconds, and then restore the former state. Starts no motor."""


@runtime_checkable
class Scannable(Protocol):
    """A class that can scan for drones."""

    async def scan(self, options: Mapping[str, object]) -> Sequence[str]:
        """Return the URIs of all drones that answer; a static method of the class.

        The options are the table `[navigation.NAME]` of the fleet file. Commands no drone.
        """


@runtime_checkable
class Addressed(Protocol):
    """A class that knows how the addresses of its drones are written."""

    def canonical_uri(self, uri: str) -> str:
        """Return a drone's URI with all that it leaves out; a static method of the class.

        Two that reach one drone are the same text then. Raises `ValueError` with what is wrong, to be said
        after the URI. Called before anything flies, also by `--dry-run`; reaches for nothing.
        """
