"""A simulated drone that obeys a gateway: its telemetry, its command in progress, and what is stored of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, cast

from ..jobs.reports import DroneReport
from ..shared.alone.drones import Body
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.motion import varies
from ..shared.fleet.telemetry import Charge, Leg
from ..shared.hooks.plain_data import item_data, item_of, point_of
from ..shared.time.kernel import FLEET, Key

if TYPE_CHECKING:
    from ..jobs.controls import FleetDrone
    from ..shared.alone.world import World
    from ..shared.domain.model import Point
    from ..shared.domain.trace import Clock
    from ..shared.time.kernel import Future


@dataclass(frozen=True, slots=True)
class _Clock:
    """A kernel's time, which goes on between its events."""

    time: Callable[[], float]

    @property
    def now(self) -> float:
        return self.time()


HEIGHTS = 0.025
"""Metres by which heights vary, from way to way: their standard deviation, where durations vary, too."""


class SimulatedBody(Body):
    """A drone by a kernel's clock."""

    def __init__(self, drone: FleetDrone, world: World, time: Callable[[], float]) -> None:
        self.on_change: Callable[[], object] = _nothing
        """Called when its state has changed other than by time."""
        clock = cast("Clock", _Clock(time))
        super().__init__(drone.id, drone.home, drone.category, world, clock)
        self.above = 0.0
        """How much higher than it is it says that it is."""
        self.key: Key = FLEET + 1 + drone.index
        self.command = ""
        """The command in progress, one at a time."""
        self.over: Future[None] | None = None
        """Set when the command is done, if it takes time; fails if it is aborted."""
        self.cut_short = FlightFailed(Failure.REFUSED, "it was broken off")
        """Why the last command was cut short."""
        self.boot = 0
        """How often it was restarted."""
        self.done: dict[str, object] = {}
        """The jobs whose action it did, with their results."""

    @property
    def place(self) -> Point:
        """Where it is."""
        self.settle()
        return self.location

    @property
    def battery_level(self) -> float:
        """The charge of its battery, from 0 to 1."""
        self.settle()
        return super().battery_level

    @property
    def landed(self) -> bool:
        """Whether it is on the ground."""
        self.settle()
        return self._landed

    @property
    def report(self) -> DroneReport:
        """Return its report; one that takes no commands does not answer."""
        return DroneReport(
            drone=self.id,
            reached=self.down is None,
            location=self.place,
            landed=self.landed,
            battery_level=self.battery_level,
            boot=self.boot,
            carrying=None if self.carries is None else self.carries.name,
            done=dict(self.done),
            problems=() if self.down is None else (str(self.down),),
        )

    # Commands

    def follow(self, way: Sequence[Point], *, lands: bool = False) -> float:
        """Set out on a way; return when the drone will be at rest at its end."""
        if self.motion.spread:
            x, y, _ = way[-1]
            self.above = varies(HEIGHTS, f"{self._flight}/{x:.2f}/{y:.2f}/height") - 1.0
        return super().follow(way, lands=lands)

    def turn(self, legs: list[Leg], now: float, *, lands_at: float = inf) -> None:
        """Fly other legs from now on; it has landed at that time."""
        super().turn(legs, now, lands_at=lands_at)
        self.on_change()

    def dock(self) -> None:
        """Stand in its dock, where someone has carried it, and take commands again."""
        if self.down is not None:
            self.reboot()
        super().dock()

    def reboot(self) -> None:
        """Restart it: it forgets what it has done."""
        self.boot, self.done, self.settings = self.boot + 1, {}, {}

    def unload(self) -> None:
        """Take off what it carries."""
        self.carries = None
        self.on_change()

    def befall(self, what: Failure, why: str | None = None) -> bool:
        """Cause a fault now; return False if it took no commands before."""
        self.settle()
        if self.down is not None:
            return False
        self._happen(self._clock.now, what)
        if why is not None:
            self.down = FlightFailed(what, why)
        return True

    # Saving and restoring

    @property
    def data(self) -> dict[str, object]:
        """Everything of it as plain data, but for what it has done; all times are its clock's."""
        leg = self._legs[0]
        charge = self._charge
        down = self.down
        return {
            "boot": self.boot,
            "carries": item_data(self.carries),
            "down": None if down is None else [down.failure.name, str(down)],
            "reachable_at": self.reachable_at,
            "flight": self._flight,
            "drawn": {what.name: after for what, after in self._drawn.items()},
            "began": self._began,
            "charge": [charge.level, charge.since, charge.rate],
            "leg": [leg.start, leg.end, leg.leaves, leg.arrives],
            "lands_at": self._lands_at,
            "landed": self._landed,
            "flown": self._flown,
        }

    def restore(self, data: Mapping[str, Any], shift: float = 0.0) -> None:
        """Be as it was by a clock that was so much behind.

        What it was told to do, it does to the end, and then it hovers.
        """
        self.boot, self.carries = data["boot"], item_of(data["carries"])
        self.down = None
        self.reachable_at = data["reachable_at"] + shift
        if data["down"] is not None:
            failure, reason = data["down"]
            self.down = FlightFailed(Failure[failure], reason)
        self._flight = data["flight"]
        self._drawn = {Failure[what]: after for what, after in data["drawn"].items()}
        self._began = data["began"] + shift
        level, since, rate = data["charge"]
        self._charge = Charge(level, since + shift, rate, self.motion.taper)
        start, end, leaves, arrives = data["leg"]
        leaves, arrives = leaves + shift, arrives + shift
        self._legs = [Leg(point_of(start), point_of(end), leaves, arrives, self.motion.smooth)]
        self._lands_at = data["lands_at"] + shift
        self._landed, self._flown = data["landed"], data["flown"]
        self._look_ahead()


class Told:
    """The telemetry of a simulated drone, which is never silent."""

    silence = 0.0

    def __init__(self, body: SimulatedBody) -> None:
        self._body = body

    @property
    def location(self) -> Point:
        """Where it says that it is: it does not keep its height to the centimetre."""
        x, y, z = self._body.place
        return x, y, z + min(1.0, z) * self._body.above

    @property
    def battery_level(self) -> float:
        """The charge of its battery, from 0 to 1."""
        return self._body.battery_level

    @property
    def landed(self) -> bool:
        """Whether it is on the ground."""
        return self._body.landed


def _nothing() -> None:
    """Do nothing: no callback is set."""
