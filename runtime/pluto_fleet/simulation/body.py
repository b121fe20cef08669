"""One simulated drone: where it is and what is in its battery, worked out when it is asked for.

Nothing ticks. A body keeps its last change; what goes wrong in the meantime is applied, at its
exact moment, the next time it is looked at. So a flight costs one event a leg, however long it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import inf
from operator import is_
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.faults import Drawn, befell
from plutoc_runtime.alone.ideal import Charge, Leg, standing
from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.fleet.reach import CLIMB_SPEED, docked
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET, Key

from ..jobs.reports import DroneReport
from ..journal.values import item_data, item_of, point_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.fleet_data import FleetData
    from plutoc_runtime.domain.model import Category, Item, Point


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulatedDrone:
    """A drone to simulate: it begins in its dock. Docks stand on the ground, at height 0."""

    id: str
    category: Category
    home: Point
    index: int = 0
    """Its place in the fleet file."""
    battery_level: float = 1.0
    """What is in its battery at the start, from 0 to 1."""


def simulated(app: App, fleet: FleetData) -> list[SimulatedDrone]:
    """Return the drones of a fleet file, to be simulated."""
    categories = {category.name: category for category in app.categories}
    return [
        SimulatedDrone(id=one.id, category=categories[one.category], home=one.home, index=index)
        for index, one in enumerate(fleet.drones)
    ]


Due = tuple[float, "Failure | None"]
"""When something comes to pass by itself, and what; None: it touches down."""

_NEVER: Due = inf, None


def _moment(due: Due) -> float:
    return due[0]


class Body:
    """The state of one drone. It is its own telemetry."""

    def __init__(self, drone: SimulatedDrone, clock: Callable[[], float]) -> None:
        self.drone, self._clock = drone, clock
        self.key: Key = FLEET + 1 + drone.index
        self.down: FlightFailed | None = None
        """Why it takes no commands, if it takes none."""
        self.down_since = 0.0
        self.carries: Item | None = None
        self.command = ""
        """What it is doing; one thing at a time."""
        self.over: Future[None] | None = None
        """Happens when that is done, if it takes time; fails if it is broken off."""
        self.cut_short = FlightFailed(Failure.REFUSED, "it was broken off")
        """Why, the last time that this was so."""
        self.boot = 0
        """How often it was switched off and on again."""
        self.done: dict[str, object] = {}
        """What it remembers: the jobs whose action it did, with what that gave."""
        self.settings: dict[str, float] = {}
        """What an action of the app's own has set on it."""
        self.on_change: Callable[[], object] | None = None
        """Told when something of it has changed that time alone does not change."""
        self.left_alone = False
        """It was told to sink before the process was killed: it touches down by itself."""
        self._drawn, self._began = Drawn(), clock()
        self._charge = Charge(drone.battery_level, clock())
        self._leg, self._landed = standing(drone.home, clock()), True
        self._flown = 0.0
        self._due: Due = _NEVER
        self._due_of: tuple[object, ...] = (None,) * 6
        """What comes first, and of what that was worked out: it is asked for all the time."""
        self.touch_down(clock())

    # What anybody may ask at any time

    @property
    def location(self) -> Point:
        """Where it is."""
        now = self._clock()
        self.settle(now)
        return self._leg.at(now)

    @property
    def battery_level(self) -> float:
        """What is left in its battery, from 0 to 1."""
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
        """What is simulated is known at any moment."""
        return 0.0

    @property
    def is_docked(self) -> bool:
        """Whether it stands in its dock."""
        return self.landed and docked(self._leg.end, self.drone.home)

    @property
    def flown(self) -> float:
        """How many metres it has flown, up and down included."""
        now = self._clock()
        self.settle(now)
        return self._flown + self._leg.length(now)

    @property
    def arrives(self) -> float:
        """When it is where it goes."""
        return self._leg.arrives

    @property
    def fails_to_act(self) -> bool:
        """Whether the action of this flight goes wrong."""
        return self._drawn.action

    @property
    def standing(self) -> DroneReport:
        """What it reports when it is asked; one that takes no commands does not answer."""
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

    # What navigation does to it

    def begin(self, drawn: Drawn, now: float) -> None:
        """Begin a flight, with what will go wrong on it: from here, or from its take-off on."""
        self._drawn, self._began = drawn, now

    def lift_off(self, now: float) -> None:
        """Leave the ground: from now on the battery drains, and things go wrong."""
        self._charge = self._charge.changing(now, -1.0 / self.drone.category.flight_time)
        self._began, self._landed = now, False

    def move(self, target: Point, now: float, arrives: float) -> None:
        """Go straight to a point, to be there at a time."""
        self._turn(Leg(self._leg.at(now), target, now, arrives), now)

    def halt(self, now: float) -> None:
        """Hover where it is, unless it is past that."""
        self.settle(now)
        if self.down is None and not self._landed:
            self._turn(standing(self._leg.at(now), now), now)

    def touch_down(self, now: float) -> None:
        """Stand on the ground, below where it is: its flight is over."""
        self._rest(now)
        at_home = docked(self._leg.end, self.drone.home)
        rate = 1.0 / self.drone.category.charge_time if at_home else 0.0
        self._charge = self._charge.changing(now, rate)
        self._drawn = Drawn()
        self._changed()

    def dock(self, now: float) -> None:
        """Stand in its dock, put there by a person, and take commands again."""
        if self.down is not None and self.down.failure is Failure.BATTERY:
            self.reboot()
        self.down = None
        self._turn(standing(self.drone.home, now), now)
        self.touch_down(now)

    def reboot(self) -> None:
        """Switch it off and on again: it forgets what it has done."""
        self.boot, self.done, self.settings = self.boot + 1, {}, {}

    def check(self, now: float) -> None:
        """Raise why it takes no commands, if it takes none."""
        self.settle(now)
        if self.down is not None:
            raise FlightFailed(self.down.failure, str(self.down))

    def unload(self) -> None:
        """Take off what it carries."""
        self.carries = None
        self._changed()

    def befall(self, now: float, what: Failure, why: str | None = None) -> bool:
        """Let something go wrong at this moment; False: it took no commands before."""
        self.settle(now)
        if self.down is not None:
            return False
        self._happen(now, what)
        if why is not None:
            self.down = FlightFailed(what, why)
            self._changed()
        return True

    # What comes to pass by itself

    def settle(self, now: float) -> None:
        """Let everything come to pass that was due by now, each at its own moment."""
        if self._landed:
            return
        while (due := self._next())[0] <= now:
            self._happen(*due)

    @property
    def next_mishap(self) -> float:
        """When something will go wrong, if it stays in the air for so long."""
        return self._next()[0]

    def _next(self) -> Due:
        """What comes first, and of equals the worst."""
        if self._landed:
            return _NEVER
        # each of these is replaced when it changes, and never changes in itself
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
            self.move((x, y, 0.0), when, when + z / CLIMB_SPEED)
            return
        self._rest(when)
        if what is Failure.BATTERY:
            self._charge = Charge(0.0, when)
        else:
            self._charge = self._charge.changing(when, 0.0)
            self.carries = None

    def _rest(self, when: float) -> None:
        x, y, _ = self._leg.at(when)
        self._turn(standing((x, y, 0.0), when), when)
        self._landed = True

    def _turn(self, leg: Leg, now: float) -> None:
        self._flown += self._leg.length(now)
        self._leg, self.left_alone = leg, False
        self._changed()

    def _changed(self) -> None:
        if self.on_change is not None:
            self.on_change()

    # What outlives the simulation

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
        self._charge = Charge(level, since + shift, rate)
        start, end, leaves, arrives = data["leg"]
        self._leg = Leg(point_of(start), point_of(end), leaves + shift, arrives + shift)
        self._landed, self._flown = data["landed"], data["flown"]
        self.left_alone = not self._landed and self._leg.end[2] <= 0
