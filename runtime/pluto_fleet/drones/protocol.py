"""How one drone is flown: what a class must have for an app to fly with it (thesis 4.4).

Metres, seconds, radians, volts, in the map's frame: a class that wraps a library that counts in feet or
from the place of take-off converts, here and nowhere else. `docs/navigation.md` has one in forty
lines, and `conformance` tests any.

The rules for all commands:

- They are coroutines on asyncio's event loop, and *return when it is done*: on arrival by what the
  drone tells (0.1 m), hovering, landed. A command that returns earlier lets an app do its action
  somewhere else.
- They *raise one `NavigationError` a failure* (`errors.py`), as soon as it is known: a drone that is
  silent for more than a second during a command is `LinkLost`, one that fell is `Crashed`, one that
  answers but does not arrive is `TargetTimeout`. None waits for ever.
- They *refuse what they cannot do before anything moves*, and never do something like it instead. A
  target that is no finite number or below the ground is `OutsideArea`, a speed that is not above 0
  is `Rejected`.
- One command at a time. The runtime may *cancel* it, as asyncio does: let the `CancelledError` out
  at once and wait for nothing on the way. The drone may go on for that moment; `hold` is called
  next. Telemetry goes on meanwhile, and so it does during every command.
- *Nothing may hold up the event loop* for more than 50 ms: all drones are flown by it. A library
  that blocks is called in a thread of the navigation's own, a daemon, with limits; what that thread
  hears comes back by `loop.call_soon_threadsafe`.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain
    from plutoc_runtime.domain.model import Item, Point


LINK_LOST = "link lost"
"""It does not answer any more."""
CRASHED = "crashed"
"""It fell, hit something or lies on its back."""
LOCKED = "locked"
"""It will not fly until it is switched off and on."""
BATTERY_LOW = "battery low"
"""It must come down now, where it is."""
POSITION_LOST = "position lost"
"""It does not know any more where it is: it must come down now, wherever that is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneTelemetry:
    """One drone at one moment; a new value each time that it tells something."""

    time: float
    """When it told this, by `time.monotonic()`; minus infinity: it has not told anything yet.

    This is how silence is seen: it must not be the time at which it is asked.
    """
    position: Point
    """Metres, in the map's frame: x and y along the map, z up from its ground."""
    yaw: float
    """Where its nose points: radians, 0 along x, counter-clockwise."""
    voltage: float
    """Volts, as they are now, or 0 where it cannot tell."""
    battery_level: float
    """What is left of the battery, from 0 to 1, corrected for its load; 1 where it cannot tell."""
    flying: bool
    """Whether its motors carry it: from when it leaves the ground until they are off."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneEvent:
    """Something that happened to a drone without a command."""

    kind: str
    """`LINK_LOST`, `CRASHED`, `LOCKED`, `BATTERY_LOW` or `POSITION_LOST`; others are only put into the log."""
    reason: str
    """A sentence for a person, without the drone's name: "it lies on its back"."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneSetup:
    """One drone of the fleet file, for the navigation that is to fly it."""

    id: str
    """Its name in the fleet file: name it in what you raise."""
    uri: str | None
    """How to reach it, in the words of its library; None: the fleet file does not say."""
    home: Point
    """Where it stands when it is at home, in the map's frame."""
    speed: float
    """The most that its category permits, metres per second."""
    options: Mapping[str, object]
    """The table `[navigation.NAME]` of the fleet file, the drone's own `[drone.options]` on top."""
    folder: Path
    """Where it may keep files, such as photos; shared by all drones, and there already."""


class DroneNavigation(Protocol):
    """One drone. The class is called with a `DroneSetup`; it reaches for nothing before `connect`."""

    async def connect(self) -> None:
        """Reach the drone, and return once `telemetry` says where it is.

        Called again after the link was lost, as often as it takes: begin anew then, on what hovers
        as on what stands. Raises `LinkLost` if the drone is not there; the runtime waits 15 s.
        Arms nothing, and starts no motor.
        """
        ...

    async def preflight(self) -> Sequence[str]:
        """Return why it must not take off now, a short reason each; nothing: it is ready.

        Asked before the first flight and before every take-off: quick, and harmless at any time.
        """
        ...

    async def takeoff(self, height: float, speed: float) -> None:
        """Rise straight up until it hovers at this height above the map's ground.

        Arms if that is needed. Raises `NotReady` where `preflight` would have had a reason.
        """
        ...

    async def go_to(self, target: Point, speed: float) -> None:
        """Fly straight to a point, never faster than this, and hover there.

        The speed is a limit, not a wish: a course that eases in and out peaks above its mean.
        Raises `Rejected` for a drone that does not fly.
        """
        ...

    async def hold(self) -> None:
        """Stop here, and return once it hovers; does nothing for a drone that stands on the ground.

        Called after a command was cancelled, and at any other time.
        """
        ...

    async def land(self, speed: float) -> None:
        """Come down straight, and return when the motors are off.

        Does nothing for a drone that stands on the ground.
        """
        ...

    async def emergency_stop(self) -> None:
        """Switch the motors off, now, wherever it is: it falls.

        Called only when a person has said just that, and by no other command of a navigation.
        """
        ...

    async def close(self) -> None:
        """Let go of the drone; `events` ends, and no thread, task or socket is left.

        Never by cutting motors: a library that does so when it lets go must land first, or wait.
        Called once, mostly with the drone landed; it may not be connected, or have been lost.
        """
        ...

    @property
    def telemetry(self) -> DroneTelemetry:
        """The last it told: at once, at least five times a second while it is connected.

        The last known while it is silent; its `time` shows that.
        """
        ...

    def events(self) -> AsyncIterator[DroneEvent]:
        """Return what happens to it without a command, from when it was made until `close`.

        Iterated over once. Tell each thing once, when it begins.
        """
        ...


# What only some drones can do. Each is found by the names of its methods.


@runtime_checkable
class Acts(Protocol):
    """A drone that does some of the built-in actions."""

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why it cannot do an action, for a person, or None: asked before anything flies.

        The hardware decides: "cf1 has no camera". Called once it is connected.
        """
        ...

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        """Do an action where it hovers, and return what came of it.

        `measure` gives a number, `take_photo` a `Photo`, the others None. Raises `ActionNotDone`.
        """
        ...


@runtime_checkable
class Readable(Protocol):
    """A drone with values of its own that an app's own actions may use."""

    async def read(self, name: str) -> float:
        """Return what it measures under this name; `Rejected`: it has no such name."""
        ...

    async def write(self, name: str, value: float) -> None:
        """Set what it has under this name, and return once it has; `Rejected`: it has no such."""
        ...


@runtime_checkable
class Locatable(Protocol):
    """A drone that can be told its position, as measured from outside."""

    async def locate(self, position: Point) -> None:
        """Hear where it is now, in the map's frame: many times a second. Waits for no answer."""
        ...


@runtime_checkable
class CaredFor(Protocol):
    """A drone that must be told that a person has looked after it, before it flies again."""

    async def looked_after(self) -> None:
        """Forget what has happened to it, a crash, say; starts no motor.

        Called only because a person has said just that, of a drone that stands on the ground.
        """
        ...


@runtime_checkable
class Identifiable(Protocol):
    """A drone that can show which one it is."""

    async def identify(self) -> None:
        """Blink or beep for some seconds, and be afterwards as before. Starts no motor."""
        ...


@runtime_checkable
class Scannable(Protocol):
    """A class, not a drone: one that can look which drones are there."""

    async def scan(self, options: Mapping[str, object]) -> Sequence[str]:
        """Return the URIs of all drones that answer; a static method of the class.

        The options are the table `[navigation.NAME]` of the fleet file. Commands no drone.
        """
        ...
