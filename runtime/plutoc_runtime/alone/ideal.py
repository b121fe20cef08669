"""Ideal drones: each has the air to itself, so several may pass through each other.

There is no tick: what was due is applied, at its own time, the next time a drone is looked at.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from math import inf
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Any

from ..domain.actions import BUILT_IN, PICK, RELEASE
from ..domain.airspace import permitted_way
from ..domain.errors import Failure, FlightFailed
from ..domain.motion import CLIMB_SPEED, Spread, varied
from ..fleet.reach import docked, flight_seconds, grip_problem
from ..fleet.telemetry import Charge, KnownState, Leg, place_on, resting
from ..hooks.plain_data import item_of, point_of, value_data
from .faults import CARRYING_HOME, OUTAGE, Drawn, Faults, befell, draw, failed
from .world import World

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import DroneData, FleetData
    from ..domain.model import Category, Item, Point
    from ..domain.trace import Clock

_wakes, _when = attrgetter("wakes"), itemgetter(0)

Work = Generator[float, None, Any]  # it yields until when it waits, and returns the result


class IdealDrone(KnownState):
    """The state of one drone, initially in its dock."""

    def __init__(self, entry: DroneData, category: Category, clock: Clock, seed: int) -> None:
        super().__init__(clock, entry.home, varied(category.motion, seed))
        self.id, self.home, self.category = entry.id, entry.home, category
        self.spread, self.settings, self.drawn = Spread(seed, entry.id), dict[str, float](), Drawn()
        self.down: FlightFailed | None = None  # why it takes no commands, if it takes none
        self._began = self._flown = self.reachable_at = 0.0  # the last: where its link is lost
        self.carries: Item | None = None
        self.work: Work
        self.order, self.wakes = 0, inf  # what `work` carries out, and until when it waits
        self.due = inf  # when the next thing happens by itself
        self._what: Failure | None = None  # that thing; None is a touch-down
        self.stand(entry.home, 1.0)

    def stand(self, place: Point, level: float) -> None:
        """Stand there with this charge, before it has flown."""
        self._legs = [resting(place, now := self._clock.now)]
        self._charge = Charge(level, now, taper=self.motion.taper)
        self.touch_down(now)

    def flown(self, now: float) -> float:
        """Return how many metres it has flown at a time, up and down included."""
        return sum((leg.length(now) for leg in self._legs), self._flown)

    def news(self) -> dict[str, object]:
        """Return its telemetry: exact until it flies or charges otherwise."""
        self.changed, of = False, self._charge
        legs = [(leg.start, leg.end, leg.leaves, leg.arrives) for leg in self._legs]
        return {"legs": legs, "battery": (of.level, of.since, of.rate), "landed": self.landed}

    def settle(self) -> None:
        """Apply everything that was due by now."""
        while self.due <= self._clock.now:
            self._happen(self.due, self._what)

    def failure(self) -> Failure | None:
        """Return the failure for which it takes no commands now, if any."""
        self.settle()
        return None if self.down is None else self.down.failure

    def check(self) -> None:
        """Raise its failure, if it takes no commands."""
        if failure := self.failure():
            raise FlightFailed(failure, str(self.down))

    def begin(self, drawn: Drawn) -> None:
        """Begin a flight, with its faults."""
        self.check()
        self.drawn, self._began = drawn, self._clock.now
        self._look_ahead()

    def lift_off(self) -> None:
        """Leave the ground: the battery drains from now on, and faults are due."""
        leaves, drains = self._clock.now + self.motion.take_off, -1.0 / self.category.endurance
        self._charge = self._charge.changing(leaves, drains)
        self._landed = False
        self._look_ahead()

    def turn(self, legs: list[Leg], now: float) -> None:
        """Fly other legs from now on."""
        self._flown = self.flown(now)
        self._legs, self.changed = legs, True
        self._look_ahead()

    def halt(self) -> None:
        """Do nothing more, and hover where it is, if it still takes commands."""
        self.wakes = inf
        if self.failure() is None and not self.landed:
            self.spread.put_back(now := self._clock.now)
            self.turn([resting(self.location, now)], now)

    def touch_down(self, now: float) -> None:
        """Put it on the ground below; in its dock it is charged from its touch-down on."""
        last, place = self._legs[-1], (*place_on(self._legs, now)[:2], 0.0)
        touched = min(now, last.arrives) if last.end[2] <= 0.0 else now
        rate = docked(place, self.home) / self.category.charge_time
        self._charge = self._charge.changing(touched, rate)
        self._landed = True
        self.turn([resting(place, now)], now)

    def _look_ahead(self) -> None:
        """Work out what happens next by itself, of simultaneous things the worst."""
        self.due = inf
        if not self.landed:
            comes = self.drawn.moments(self._began)
            if self.down is not None:  # it has lost its link, and lands
                comes = [(self._legs[-1].arrives, None)]
            comes.append((self._charge.empty_at, Failure.BATTERY))
            self.due, self._what = min(comes, key=_when)

    def _happen(self, when: float, what: Failure | None) -> None:
        x, y, z = here = place_on(self._legs, when)
        self.spread.put_back(when)
        if what is not None:
            self.down = befell(self.id, what, here)
        if what is Failure.LINK:
            down = Leg(here, (x, y, 0.0), when, when + z / CLIMB_SPEED, self.motion.smooth)
            self.reachable_at = max(when + OUTAGE, down.arrives)
            self.turn([down], when)
            return
        self.touch_down(when)
        if what is Failure.BATTERY:
            self._charge = Charge(0.0, when, taper=self.motion.taper)
        elif what is Failure.CRASH:
            self._charge, self.carries = self._charge.changing(when, 0.0), None


class IdealDrones:
    """Obeys a brain with ideal drones; a fleet of one flies exactly as it does with traffic."""

    def __init__(self, app: App, fleet: FleetData, faults: Faults, seed: int, clock: Clock) -> None:
        self._clock, self._airspace, self._chance = clock, fleet.airspace, (faults, seed)
        self._world = World(seed, fleet.airspace, fleet.world)
        self._told: list[dict[str, Any]] = []
        categories = {category.name: category for category in app.categories}
        self._all = [IdealDrone(one, categories[one.category], clock, seed) for one in fleet.drones]
        self.drones = {drone.id: drone for drone in self._all}

    @property
    def due(self) -> float:
        """When something happens next; infinite: only an order can make it happen."""
        return self._clock.now if self._told else min(map(_wakes, self._all))

    def advance(self) -> dict[str, Any]:
        """Let the next thing happen that is due, and return what there is to tell of it."""
        if not self._told:
            drone = min(self._all, key=_wakes)
            drone.settle()
            drone.wakes = self._go_on(drone.order, drone.work)
        return self._told.pop(0) if self._told else {}

    def news(self) -> dict[str, Any]:
        """Return the telemetry of the drones whose motion has changed since the last call."""
        for drone in self._all:
            if drone.due <= self._clock.now:
                drone.settle()  # it may have touched down by itself
        return {drone.id: drone.news() for drone in self._all if drone.changed}

    def obey(self, order: Mapping[str, Any]) -> None:
        """Begin what is ordered."""
        drone, do = self.drones[order["drone"]], order["do"]
        if do == "break_off" or (do == "cancel" and drone.order == order["order"]):
            drone.halt()
        elif do in ("read", "write"):  # while it hovers
            self._go_on(order["id"], self._asked(drone, order))
        elif do != "cancel":
            # by _fly, _hold, _home, _land or _recover, after all that is ordered with it
            drone.order, drone.work = order["id"], getattr(self, f"_{do}")(drone, order)
            drone.wakes = self._clock.now

    def _go_on(self, order: int, work: Work) -> float:
        """Go on with an order until it waits, and return until when; tell its end."""
        try:
            while (until := next(work)) <= self._clock.now:
                pass  # it need not wait
            return until
        except StopIteration as end:
            self._told.append({"done": order, "value": end.value})
        except FlightFailed as error:
            self._told.append(
                {"failed": order, "failure": error.failure.name, "reason": str(error)}
            )
        return inf

    def _fly(self, drone: IdealDrone, order: Mapping[str, Any]) -> Work:
        airspace, start, stops = self._airspace, drone.location, [*map(point_of, order["stops"])]
        for problem in filter(None, map(airspace.problem, stops)):
            raise FlightFailed(Failure.REFUSED, problem)
        way = [self._above(drone)]
        for stop in stops:
            way += permitted_way(airspace, drone.id, way[-1], stop)
        faulty, kind = self._chance[0] != Faults(), drone.category
        seconds = faulty and flight_seconds(kind, airspace, start, stops, order["seconds"])
        drone.begin(draw(*self._chance, order["flight"], seconds))
        yield from self._follow(drone, way)
        action, item = order["action"], item_of(order["item"])
        if action is None:
            return None
        if why := grip_problem(drone.id, drone.category, drone.carries, action, item):
            raise failed(f"{action} failed", why, drone.location)
        factor = drone.spread.factor(drone.motion.action_spread)
        yield from self._until(drone, self._clock.now + BUILT_IN[action].seconds * factor)
        if drone.drawn.action:
            raise failed(f"{action} failed", f"{drone.id} could not do it", drone.location)
        if action in (PICK, RELEASE):
            drone.carries = item if action == PICK else None
        now = self._clock.now
        return value_data(self._world.gives(action, order["parameters"], drone.location, now))

    def _hold(self, drone: IdealDrone, _: object) -> Work:
        """Hover until a fault occurs or it is cancelled."""
        drone.check()
        if drone.drawn.action:
            raise failed("the action failed", f"{drone.id} could not do it", drone.location)
        yield from self._until(drone, inf)

    def _asked(self, drone: IdealDrone, order: Mapping[str, Any]) -> Work:
        """Return the value that was written under a name, or else what is measured here."""
        yield from ()  # it answers at once
        drone.check()
        if order["do"] == "write":
            drone.settings[order["name"]] = order["value"]
            return None
        measured = self._world.measure(order["name"], drone.location, self._clock.now)
        return drone.settings.get(order["name"], measured)

    def _home(self, drone: IdealDrone, _: object) -> Work:
        """Take off, if it stands, fly to its dock, and land."""
        drone.begin(Drawn())
        start = self._above(drone)
        way = permitted_way(self._airspace, drone.id, start, (*drone.home[:2], start[2]))
        yield from self._follow(drone, [start, *way], lands=True)

    def _land(self, drone: IdealDrone, _: object) -> Work:
        """Land here; does nothing for a drone that stands on the ground."""
        drone.check()
        if not drone.landed:
            yield from self._follow(drone, [drone.location], lands=True)

    def _recover(self, drone: IdealDrone, _: object) -> Work:
        """Bring a drone home after a failed flight, landed; False: it has crashed, and is lost."""
        if drone.failure() is Failure.LINK:
            yield drone.reachable_at
        if drone.failure() is Failure.CRASH:
            return False
        if drone.failure() is Failure.LINK:
            drone.down = None  # the link is back
        try:
            drone.begin(Drawn())
            if not (drone.landed and docked(drone.location, drone.home)):
                yield from self._home(drone, None)
        except FlightFailed:  # someone carries it into its dock, and restarts it
            yield self._clock.now + CARRYING_HOME
            drone.down, drone.settings = None, {}
            drone.turn([resting(drone.home, self._clock.now)], self._clock.now)
            drone.touch_down(self._clock.now)
        drone.carries = None
        return True

    def _above(self, drone: IdealDrone) -> Point:
        x, y, z = drone.location
        return x, y, self._airspace.cruise_height if drone.landed else z

    def _follow(self, drone: IdealDrone, way: Sequence[Point], *, lands: bool = False) -> Work:
        """Fly a route whose first point is above the drone's place on the ground, or where it hovers."""
        drone.check()
        motion, rises, here, now = drone.motion, drone.landed, drone.location, self._clock.now
        if rises:
            drone.lift_off()
            drone.check()  # a fault at take-off leaves it on the ground
        drone.spread.put_back(now)
        legs = list[Leg]()
        for place, before, seconds, after in motion.stages(way, drone.category.speed, rises, lands):
            factor = drone.spread.factor(motion.spread, begins=now)
            leaves = now + factor * before
            legs.append(Leg(here, place, leaves, leaves + factor * seconds, motion.smooth))
            here, now = place, now + factor * (before + seconds + after)
        drone.turn(legs, self._clock.now)
        yield from self._until(drone, now)
        if lands:
            drone.touch_down(self._clock.now)

    def _until(self, drone: IdealDrone, when: float) -> Work:
        """Wait until a time; raise what keeps it from waiting so long."""
        yield min(when, drone.due)
        drone.check()
