"""One simulated drone, whose position and battery are computed on demand.

There is no tick. A body stores its last change; what was due since is applied, at its exact time, the
next time it is accessed. So a flight costs one event per leg, however long it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import inf
from operator import is_
from random import Random
from typing import TYPE_CHECKING, Any

from ..jobs.reports import DroneReport
from ..shared.alone.faults import Drawn, befell
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.model import Category, Point  # settings are read by these types
from ..shared.domain.motion import CLIMB_SPEED, Spread, varied
from ..shared.fleet.reach import docked
from ..shared.fleet.telemetry import Charge, Leg, resting
from ..shared.hooks.plain_data import item_data, item_of, point_of
from ..shared.time.future import Future
from ..shared.time.kernel import FLEET, Key

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.fleet_data import FleetData
    from ..shared.domain.model import Item


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulatedDrone:
    """A drone to simulate, initially in its dock. Docks are on the ground, at height 0."""

    id: str
    category: Category
    home: Point
    index: int = 0
    """Its index in the fleet file."""
    battery_level: float = 1.0
    """Its initial charge, from 0 to 1."""
    charges_at_home: bool = True


def simulated(app: App, fleet: FleetData) -> list[SimulatedDrone]:
    """Return the drones of a fleet file, to be simulated."""
    categories = {category.name: category for category in app.categories}
    return [
        SimulatedDrone(
            id=one.id,
            category=categories[one.category],
            home=one.home,
            index=index,
            charges_at_home=fleet.charges_at_home,
        )
        for index, one in enumerate(fleet.drones)
    ]


HEIGHTS = 0.025
"""Metres by which heights vary, from leg to leg: their standard deviation, where durations vary, too."""

Due = tuple[float, "Failure | None"]
"""When something happens by itself, and what; None: it touches down."""

_NEVER: Due = inf, None


def _moment(due: Due) -> float:
    return due[0]


class Body:
    """The state of one drone. It is its own telemetry."""

    def __init__(self, drone: SimulatedDrone, clock: Callable[[], float], seed: int = 0) -> None:
        self.drone = drone
        self._clock = clock
        self.model = varied(drone.category.motion, seed)
        self.spread = Spread(seed, drone.id)
        """What the spread of its durations is drawn from."""
        self._heights = Random(f"{seed}/{drone.id}/heights")
        self._above = 0.0
        """How much higher than it should be it says that it is."""
        self.key: Key = FLEET + 1 + drone.index
        self.down: FlightFailed | None = None
        """The failure for which it takes no commands, if any."""
        self.down_since = 0.0
        self.carries: Item | None = None
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
        self.settings: dict[str, float] = {}
        """Parameters that an action of the app's own has set."""
        self.on_change: Callable[[], object] | None = None
        """Called when its state has changed other than by time."""
        self.left_alone = False
        """It was told to land before the process was killed, and touches down by itself."""
        self._drawn, self._began = Drawn(), clock()
        self._charge = Charge(drone.battery_level, clock(), taper=self.model.taper)
        self._leg, self._landed = resting(drone.home, clock()), True
        self._flown = 0.0
        self._due: Due = _NEVER
        self._due_of: tuple[object, ...] = (None,) * 6
        """A cache of the next thing due, with what it was computed from."""
        self.touch_down(clock())

    # Its state

    @property
    def location(self) -> Point:
        """Where it says that it is: it does not keep its height to the centimetre."""
        x, y, z = self.place
        return x, y, z + min(1.0, z) * self._above

    @property
    def place(self) -> Point:
        """Where it is."""
        now = self._clock()
        self.settle(now)
        return self._leg.at(now)

    @property
    def battery_level(self) -> float:
        """The charge of its battery, from 0 to 1."""
        now = self._clock()
        self.settle(now)
        return self._charge.at(now)

    @property
    def landed(self) -> bool:
        """Whether it is on the ground."""
        self.settle(self._clock())
        return self._landed

    @property
    def silence(self) -> float:
        """Always 0: a simulated drone is never silent."""
        return 0.0

    @property
    def motion(self) -> dict[str, object]:
        """Its telemetry as a brain is told it: exact until its state changes other than by time."""
        self.settle(self._clock())
        leg, charge = self._leg, self._charge
        return {
            "leg": (leg.start, leg.end, leg.leaves, leg.arrives),
            "battery": (charge.level, charge.since, charge.rate),
            "landed": self._landed,
        }

    @property
    def is_docked(self) -> bool:
        """Whether it is in its dock."""
        return self.landed and docked(self._leg.end, self.drone.home)

    @property
    def flown(self) -> float:
        """How many metres it has flown, up and down included."""
        now = self._clock()
        self.settle(now)
        return self._flown + self._leg.length(now)

    @property
    def arrives(self) -> float:
        """When it arrives at its destination."""
        return self._leg.arrives

    @property
    def fails_to_act(self) -> bool:
        """Whether the action of this flight fails."""
        return self._drawn.action

    @property
    def report(self) -> DroneReport:
        """Return its report; one that takes no commands does not answer."""
        now = self._clock()
        self.settle(now)
        return DroneReport(
            drone=self.drone.id,
            reached=self.down is None,
            location=self._leg.at(now),
            landed=self._landed,
            battery_level=self._charge.at(now),
            boot=self.boot,
            carrying=None if self.carries is None else self.carries.name,
            done=dict(self.done),
            problems=() if self.down is None else (str(self.down),),
        )

    # Commands

    def begin(self, drawn: Drawn, now: float) -> None:
        """Begin a flight, with its faults, counted from here or from its take-off."""
        self._drawn, self._began = drawn, now

    def lift_off(self, now: float) -> None:
        """Leave the ground: the battery drains from now on, and faults are due."""
        drains = -1.0 / self.drone.category.endurance
        self._charge = self._charge.changing(now + self.model.take_off, drains)
        self._began, self._landed = now, False

    def move(self, target: Point, now: float, leaves: float, arrives: float) -> None:
        """Fly straight to a point, from a time on until another."""
        smooth = self.model.smooth
        if self.model.spread:
            self._above = max(-3.0, min(3.0, self._heights.gauss(0.0, 1.0))) * HEIGHTS
        self._turn(Leg(self._leg.at(now), target, leaves, arrives, smooth), now)

    def halt(self, now: float) -> None:
        """Hover where it is, if it still takes commands."""
        self.settle(now)
        if self.down is None and not self._landed:
            self._turn(resting(self._leg.at(now), now), now)

    def touch_down(self, now: float) -> None:
        """Put it on the ground below: its flight has ended; in its dock it charges from its touch-down on."""
        self._charge = self._grounded(now)
        self._rest(now)
        self._drawn = Drawn()
        self._changed()

    def stand(self, place: Point, level: float, now: float) -> None:
        """Stand there with this charge, before it has flown."""
        self._charge = Charge(level, now, taper=self.model.taper)
        self._leg = resting(place, now)
        self.touch_down(now)

    def _grounded(self, now: float) -> Charge:
        """Return the battery of a drone that is on the ground now, and may have touched down before."""
        touched = min(now, self._leg.arrives) if self._leg.end[2] <= 0.0 else now
        charges = self.drone.charges_at_home and docked(self._leg.at(now), self.drone.home)
        return self._charge.changing(touched, charges / self.drone.category.charge_time)

    def dock(self, now: float) -> None:
        """Put it into its dock, so that it takes commands again."""
        if self.down is not None and self.down.failure is Failure.BATTERY:
            self.reboot()
        self.down = None
        self._turn(resting(self.drone.home, now), now)
        self.touch_down(now)

    def reboot(self) -> None:
        """Restart it: it forgets what it has done."""
        self.boot, self.done, self.settings = self.boot + 1, {}, {}

    def check(self, now: float) -> None:
        """Raise its failure, if it takes no commands."""
        self.settle(now)
        if self.down is not None:
            raise FlightFailed(self.down.failure, str(self.down))

    def unload(self) -> None:
        """Take off what it carries."""
        self.carries = None
        self._changed()

    def befall(self, now: float, what: Failure, why: str | None = None) -> bool:
        """Cause a fault now; return False if it took no commands before."""
        self.settle(now)
        if self.down is not None:
            return False
        self._happen(now, what)
        if why is not None:
            self.down = FlightFailed(what, why)
            self._changed()
        return True

    # What happens by itself

    def settle(self, now: float) -> None:
        """Apply everything that was due by now, each at its own time."""
        if self._landed:
            return
        while (due := self._next())[0] <= now:
            self._happen(*due)

    @property
    def next_mishap(self) -> float:
        """When the next fault is due, if it stays in the air until then."""
        return self._next()[0]

    def _next(self) -> Due:
        """The next thing due, of simultaneous ones the worst."""
        if self._landed:
            return _NEVER
        # each of these is immutable, and replaced on a change
        of = (self._charge, self._drawn, self._began, self._leg, self.down, self.left_alone)
        if not all(map(is_, of, self._due_of)):
            self._due, self._due_of = self._worked_out(), of
        return self._due

    def _worked_out(self) -> Due:
        empty = self._charge.empty_at, Failure.BATTERY
        if self.down is not None or self.left_alone:  # it has lost its link, and lands
            return min((self._leg.arrives, None), empty, key=_moment)
        return min((*self._drawn.moments(self._began), empty), key=_moment)

    def _happen(self, when: float, what: Failure | None) -> None:
        x, y, z = self._leg.at(when)
        if what is None:
            self.touch_down(when)
            return
        self.down, self.down_since = befell(self.drone.id, what, (x, y, z)), when
        self._drawn = Drawn()
        if what is Failure.LINK:
            self.move((x, y, 0.0), when, when, when + z / CLIMB_SPEED)
            return
        if what is Failure.BATTERY:
            self._charge = Charge(0.0, when, taper=self.model.taper)
        else:
            self._charge = self._grounded(when).changing(when, 0.0)
            self.carries = None
        self._rest(when)

    def _rest(self, when: float) -> None:
        x, y, _ = self._leg.at(when)
        self._turn(resting((x, y, 0.0), when), when)
        self._landed = True

    def _turn(self, leg: Leg, now: float) -> None:
        self._flown += self._leg.length(now)
        self._leg, self.left_alone = leg, False
        self._changed()

    def _changed(self) -> None:
        if self.on_change is not None:
            self.on_change()

    # Saving and restoring

    @property
    def data(self) -> dict[str, object]:
        """Everything of it as plain data, but for what it has done; all times are its clock's."""
        leg, charge, drawn, down = self._leg, self._charge, self._drawn, self.down
        return {
            "boot": self.boot,
            "carries": item_data(self.carries),
            "down": None if down is None else [down.failure.name, str(down), self.down_since],
            "drawn": [drawn.crash, drawn.link, drawn.battery, drawn.action],
            "began": self._began,
            "charge": [charge.level, charge.since, charge.rate],
            "leg": [leg.start, leg.end, leg.leaves, leg.arrives],
            "landed": self._landed,
            "flown": self._flown,
        }

    def restore(self, data: Mapping[str, Any], shift: float = 0.0) -> None:
        """Be as it was by a clock that was so much behind.

        What it was told to do, it does to the end, and then it hovers.
        """
        self.boot, self.carries = data["boot"], item_of(data["carries"])
        self.down, self.down_since = None, 0.0
        if data["down"] is not None:
            failure, reason, when = data["down"]
            self.down, self.down_since = FlightFailed(Failure[failure], reason), when + shift
        crash, link, battery, action = data["drawn"]
        self._drawn = Drawn(crash=crash, link=link, battery=battery, action=action)
        self._began = data["began"] + shift
        level, since, rate = data["charge"]
        self._charge = Charge(level, since + shift, rate, self.model.taper)
        start, end, leaves, arrives = data["leg"]
        leaves, arrives = leaves + shift, arrives + shift
        self._leg = Leg(point_of(start), point_of(end), leaves, arrives, self.model.smooth)
        self._landed, self._flown = data["landed"], data["flown"]
        self.left_alone = not self._landed and self._leg.end[2] <= 0
