"""Ideal drones: each has the air to itself, so several may pass through each other.

There is no tick: what was due is applied, at its own time, the next time a drone is looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import dist, inf
from typing import TYPE_CHECKING

from ..domain.actions import BUILT_IN, PICK, RELEASE
from ..domain.airspace import way_from
from ..domain.errors import Failure, FlightFailed
from ..fleet.reach import CLIMB_SPEED, docked, flight_seconds, grip_problem
from ..time.future import Future
from ..time.kernel import FLEET, EventKind, Kernel, Key, Task
from .faults import CARRYING_HOME, OUTAGE, Drawn, Faults, Order, befell, draw, failed
from .world import World

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import DroneData, FleetData
    from ..domain.model import Category, Item, Point
    from ..trips.flight import Flight


@dataclass(frozen=True, slots=True)
class Leg:
    """A straight leg between two points, with the times at its ends."""

    start: Point
    end: Point
    leaves: float
    arrives: float

    def at(self, now: float) -> Point:
        """Return the position at a time; before and after the leg, nothing moves.

        A leg of no duration may be asked for a moment before it: sums of floats are not exact.
        """
        if now >= self.arrives or self.arrives <= self.leaves:
            return self.end
        if now <= self.leaves:
            return self.start
        part = (now - self.leaves) / (self.arrives - self.leaves)
        (ax, ay, az), (bx, by, bz) = self.start, self.end
        return ax + part * (bx - ax), ay + part * (by - ay), az + part * (bz - az)

    def length(self, now: float) -> float:
        """Return the metres flown at a time."""
        return dist(self.start, self.at(now))


def resting(place: Point, now: float) -> Leg:
    """Return a leg that stays in one place."""
    return Leg(place, place, now, now)


@dataclass(frozen=True, slots=True)
class Charge:
    """A battery: its level at a time, from 0 to 1, and its change per second."""

    level: float
    since: float
    rate: float = 0.0

    def at(self, now: float) -> float:
        """Return the level at a time."""
        if not self.rate or now <= self.since:
            return self.level
        level = self.level + self.rate * (now - self.since)
        return min(1.0, level) if level > 0.0 else 0.0

    @property
    def empty_at(self) -> float:
        """When it will be empty; infinite: never."""
        return self.since - self.level / self.rate if self.rate < 0 else inf

    def changing(self, now: float, rate: float) -> Charge:
        """Return the battery with another rate from now on."""
        return Charge(self.at(now), now, rate)


class IdealDrone:
    """The state of one drone, initially in its dock. It is its own telemetry."""

    silence = 0.0

    def __init__(self, entry: DroneData, category: Category, key: Key, kernel: Kernel) -> None:
        self.id, self.home, self.category, self.key = entry.id, entry.home, category, key
        self._kernel = kernel
        self.down: FlightFailed | None = None
        """The failure for which it takes no commands, if any."""
        self.reachable_at = 0.0  # where its link is lost: not before it has landed
        self.carries: Item | None = None
        self.settings: dict[str, float] = {}
        self.drawn = Drawn()
        self.over: Future[None] | None = None
        """Set when its command is done; fails if the command is aborted."""
        self.job: Task[None] | None = None
        self._began = self._flown = 0.0
        self._charge, self._leg = Charge(1.0, kernel.now), resting(entry.home, kernel.now)
        self.touch_down(kernel.now)

    @property
    def location(self) -> Point:
        """Where it is."""
        return self._leg.at(self.settle())

    @property
    def battery_level(self) -> float:
        """The charge of its battery, from 0 to 1."""
        return self._charge.at(self.settle())

    @property
    def landed(self) -> bool:
        """Whether it is on the ground."""
        self.settle()
        return self._landed

    @property
    def flown(self) -> float:
        """How many metres it has flown, up and down included."""
        return self._flown + self._leg.length(self.settle())

    @property
    def failure(self) -> Failure | None:
        """The failure for which it takes no commands, if any."""
        self.settle()
        return None if self.down is None else self.down.failure

    def settle(self) -> float:
        """Apply everything that was due by now, and return the time."""
        now = self._kernel.now
        while (due := self.next_due)[0] <= now:
            self._happen(*due)
        return now

    def check(self) -> None:
        """Raise its failure, if it takes no commands."""
        if self.failure is not None:
            raise FlightFailed(self.failure, str(self.down))

    def begin(self, drawn: Drawn) -> None:
        """Begin a flight, with its faults."""
        self.check()
        self.drawn, self._began = drawn, self._kernel.now

    def lift_off(self) -> None:
        """Leave the ground: the battery drains from now on, and faults are due."""
        self._charge = self._charge.changing(self._kernel.now, -1.0 / self.category.flight_time)
        self._landed = False

    def turn(self, leg: Leg, now: float) -> None:
        """Fly another leg from now on."""
        self._flown += self._leg.length(now)
        self._leg = leg

    def halt(self) -> None:
        """Hover where it is, if it still takes commands."""
        now = self.settle()
        if self.down is None and not self._landed:
            self.turn(resting(self._leg.at(now), now), now)

    def touch_down(self, now: float) -> None:
        """Put it on the ground below; in its dock it is charged."""
        self.turn(resting((*self._leg.at(now)[:2], 0.0), now), now)
        self._landed = True
        charges = docked(self._leg.end, self.home)
        self._charge = self._charge.changing(now, charges / self.category.charge_time)

    def dock(self) -> None:
        """Put it into its dock, restarted, so that it takes commands again."""
        self.down, self.settings, now = None, {}, self._kernel.now
        self.turn(resting(self.home, now), now)
        self.touch_down(now)

    @property
    def next_due(self) -> tuple[float, Failure | None]:
        """The next thing that happens by itself, of simultaneous ones the worst; None: it touches down."""
        if self._landed:
            return inf, None
        comes = self.drawn.moments(self._began)
        if self.down is not None:  # it has lost its link, and lands
            comes = [(self._leg.arrives, None)]
        return min([*comes, (self._charge.empty_at, Failure.BATTERY)], key=lambda due: due[0])

    def _happen(self, when: float, what: Failure | None) -> None:
        x, y, z = self._leg.at(when)
        if what is not None:
            self.down = befell(self.id, what, (x, y, z))
        if what is Failure.LINK:
            self.turn(Leg((x, y, z), (x, y, 0.0), when, when + z / CLIMB_SPEED), when)
            self.reachable_at = max(when + OUTAGE, self._leg.arrives)
            return
        self.touch_down(when)
        if what is Failure.BATTERY:
            self._charge = Charge(0.0, when)
        elif what is Failure.CRASH:
            self._charge, self.carries = self._charge.changing(when, 0.0), None


class IdealNavigation:
    """The `Navigation` of ideal drones; a fleet of one flies exactly as it does with traffic."""

    def __init__(
        self, kernel: Kernel, app: App, fleet: FleetData, faults: Faults, seed: int
    ) -> None:
        self._kernel, self._airspace, self._chance = kernel, fleet.airspace, (faults, seed)
        self._world = World(seed, fleet.airspace, fleet.world)
        categories = {category.name: category for category in app.categories}
        self.drones = {
            one.id: IdealDrone(one, categories[one.category], FLEET + 1 + index, kernel)
            for index, one in enumerate(fleet.drones)
        }

    def telemetry(self, drone: str) -> IdealDrone:
        """Return a drone's telemetry, which is always current."""
        return self.drones[drone]

    def fly(self, job: Flight, report: Callable[[object], None]) -> None:
        """Take off, fly to the job's stops and do its action; then report."""
        drone = self.drones[job.drone]

        async def fly() -> None:
            try:
                result = await self._flown(drone, job)
            except FlightFailed as error:
                result = error
            report(result)

        drone.job = self._kernel.spawn(fly(), drone.key, f"{drone.id} flies {job.id}")

    async def _flown(self, drone: IdealDrone, job: Flight) -> object:
        airspace, start = self._airspace, drone.location
        for problem in filter(None, map(airspace.problem, job.stops)):
            raise FlightFailed(Failure.REFUSED, problem)
        way = [self._above(drone)]
        for stop in job.stops:
            way += way_from(airspace, drone.id, way[-1], stop)
        seconds = flight_seconds(drone.category, airspace, start, job.stops, job.seconds)
        drone.begin(draw(*self._chance, Order(id=job.id, seconds=seconds)))
        await self._follow(drone, way)
        if job.action is None:
            return None
        job.begins()
        why = grip_problem(drone.id, drone.category, drone.carries, job.action, job.item)
        if why is None:
            await self._pass(drone, BUILT_IN[job.action].seconds)
            why = f"{drone.id} could not do it" if drone.drawn.action else None
        if why is not None:
            raise failed(f"{job.action} failed", why, drone.location)
        if job.action in (PICK, RELEASE):
            drone.carries = job.item if job.action == PICK else None
        return self._world.gives(job.action, job.parameters, drone.location, self._kernel.now)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        one = self.drones[drone]
        if one.job is not None:
            one.job.cancel()
        if one.over is not None:
            one.halt()
            one.over.fail(FlightFailed(Failure.REFUSED, f"{drone} was told to break it off"))

    async def hold(self, drone: str) -> None:
        """Hover until a fault occurs or it is cancelled."""
        one = self.drones[drone]
        one.check()
        if one.drawn.action:
            raise failed("the action failed", f"{drone} could not do it", one.location)
        await self._pass(one, inf)

    async def read(self, drone: str, name: str) -> float:
        """Return the value that was written under this name, or else what is measured here."""
        one = self.drones[drone]
        one.check()
        measured = self._world.measure(name, one.location, self._kernel.now)
        return one.settings.get(name, measured)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Store a value under this name."""
        self.drones[drone].check()
        self.drones[drone].settings[name] = value

    async def takeoff(self, drone: str, height: float) -> None:
        """Take off to a height; does nothing for a drone that flies."""
        one = self.drones[drone]
        one.begin(Drawn())
        await self._follow(one, [(*one.location[:2], height)])

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._move(self.drones[drone], target, self.drones[drone].category.speed)

    async def land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        one = self.drones[drone]
        one.check()
        if not one.landed:
            await self._move(one, (*one.location[:2], 0.0), CLIMB_SPEED)
            one.touch_down(self._kernel.now)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it has crashed, and is lost."""
        one = self.drones[drone]
        if one.failure is Failure.LINK:
            await self._wait(one, one.reachable_at)
        if one.failure is Failure.CRASH:
            return False
        if one.failure is Failure.LINK:
            one.down = None  # the link is back
        try:
            await self._fly_home(one)
        except FlightFailed:  # someone carries it home
            await self._wait(one, self._kernel.now + CARRYING_HOME)
            one.dock()
        one.carries = None
        return True

    async def _fly_home(self, drone: IdealDrone) -> None:
        drone.begin(Drawn())
        if not (drone.landed and docked(drone.location, drone.home)):
            start = self._above(drone)
            way = way_from(self._airspace, drone.id, start, (*drone.home[:2], start[2]))
            await self._follow(drone, [start, *way])
            await self.land(drone.id)

    def _above(self, drone: IdealDrone) -> Point:
        x, y, z = drone.location
        return x, y, self._airspace.cruise_height if drone.landed else z

    async def _follow(self, drone: IdealDrone, way: Sequence[Point]) -> None:
        """Fly a route whose first point is above the drone's place on the ground, or where it hovers."""
        if drone.landed:
            drone.lift_off()
            await self._move(drone, way[0], CLIMB_SPEED)
        for point in way[1:]:
            await self._move(drone, point, drone.category.speed)

    async def _move(self, drone: IdealDrone, target: Point, speed: float) -> None:
        drone.check()  # a fault at take-off leaves it on the ground
        now, start = self._kernel.now, drone.location
        seconds = dist(start, target) / speed
        drone.turn(Leg(start, target, now, now + seconds), now)
        await self._pass(drone, seconds)

    async def _pass(self, drone: IdealDrone, seconds: float) -> None:
        await self._wait(drone, min(self._kernel.now + seconds, drone.next_due[0]))
        drone.check()

    async def _wait(self, drone: IdealDrone, until: float) -> None:
        if until <= self._kernel.now:
            return
        drone.over = over = Future[None]()
        timer = self._kernel.at(until, EventKind.FLIGHT, drone.key, partial(over.set, None))
        try:
            await over
        finally:
            timer.cancel()
            drone.over = None
            if not over.is_set:  # it was cancelled
                drone.halt()
