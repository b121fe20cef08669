"""Simulated drones: the one body that each has, and a fleet in which each has the air to itself.

There is no tick: what was due is applied, at its own time, the next time a drone is looked at. What is
left to chance is drawn by `seed/flight/leg`, so it depends on no other flight and on no process.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING, Any

from ..domain.actions import BUILT_IN, MEASURE, PHOTO, PICK, USUAL_QUANTITY
from ..domain.airspace import permitted_way
from ..domain.errors import Failure, FlightFailed
from ..domain.motion import varied, varies
from ..domain.text import place
from ..fleet.reach import docked, flight_seconds, grip_problem
from ..fleet.telemetry import MOMENT, Charge, KnownState, Leg, place_on, resting
from ..hooks.plain_data import item_of, point_of, value_data
from .world import BEFALL, CARRYING_HOME, OUTAGE, Faults, World, draw

if TYPE_CHECKING:
    from ..domain.actions import Plain
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Category, Item, Point
    from ..domain.trace import Clock


COASTS = 0.5
"""Seconds for which a drone that is told to hover on its way still has the speed to go on with."""


class Body(KnownState):
    """One drone, initially in its dock. The caller waits, until when it says."""

    def __init__(
        self, id: str, home: Point, category: Category, world: World, clock: Clock
    ) -> None:
        super().__init__(clock, home, varied(category.motion, world.seed))
        self.id = id
        self.home = home
        self.category = category
        self.world = world
        self.down: FlightFailed | None = None  # why it takes no commands, if it takes none
        self.reachable_at = 0.0  # when its link is back, if it has lost it
        self.carries: Item | None = None
        self.settings = dict[str, float]()  # what an action of the app's own has written
        self.due = inf  # when the next thing happens by itself
        self._what: Failure | None = None  # that thing; None: it has landed
        self._flight = f"{world.seed}/{id}"  # what chance is drawn by, with where a leg ends
        self._drawn: Mapping[Failure, float] = {}
        self._began = 0.0
        self._flown = 0.0
        self._cut = (-inf, (0.0, 0.0, 0.0))
        """When it was told to hover on its way, the last time, and how fast it was."""
        self.stand(home, 1.0)

    def stand(self, at: Point, level: float) -> None:
        """Stand there with this charge, before it has flown."""
        self._legs = [resting(at, self._clock.now)]
        self._charge = Charge(level, self._clock.now, taper=self.motion.taper)
        self.touch_down(self._clock.now)

    def flown(self, now: float) -> float:
        """Return how many metres it has flown at a time, up and down included."""
        return sum((leg.length(now) for leg in self._legs), self._flown)

    def news(self) -> dict[str, object]:
        """Return its telemetry: exact until it flies or charges otherwise."""
        self.settle()
        self.changed = False
        legs = [(leg.start, leg.end, leg.leaves, leg.arrives) for leg in self._legs]
        battery = (self._charge.level, self._charge.since, self._charge.rate)
        return {"legs": legs, "battery": battery, "landed": self._landed}

    def check(self) -> None:
        """Raise its failure, if it takes no commands."""
        self.settle()
        if self.down is not None:
            raise FlightFailed(self.down.failure, str(self.down))

    def begin(self, flight: str | None, drawn: Mapping[Failure, float] | None = None) -> None:
        """Begin a flight with its faults; None: the way home of its last one."""
        self.check()
        home = self._flight.removesuffix("/home") + "/home"
        self._flight = f"{self.world.seed}/{flight}" if flight else home
        self._drawn = drawn or {}
        self._began = self._clock.now
        self._look_ahead()

    def follow(self, way: Sequence[Point], *, lands: bool = False) -> float:
        """Set out from where it hovers, or above where it stands; return when it is at rest at the end."""
        self.check()
        now = self._clock.now
        motion = self.motion
        velocity = self._velocity(now)
        rises = self._landed
        if rises:  # the battery drains from now on, and faults are due
            self._charge = self._charge.changing(
                now + motion.take_off, -1 / self.category.endurance
            )
            self._landed = False
            self._began = now
            self._look_ahead()
            self.check()  # a fault at take-off leaves it on the ground
        legs = list[Leg]()
        here = self.location
        speed = self.category.speed
        for there, before, seconds, after in motion.stages(way, speed, rises, lands):
            x, y, z = there
            factor = varies(motion.spread, f"{self._flight}/{x:.2f}/{y:.2f}/{z:.2f}")
            leaves = now + factor * before
            goes_on = False
            if velocity is not None and there[:2] != here[:2]:
                seconds = motion.sent_on(velocity, here, there, speed)
                after = motion.stops(speed)
                goes_on = True
                velocity = None  # it rests at the end of this leg
            smooth = motion.smooth and not goes_on
            legs.append(Leg(here, there, leaves, leaves + factor * seconds, smooth))
            here = there
            now += factor * (before + seconds + after)
        self.turn(legs, self._clock.now, lands_at=now if lands else inf)
        return now

    def halt(self) -> None:
        """Hover where it is, if it still takes commands."""
        self.settle()
        if not self._landed and self.down is None:
            now = self._clock.now
            velocity = self._velocity(now)
            if velocity is not None:
                self._cut = now, velocity
            self.turn([resting(self.location, now)], now)

    def _velocity(self, now: float) -> Point | None:
        """Return how fast it is on its way, or was until just now; None: it starts from rest."""
        if self._landed:
            return None
        for leg in self._legs:
            if leg.leaves < now < leg.arrives - MOMENT and leg.start != leg.end:
                return leg.velocity(now)
        since, velocity = self._cut
        return velocity if now - since <= COASTS else None

    def touch_down(self, now: float) -> None:
        """Put it on the ground below; in its dock it is charged from its touch-down on."""
        last = self._legs[-1]
        below = (*place_on(self._legs, now)[:2], 0.0)
        touched = min(now, last.arrives) if last.end[2] <= 0.0 else now
        rate = docked(below, self.home) / self.category.charge_time
        self._charge = self._charge.changing(touched, rate)
        self._landed = True
        self._drawn = {}
        self.turn([resting(below, now)], now)

    def turn(self, legs: list[Leg], now: float, *, lands_at: float = inf) -> None:
        """Fly other legs from now on; it has landed at that time."""
        self._flown = self.flown(now)
        self._legs = legs
        self._lands_at = lands_at
        self.changed = True
        self._look_ahead()

    def settle(self) -> None:
        """Apply everything that was due by now, each at its own time."""
        while self.due <= self._clock.now:
            self._happen(self.due, self._what)

    def _look_ahead(self) -> None:
        """Work out what happens next by itself, of simultaneous things the worst."""
        self.due = inf
        if not self._landed:
            comes: list[tuple[float, Failure | None]]
            comes = [(self._began + after, what) for what, after in self._drawn.items()]
            comes += (self._charge.empty_at, Failure.BATTERY), (self._lands_at, None)
            self.due, self._what = min(comes, key=lambda one: one[0])

    def _happen(self, when: float, what: Failure | None) -> None:
        x, y, z = here = place_on(self._legs, when)
        if what is not None:
            self.down = FlightFailed(what, f"{self.id} {BEFALL[what]} at {place(here)}")
        if what is Failure.LINK:
            down = Leg(here, (x, y, 0.0), when, when + z / self.motion.down, self.motion.smooth)
            self.reachable_at = max(when + OUTAGE, down.arrives)
            self._drawn = {}
            self.turn([down], when, lands_at=down.arrives)
            return
        self.touch_down(when)
        if what is Failure.BATTERY:
            self._charge = Charge(0.0, when, taper=self.motion.taper)
        elif what is Failure.CRASH:
            self._charge = self._charge.changing(when, 0.0)
            self.carries = None

    def answers(self) -> bool:
        """Return whether it can be reached, once its link is back; False: it has crashed."""
        self.settle()
        if self.down is not None and self.down.failure is Failure.LINK:
            self.down = None
        return self.down is None or self.down.failure is not Failure.CRASH

    def dock(self) -> None:
        """Stand in its dock, where someone has carried it, and take commands again."""
        self.down = None
        self.settings = {}
        self.turn([resting(self.home, self._clock.now)], self._clock.now)
        self.touch_down(self._clock.now)

    def begin_action(self, action: str, item: Item | None) -> float:
        """Return when a built-in action is done that begins now; raise why it cannot be."""
        if why := grip_problem(self.id, self.category, self.carries, action, item):
            raise self._not_done(action, why)
        factor = varies(self.motion.action_spread, f"{self._flight}/{action}")
        return self._clock.now + BUILT_IN[action].seconds * factor

    def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        """Do it; return what was measured or photographed."""
        self.can_act(action)
        if action == MEASURE:
            quantity = str(parameters.get("quantity", USUAL_QUANTITY))
            return self.world.measure(quantity, self.location, self._clock.now)
        if action == PHOTO:
            return self.world.photo(self.location, self._clock.now)
        self.carries = item if action == PICK else None
        return None

    def can_act(self, action: str) -> None:
        """Raise the fault of its action, if that fails on this flight."""
        if Failure.ACTION in self._drawn:
            raise self._not_done(action, f"{self.id} could not do it")

    def _not_done(self, action: str, why: str) -> FlightFailed:
        return FlightFailed(Failure.ACTION, f"{action} failed: {why} at {place(self.location)}")

    def read(self, name: str) -> float:
        """Return the value that was written under a name, or else what is measured here."""
        measured = self.world.measure(name, self.location, self._clock.now)
        return self.settings.get(name, measured)


Work = Generator[float, None, Any]  # it yields until when it waits, and returns the result


class IdealDrones:
    """Obeys a brain with ideal drones; a fleet of one flies exactly as it does with traffic."""

    new_world: type[World] = World
    at_once: tuple[str, ...] = ("read", "write")
    """What a drone does at once, be it on its way or not."""

    def __init__(self, app: App, fleet: FleetData, faults: Faults, seed: int, clock: Clock) -> None:
        self._clock = clock
        self._airspace = fleet.airspace
        self._faults = faults
        self.told: list[dict[str, Any]] = []
        self.world = world = self.new_world(seed, fleet.airspace, fleet.world)
        kinds = {category.name: category for category in app.categories}
        self.drones = {
            one.id: Body(one.id, one.home, kinds[one.category], world, clock)
            for one in fleet.drones
        }
        self.works: dict[str, tuple[int, Work]] = {}  # the order of each drone, carried out
        self.wakes = dict.fromkeys(self.drones, inf)  # until when that waits
        self.ways = {
            "fly": self._fly,
            "hold": self._hold,
            "home": self._home,
            "land": self._land,
            "recover": self._recover,
        }

    @property
    def due(self) -> float:
        """When something happens next; infinite: only an order can make it happen."""
        return self._clock.now if self.told else min(self.wakes.values())

    def advance(self) -> dict[str, Any]:
        """Let the next thing happen that is due, and return what there is to tell of it."""
        if not self.told:
            drone = min(self.wakes, key=self.wakes.__getitem__)
            self.wakes[drone] = self._go_on(*self.works[drone])
        return self.told.pop(0) if self.told else {}

    def news(self) -> dict[str, Any]:
        """Return the telemetry of the drones whose motion has changed since the last call."""
        now = self._clock.now
        return {id: one.news() for id, one in self.drones.items() if one.changed or one.due <= now}

    def obey(self, order: Mapping[str, Any]) -> None:
        """Begin what is ordered."""
        id = order["drone"]
        do = order["do"]
        drone = self.drones[id]
        if do == "break_off" or (do == "cancel" and self.works[id][0] == order["order"]):
            self.wakes[id] = inf
            drone.halt()
        elif do in self.at_once:
            self._go_on(order["id"], self.asked(drone, order))
        elif do in self.ways:  # after all that is ordered with it
            self.works[id] = (order["id"], self.ways[do](drone, order))
            self.wakes[id] = self._clock.now

    def _go_on(self, order: int, work: Work) -> float:
        """Go on with an order until it waits, and return until when; tell its end."""
        try:
            while (until := next(work)) <= self._clock.now:
                pass  # it need not wait
            return until
        except StopIteration as end:
            self.told.append({"done": order, "value": end.value})
        except FlightFailed as error:
            self.told.append({"failed": order, "failure": error.failure.name, "reason": str(error)})
        return inf

    def _fly(self, drone: Body, order: Mapping[str, Any]) -> Work:
        flight = order["flight"]
        way = self.way(drone, order)
        drawn = None
        if self._faults != Faults():
            start = drone.location
            stops = [*map(point_of, order["stops"])]
            seconds = flight_seconds(drone.category, self._airspace, start, stops, order["seconds"])
            drawn = draw(self._faults, drone.world.seed, flight, seconds)
        drone.begin(flight, drawn)
        return (yield from self.through(way, drone, order))

    def way(self, drone: Body, order: Mapping[str, Any]) -> list[Point]:
        stops = [*map(point_of, order["stops"])]
        for problem in filter(None, map(self._airspace.problem, stops)):
            raise FlightFailed(Failure.REFUSED, problem)
        way = [self._above(drone)]
        for stop in stops:
            way += permitted_way(self._airspace, drone.id, way[-1], stop)
        return way

    def through(self, way: list[Point], drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly a way, and do the action of its flight at the end."""
        yield from self.until(drone, drone.follow(way))
        self.arrived(order)
        action = order["action"]
        item = item_of(order["item"])
        if action is None:
            return None
        yield from self.until(drone, drone.begin_action(action, item))
        return value_data(drone.act(action, order["parameters"], item))

    def _hold(self, drone: Body, _: object) -> Work:
        """Hover until a fault occurs or it is cancelled."""
        drone.check()
        drone.can_act("the action")
        yield from self.until(drone, inf)

    def asked(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Do what takes no time."""
        yield from ()  # it answers at once
        drone.check()
        if order["do"] == "read":
            return drone.read(order["name"])
        drone.settings[order["name"]] = order["value"]
        return None

    def arrived(self, order: Mapping[str, Any]) -> None:
        """Called at the end of the last leg of a flight."""

    def _home(self, drone: Body, _: object) -> Work:
        """Take off, if it stands, fly to its dock, and land."""
        drone.begin(None)
        start = self._above(drone)
        way = permitted_way(self._airspace, drone.id, start, (*drone.home[:2], start[2]))
        yield from self.until(drone, drone.follow([start, *way], lands=True))

    def _land(self, drone: Body, _: object) -> Work:
        """Land here; does nothing for a drone that stands on the ground."""
        drone.check()
        if not drone.landed:
            yield from self.until(drone, drone.follow([drone.location], lands=True))

    def _recover(self, drone: Body, _: object) -> Work:
        """Bring a drone home after a failed flight, landed; False: it has crashed, and is lost."""
        drone.settle()
        yield drone.reachable_at
        if not drone.answers():
            return False
        try:
            drone.begin(None)
            if not (drone.landed and docked(drone.location, drone.home)):
                yield from self._home(drone, None)
        except FlightFailed:
            yield self._clock.now + CARRYING_HOME
            drone.dock()
        drone.carries = None
        return True

    def _above(self, drone: Body) -> Point:
        x, y, z = drone.location
        return x, y, self._airspace.cruise_height if drone.landed else z

    def until(self, drone: Body, when: float) -> Work:
        """Wait until a time; raise what keeps it from waiting so long."""
        yield min(when, drone.due)
        drone.check()
