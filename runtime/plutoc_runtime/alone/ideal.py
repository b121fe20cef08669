"""Ideal drones: each has the air to itself, so several may pass through each other."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from math import inf
from typing import TYPE_CHECKING, Any

from ..domain.airspace import permitted_way
from ..domain.errors import Failure, FlightFailed
from ..fleet.reach import docked, flight_seconds
from ..hooks.plain_data import item_of, point_of, value_data
from .body import Body
from .faults import CARRYING_HOME, Faults, draw
from .world import World

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.fleet_data import FleetData
    from ..domain.model import Point
    from ..domain.trace import Clock

TRACKED = 0.5
"""Seconds from one look at what moves in the world to the next."""

Work = Generator[float, None, Any]  # it yields until when it waits, and returns the result


class IdealDrones:
    """Obeys a brain with ideal drones; a fleet of one flies exactly as it does with traffic."""

    def __init__(self, app: App, fleet: FleetData, faults: Faults, seed: int, clock: Clock) -> None:
        self._clock = clock
        self._airspace = fleet.airspace
        self._faults = faults
        self._told: list[dict[str, Any]] = []
        self.world = world = World(seed, fleet.airspace, fleet.world)
        kinds = {category.name: category for category in app.categories}
        self.drones = {one.id: Body(one, kinds[one.category], world, clock) for one in fleet.drones}
        self._seen = 0.0  # when it was looked last at what moves
        self._works: dict[str, tuple[int, Work]] = {}  # the order of each drone, carried out
        self._wakes = dict.fromkeys(self.drones, inf)  # until when that waits

    @property
    def due(self) -> float:
        """When something happens next; infinite: only an order can make it happen."""
        return self._clock.now if self._told else min(self._wakes.values())

    @property
    def tracker_due(self) -> float:
        """When it is looked next at what moves in the world; infinite: nothing does."""
        return self._seen + TRACKED if self.world.movers else inf

    def tracks(self) -> dict[str, Any]:
        """Return where everything is now that moves in the world."""
        self._seen = now = self._clock.now
        return self.world.tracks(now)

    def advance(self) -> dict[str, Any]:
        """Let the next thing happen that is due, and return what there is to tell of it."""
        if not self._told:
            drone = min(self._wakes, key=self._wakes.__getitem__)
            self._wakes[drone] = self._go_on(*self._works[drone])
        return self._told.pop(0) if self._told else {}

    def news(self) -> dict[str, Any]:
        """Return the telemetry of the drones whose motion has changed since the last call."""
        now = self._clock.now
        return {id: one.news() for id, one in self.drones.items() if one.changed or one.due <= now}

    def obey(self, order: Mapping[str, Any]) -> None:
        """Begin what is ordered."""
        id = order["drone"]
        do = order["do"]
        drone = self.drones[id]
        if do == "break_off" or (do == "cancel" and self._works[id][0] == order["order"]):
            self._wakes[id] = inf
            drone.halt()
        elif do in ("read", "write", "sees", "act"):  # at once, wherever it is
            self._go_on(order["id"], self._asked(drone, order))
        elif do == "redirect":
            number, _ = self._works[id]
            self._works[id] = number, self._redirect(drone, order)
            self._wakes[id] = self._clock.now
        elif do != "cancel":
            # by _fly, _go, _hold, _home, _land or _recover, after all that is ordered with it
            self._works[id] = order["id"], getattr(self, f"_{do}")(drone, order)
            self._wakes[id] = self._clock.now

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

    def _fly(self, drone: Body, order: Mapping[str, Any]) -> Work:
        flight = order["flight"]
        way = self._way(drone, order)
        drawn = None
        if self._faults != Faults():
            start = drone.location
            stops = [*map(point_of, order["stops"])]
            seconds = flight_seconds(drone.category, self._airspace, start, stops, order["seconds"])
            drawn = draw(self._faults, drone.world.seed, flight, seconds)
        drone.begin(flight, drawn)
        return (yield from self._through(way, drone, order))

    def _redirect(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly on to other stops, from wherever it is."""
        return (yield from self._through(self._way(drone, order), drone, order))

    def _go(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly through stops, and hover."""
        yield from self._until(drone, drone.follow(self._way(drone, order)))

    def _way(self, drone: Body, order: Mapping[str, Any]) -> list[Point]:
        stops = [*map(point_of, order["stops"])]
        for problem in filter(None, map(self._airspace.problem, stops)):
            raise FlightFailed(Failure.REFUSED, problem)
        way = [self._above(drone)]
        for stop in stops:
            way += permitted_way(self._airspace, drone.id, way[-1], stop)
        return way

    def _through(self, way: list[Point], drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly a way, and do the action of its flight at the end."""
        yield from self._until(drone, drone.follow(way))
        if order.get("company"):
            self._told.append({"arrived": order["flight"]})
        action = order["action"]
        item = item_of(order["item"])
        if action is None:
            return None
        yield from self._until(drone, drone.begin_action(action, item))
        return value_data(drone.act(action, order["parameters"], item))

    def _hold(self, drone: Body, _: object) -> Work:
        """Hover until a fault occurs or it is cancelled."""
        drone.check()
        drone.can_act("the action")
        yield from self._until(drone, inf)

    def _asked(self, drone: Body, order: Mapping[str, Any]) -> Work:
        yield from ()  # it answers at once
        drone.check()
        match order["do"]:
            case "read":
                return drone.read(order["name"])
            case "sees":
                seen = self.world.moving(drone.location, self._clock.now)
                return [[one.track, one.kind, [*one.at]] for one in seen]
            case "act":
                return value_data(drone.act(order["action"], order["parameters"], None))
        drone.settings[order["name"]] = order["value"]
        return None

    def _home(self, drone: Body, _: object) -> Work:
        """Take off, if it stands, fly to its dock, and land."""
        drone.begin(None)
        start = self._above(drone)
        way = permitted_way(self._airspace, drone.id, start, (*drone.home[:2], start[2]))
        yield from self._until(drone, drone.follow([start, *way], lands=True))

    def _land(self, drone: Body, _: object) -> Work:
        """Land here; does nothing for a drone that stands on the ground."""
        drone.check()
        if not drone.landed:
            yield from self._until(drone, drone.follow([drone.location], lands=True))

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

    def _until(self, drone: Body, when: float) -> Work:
        """Wait until a time; raise what keeps it from waiting so long."""
        yield min(when, drone.due)
        drone.check()
