"""A drone that exists only here, in which anything can go wrong, and a loop on which it takes no time to fly.

`run` runs a coroutine on a `JumpingLoop`, whose clock jumps to what comes next: ten minutes take a moment.
`FakeDrone` is the drone and its navigation in one: what it was `told`, where it is, and what befalls it.
"""

from __future__ import annotations

import asyncio
import selectors
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping, Sequence
from math import dist, inf, isfinite
from typing import Any, TypeVar

from pluto_fleet.drones.protocol import (
    CRASHED,
    Crashed,
    DroneEvent,
    DroneTelemetry,
    LinkLost,
    OutsideArea,
    Rejected,
)
from pluto_fleet.shared.domain.actions import Plain
from pluto_fleet.shared.domain.model import Item, Point

T = TypeVar("T")

# Time


TURN = 1e-9
"""Seconds that a turn of the loop takes: what is due but for the rounding of a number is due in the next."""


class _Selector(selectors.DefaultSelector):
    """Instead of waiting, lets the time pass."""

    def __init__(self) -> None:
        super().__init__()
        self.passes: Callable[[float], None] | None = None

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Return what can be read now."""
        ready = super().select(0)
        if not ready and timeout is None:
            raise RuntimeError("nothing will ever happen again, and a task still waits")
        if not ready and timeout is not None and self.passes is not None:
            self.passes(max(timeout, TURN))
        return ready


class JumpingLoop(asyncio.SelectorEventLoop):
    """A loop whose clock jumps: whoever it talks to must run on it, too, and it waits for no thread."""

    def __init__(self) -> None:
        self.now = 1000.0
        selector = _Selector()
        selector.passes = self.advance
        super().__init__(selector)

    def time(self) -> float:
        """Return the time as all here know it."""
        return self.now

    def advance(self, seconds: float) -> None:
        """Let time pass: within a step of a task, that is as if it blocked."""
        self.now += seconds


def run(flight: Coroutine[Any, Any, T]) -> T:
    """Run this to its end; nothing may be left of it."""
    with asyncio.Runner(loop_factory=JumpingLoop) as runner:
        value = runner.run(flight)
        left = asyncio.all_tasks(runner.get_loop())
    assert not left
    return value


def the_loop() -> JumpingLoop:
    """Return the loop that runs."""
    loop = asyncio.get_running_loop()
    assert isinstance(loop, JumpingLoop)
    return loop


async def passes(seconds: float) -> None:
    """Let so many seconds pass, of such a loop."""
    await asyncio.sleep(seconds)


# The drone

YAW = 1.0
"""Radians: it never turns."""


class FakeDrone:
    """A `DroneNavigation` and its drone in one."""

    def __init__(self, id: str = "cf1", home: Point = (1.0, 1.0, 0.0)) -> None:
        self.id, self.home = id, home
        self.told: list[str] = []
        """The commands that reached it."""
        self.attempts = 0
        """How often a caller has tried to connect to it."""
        self.answers = True
        """Whether it can be reached, and tells where it is."""
        self.reasons: Sequence[str] = ()
        self.hangs: set[str] = set()
        """The methods that never return."""
        self.clings: set[str] = set()
        """Of those, the ones that do not even let go when cancelled."""
        self.fell: type[Exception] = Crashed
        """What a flight raises that ends on the ground."""
        self.clung = False
        """Whether it has not let go once."""
        self.raises: dict[str, BaseException] = {}
        self.blocks: dict[str, float] = {}
        """The methods that hold up the whole loop, and for how many seconds."""
        self.slow: dict[str, float] = {}
        """The methods that take some seconds longer."""
        self.level = 1.0
        self.motors = False
        self.position = home
        """Where it is when it does not move."""
        self.track: list[tuple[float, Point]] = []
        self.closed_at: tuple[bool, Point] | None = None
        """Whether it flew when its link was closed, and where it was."""
        self.lacks: set[str] = set()
        self._leg: tuple[float, float, Point, Point] | None = None
        self._told_last: DroneTelemetry | None = None
        self._events: asyncio.Queue[DroneEvent | None] = asyncio.Queue()
        self._connected = False

    # What happens to it

    def happens(self, kind: str, reason: str = "so it is") -> None:
        """Let it tell an event."""
        self.events_told(DroneEvent(kind=kind, reason=reason))

    def events_told(self, event: DroneEvent) -> None:
        """Let it tell this."""
        self._events.put_nowait(event)

    def falls(self, *, tells: bool = True) -> None:
        """Let it fall to the ground."""
        x, y, _ = self.place
        self.motors, self._leg, self.position = False, None, (x, y, 0.0)
        if tells:
            self.reasons = ("it lies on its back",)
            self.happens(CRASHED, "it lies on its back")

    def put(self, place: Point) -> None:
        """Take it somewhere, motors off or not: wind, or a person."""
        self._leg, self.position = None, place

    def goes_silent(self) -> None:
        """Let it tell nothing any more; it hears nothing either."""
        self._tell()
        self.answers = self._connected = False

    @property
    def place(self) -> Point:
        """Where it is now."""
        if self._leg is None:
            return self.position
        begins, ends, start, end = self._leg
        share = min(1.0, (the_loop().now - begins) / (ends - begins)) if ends > begins else 1.0
        x, y, z = (a + (b - a) * share for a, b in zip(start, end, strict=True))
        return x, y, z

    # What a navigation has

    async def connect(self) -> None:
        """Reach it."""
        self.attempts += 1
        await self._does("connect")
        if not self.answers:
            await passes(2)
            raise LinkLost(f"{self.id} does not answer")
        self._connected = True

    async def preflight(self) -> Sequence[str]:
        """Return why it must not take off."""
        await self._does("preflight")
        return self.reasons

    async def takeoff(self, height: float, speed: float) -> None:
        """Rise."""
        await self._does("takeoff")
        self.told.append(f"takeoff {height:g}")
        x, y, _ = self.place
        self.motors = True
        await self._move((x, y, height), speed)

    async def go_to(self, target: Point, speed: float) -> None:
        """Fly straight to a point."""
        await self._does("go_to")
        if not all(map(isfinite, target)) or target[2] < 0:
            raise OutsideArea(f"{self.id} cannot fly to {target}")
        if not 0 < speed < inf:
            raise Rejected(f"{self.id} cannot fly at {speed} m/s")
        if not self.motors:
            raise Rejected(f"{self.id} must take off first")
        self.told.append("go to {:g} {:g} {:g}".format(*target))
        await self._move(target, speed)

    async def hold(self) -> None:
        """Hover."""
        await self._does("hold")
        self.told.append("hold")
        self._leg, self.position = None, self.place

    async def land(self, speed: float) -> None:
        """Land."""
        await self._does("land")
        self.told.append("land")
        x, y, _ = self.place
        await self._move((x, y, 0.0), speed)
        self.motors = False
        self._tell(at_once=True)

    async def emergency_stop(self) -> None:
        """Switch the motors off."""
        await self._does("emergency_stop")
        self.told.append("emergency stop")
        self.falls(tells=False)

    async def close(self) -> None:
        """Let go of it."""
        self.closed_at = (self.motors, self.place)
        self._events.put_nowait(None)
        await self._does("close")

    @property
    def telemetry(self) -> DroneTelemetry:
        """Return the last it told."""
        if "telemetry" in self.raises:
            raise self.raises["telemetry"]
        return self._tell()

    async def events(self) -> AsyncIterator[DroneEvent]:
        """Return what happens to it."""
        await self._does("events")
        while (event := await self._events.get()) is not None:
            yield event

    # What only some have

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why it cannot do an action."""
        return f"{self.id} cannot {action}" if action in self.lacks else None

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        """Do an action."""
        await self._does("act")
        self.told.append(action)
        await passes(1)
        return 21.5 if action == "measure" else None

    async def read(self, name: str) -> float:
        """Return a value."""
        await self._does("read")
        if name != "range.front":
            raise Rejected(f"{self.id} has no log variable {name}")
        return 0.5

    async def write(self, name: str, value: float) -> None:
        """Set a value."""
        await self._does("write")
        self.told.append(f"{name} = {value:g}")

    # How

    def _tell(self, *, at_once: bool = False) -> DroneTelemetry:
        last, now = self._told_last, the_loop().now
        is_due = at_once or last is None or now - last.time > 0.09
        if self._connected and self.answers and is_due:
            last = DroneTelemetry(
                time=now,
                position=self.place,
                yaw=YAW,
                voltage=4.0,
                battery_level=self.level,
                flying=self.motors,
            )
            self.track.append((now, last.position))
        elif last is None:
            last = DroneTelemetry(
                time=-inf, position=self.home, yaw=YAW, voltage=0.0, battery_level=1.0, flying=False
            )
        self._told_last = last
        return last

    async def _move(self, target: Point, speed: float) -> None:
        now, start = the_loop().now, self.place
        self._leg = now, now + dist(start, target) / speed, start, target
        while self._leg is not None and the_loop().now < self._leg[1]:
            await asyncio.sleep(0.05)
            if not self.answers:
                await passes(1)
                raise LinkLost(f"{self.id} stopped answering")
            if not self.motors:
                raise self.fell(f"{self.id} fell")
        self.position = self.place
        self._leg = None

    async def _does(self, method: str) -> None:
        if method in self.blocks:
            the_loop().advance(self.blocks[method])
        if method in self.raises:
            raise self.raises[method]
        while method in self.hangs:
            try:
                await passes(1e6)
            except asyncio.CancelledError:
                if method not in self.clings:
                    raise
                self.clung = True
        if method != "connect" or method in self.slow:
            await asyncio.sleep(self.slow.get(method, 0.0))
