"""The traffic's layer: when a drone flies, and which way, so that drones keep apart and off no-fly areas."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from ..jobs.controls import Act, Cut, GoTo, Hold, Land, TakeOff
from ..jobs.flown import is_beside
from ..jobs.reports import motors_cut
from ..shared.domain.errors import ANY_ERROR, Cancelled, Failure, FlightFailed
from ..shared.fleet.reach import docked, flight_seconds
from ..shared.hooks.plain_data import item_of, point_of
from ..shared.time.kernel import FLEET, Kernel, Task
from .ledger import CutMotors
from .measuring import Measuring
from .traffic.way_back import way_back, way_from
from .traffic.ways import Section

if TYPE_CHECKING:
    from ..jobs.controls import Command, Controls, FleetDrone
    from ..jobs.flown import Flown
    from ..jobs.link import Order
    from ..jobs.reports import DroneReport
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.airspace import Airspace
    from ..shared.domain.model import Point
    from .ledger import Ledger
    from .traffic.traffic import Traffic, Ways


T = TypeVar("T")

Leaving = Callable[[str], AbstractContextManager[object]]
"""A context for a take-off: entered before the command, left once it is done."""

_HOVERS_ON = (Failure.REFUSED, Failure.ACTION)
"""Failures after which a drone hovers as before."""


def _nothing() -> None:
    """Does nothing: the flight has begun already."""


def _ignore(_: str) -> None:
    """Does nothing: no caller follows arrivals."""


@dataclass(slots=True, eq=False)
class Route:
    """Where a drone flies, which may be told otherwise on its way."""

    stops: Sequence[Point]
    seconds: float = 0.0
    """How long it may take its time for the last leg, at least."""
    legs: list[Point] = field(default_factory=list)
    """Where the legs end that it flies now."""
    is_new: bool = False
    """Whether the stops are others than those that the legs lead to."""

    def leg(self, legs: Sequence[Point]) -> GoTo:
        """Return the command to fly the first of these legs."""
        return GoTo(legs[0], self.seconds if len(legs) == 1 else 0.0)


class Executor:
    """Flies jobs, and obeys single commands, with the drones' own controls."""

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[FleetDrone],
        airspace: Airspace,
        traffic: Traffic | None = None,
        ledger: Ledger | None = None,
        leaving: Leaving | None = None,
        beside: Callable[[Flown], object] | None = None,
        flown: Callable[[Flown], object] | None = None,
    ) -> None:
        """`beside` is told where an action is done beside its target, `flown` how each command went."""
        self._kernel, self._controls, self._airspace = kernel, controls, airspace
        self._beside = beside
        self._leaving: Leaving = leaving or nullcontext
        """Writes down which drone takes off; in a simulation that is not needed after a crash."""
        self._traffic = traffic
        """Keeps drones apart; None: they are not kept apart."""
        self._drones = {drone.id: drone for drone in drones}
        self._measuring: Measuring | None = None
        if flown is not None:
            self._measuring = Measuring(kernel, controls.telemetry, self._drones, flown)
        self._jobs: dict[str, Task[None]] = {}
        """The jobs in progress, by the drones' ids."""
        self._routes: dict[str, Route] = {}
        """By the drones' ids, where those fly that may be sent elsewhere on their way."""
        self.arrived: Callable[[str], object] = _ignore
        """Called with a flight at the end of its last leg, if its order says that this shall be told."""
        self._rescues: dict[str, Task[bool]] = {}
        """The latest rescue of each drone."""
        self.telemetry: Mapping[str, Telemetry] = controls.telemetry
        """The drones' telemetry, always current."""
        self._cut = CutMotors(ledger, lambda drone: not controls.telemetry[drone].landed)

    def join(self, drone: FleetDrone) -> None:
        """Fly a drone that has joined, too."""
        self._drones[drone.id] = drone

    # Jobs

    def fly(
        self, order: Order, begins: Callable[[], object], report: Callable[[object], object]
    ) -> None:
        """Take off, fly to the order's stops and do its action; then report.

        `begins` is called right before the action. Of jobs that are given at one instant the first goes
        first, as those of a brain elsewhere do, which come one by one.
        """
        drone = order["drone"]
        name = f"{drone} flies {order['flight']}"
        self._jobs[drone] = self._kernel.spawn(self._done(order, begins, report), FLEET, name)

    async def _done(
        self, order: Order, begins: Callable[[], object], report: Callable[[object], object]
    ) -> None:
        drone = order["drone"]
        try:
            result = await self._flown(order, begins)
        except FlightFailed as error:
            result = motors_cut(drone) if drone in self._cut else error
        del self._jobs[drone]
        report(result)

    @property
    def is_busy(self) -> bool:
        """Whether any drone has a job."""
        return bool(self._jobs)

    async def go(self, drone: str, stops: Sequence[Point], seconds: float = 0.0) -> None:
        """Fly to these stops from wherever it is, and hover, without a job of its own.

        `seconds`: how long it may take its time for that, at least.
        """
        self._refuse_if_cut(drone)
        await self._flies_to(drone, Route(stops, seconds), partial(self.begins, drone))

    def turn(self, drone: str, stops: Sequence[Point], seconds: float = 0.0) -> bool:
        """Send a drone that is on its way to other stops, without a stop.

        If others are in the way, it flies on to where it was to go, and from there. False: it is not on
        its way, or has arrived; an action that has begun goes on.
        """
        route = self._routes.get(drone)
        if route is None:
            return False
        route.stops = stops
        route.seconds = seconds
        route.is_new = True
        traffic = self._traffic
        if traffic is not None and traffic.wants_another(drone):
            return True
        if not route.legs:
            return True  # it takes off, or has arrived at this instant, and looks then
        section = self._to(drone, route)
        legs = section.points[1:]
        route.is_new = not (
            (traffic is None or traffic.turned(section))
            and self._controls.turn(drone, route.leg(legs))
        )
        if not route.is_new:
            route.legs[:] = legs
            if self._measuring is not None:
                self._measuring.turned.add(drone)
        return True

    async def _flies_to(
        self, drone: str, route: Route, begins: Callable[[], None], *, beside: bool = False
    ) -> Section:
        """Fly to the stops of a route, or to others that it is told on its way."""
        self._routes[drone] = route
        try:
            plan = partial(self._to, drone, route)
            return await self.travels(drone, plan, begins, beside=beside)
        finally:
            if self._routes.get(drone) is route:
                del self._routes[drone]

    async def _flown(self, order: Order, begins: Callable[[], object]) -> object:
        controls = self._controls
        airspace = self._airspace
        drone = order["drone"]
        flight = order["flight"]
        action = order["action"]
        stops = [point_of(stop) for stop in order["stops"]]
        self._refuse_if_cut(drone)
        if action is not None:  # refuse what the hardware cannot do before it takes off
            why = controls.why_not(drone, action, order["parameters"])
            if why is not None:
                raise FlightFailed(Failure.REFUSED, why)

        def leaves() -> None:
            here, category = controls.telemetry[drone].location, self._drones[drone].category
            seconds = flight_seconds(category, airspace, here, stops, order["seconds"])
            controls.begins(drone, flight, seconds)

        way = await self._flies_to(drone, Route(stops), leaves, beside=order["beside"])
        if way.target is not None and self._beside is not None:
            here = controls.telemetry[drone].location
            self._beside(is_beside(drone, flight, way.target, here))
        if order.get("company"):
            self.arrived(flight)
        if action is None:
            return None
        begins()
        item = item_of(order["item"])
        acting = self._does(drone, Act(action, order["parameters"], item, flight))
        return await self._noticed(drone, acting)

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command now, as far as that is measured."""
        return self._measuring is not None and drone in self._measuring.moving

    def _does(self, drone: str, command: Command) -> Coroutine[Any, Any, Any]:
        """Return what carries out a command, and measures it, if commands are measured."""
        done = self._controls.do(drone, command)
        return done if self._measuring is None else self._measuring.measured(drone, command, done)

    # Commands

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        for task in (self._jobs.pop(drone, None), self._rescues.pop(drone, None)):
            if task is not None:
                task.cancel()
        if self._traffic is not None:
            self._traffic.break_off(drone)
        if drone not in self._cut:
            self._controls.break_off(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        self._refuse_if_cut(drone)
        await self._noticed(drone, self._controls.do(drone, Hold()))

    def begins(self, drone: str) -> None:
        """Begin a flight without a job."""
        self._refuse_if_cut(drone)
        self._controls.begins(drone, None, 0.0)

    async def land(self, drone: str) -> None:
        """Land here, or beside it where another stands."""
        self._refuse_if_cut(drone)
        if self._controls.telemetry[drone].landed:
            await self._controls.do(drone, Land())
        else:
            await self.travels(drone, partial(self.way_down, drone), anywhere=True)

    async def home(self, drone: str) -> None:
        """Take off, if it stands, fly to its dock, and land there, or beside it where another stands."""
        self._refuse_if_cut(drone)
        await self.travels(drone, partial(self._home, drone), partial(self.begins, drone))
        await self.land(drone)

    async def cut_motors(self, drone: str) -> None:
        """Switch a drone's motors off now, wherever it is; it is lost then."""
        with self._cut.recording_cut(drone):
            await self._controls.do(drone, Cut())

    def _refuse_if_cut(self, drone: str) -> None:
        """Raise `FlightFailed` if the motors were cut, and the drone has not been repaired since."""
        if drone in self._cut:
            raise motors_cut(drone)

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        report = await self._controls.drone_report(drone)
        if self._traffic is not None:
            self._traffic.look_around()
        why = str(motors_cut(drone))
        if drone in self._cut and why not in report.problems:
            return replace(report, problems=(*report.problems, why))
        return report

    # After a failure

    def mended(self, drone: str) -> None:
        """Called when a lost drone has been repaired: it takes commands again."""
        self._cut.mended(drone)
        self._controls.mended(drone)

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight, landed; False: it is lost.

        What it still carries is unloaded there.
        """
        rescue = self._kernel.spawn(
            self._rescue(drone), self._key(drone), f"{drone} is brought home"
        )
        self._rescues[drone] = rescue
        try:
            await rescue.ended()
        finally:
            rescue.cancel()
        if isinstance(rescue.error, Cancelled):
            raise FlightFailed(Failure.REFUSED, f"{drone} was told to break it off")
        return rescue.result()

    async def _rescue(self, drone: str) -> bool:
        controls = self._controls
        if drone in self._cut or not await controls.reach(drone):
            if self._traffic is not None:
                self._traffic.lost(drone)
            return False
        if self._traffic is not None:
            self._traffic.found(drone)
        home = await self._flies_home(drone)
        if drone in self._cut:  # meanwhile: it fell, and stays there until it is repaired
            return False
        if not home and not await controls.fetched(drone):
            return False
        controls.unload(drone)
        return True

    async def _flies_home(self, drone: str) -> bool:
        telemetry, home = self._controls.telemetry[drone], self._drones[drone].home
        try:
            if telemetry.landed and docked(telemetry.location, home):
                self.begins(drone)
            else:
                await self.home(drone)
        except FlightFailed:
            return False
        return True

    async def _noticed(self, drone: str, hovering: Coroutine[Any, Any, T]) -> T:
        """Await a command of a hovering drone; if it fails, keep others away from there."""
        try:
            return await hovering
        except FlightFailed as error:
            if self._traffic is not None and error.failure not in _HOVERS_ON:
                self._traffic.stopped(drone, fails=True)
            raise

    # Ways

    async def travels(
        self,
        drone: str,
        plan: Callable[[], Section],
        begins: Callable[[], None] = _nothing,
        *,
        ways: Ways | None = None,
        beside: bool = False,
        anywhere: bool = False,
    ) -> Section:
        """Fly a section, or an alternative to the same end, as soon as one is free; return which.

        A drone that must wait for long waits on the ground. `anywhere`: any end will do. With `beside`
        the end may be beside the target, if another drone has taken that.
        """
        traffic, since = self._traffic, self._kernel.now
        if traffic is None:
            section = plan()  # as quickly as can be
            begins()
            while not await self._follow(section):
                section = plan()
            return section
        begun = False
        try:
            while True:
                section = plan()
                way = traffic.clear(section, ways, beside)
                if way is None:
                    way = await traffic.cleared(section, since, ways, beside)
                if way is None:
                    continue
                if way.stands or not begun:
                    begins()
                    begun = True
                if await self._arrives(way, traffic) and (anywhere or not way.aside):
                    return way
        except FlightFailed as error:
            traffic.stopped(drone, fails=error.failure is not Failure.REFUSED)
            raise
        except ANY_ERROR:
            traffic.stopped(drone, fails=False)
            raise

    async def _arrives(self, way: Section, traffic: Traffic) -> bool:
        """Follow a route; return False if traffic has stopped the drone, or it is to go elsewhere."""
        traffic.halted.pop(way.drone, None)
        try:
            is_there = await self._follow(way)
        except FlightFailed as error:
            if error.failure is not Failure.REFUSED or way.drone not in traffic.halted:
                raise
            traffic.stopped(way.drone, fails=False)
            return False
        traffic.rests(way.drone)
        return is_there

    async def _follow(self, section: Section) -> bool:
        """Fly a section; return False if the drone is to go elsewhere by now."""
        traffic = self._traffic
        drone = section.drone
        points = section.points[1:-1] if section.lands else section.points[1:]
        if section.stands:
            with self._leaving(drone):
                await self._does(drone, TakeOff(points[0][2]))
            points = points[1:]
            if traffic is not None:
                traffic.passed(drone)
        route = self._routes.get(drone) or Route(())
        if route.is_new:
            return False
        legs = route.legs
        legs[:] = points
        while legs:
            await self._does(drone, route.leg(legs))
            del legs[0]
            if traffic is not None:
                traffic.passed(drone)
            if route.is_new:
                return False
        if section.lands:
            await self._does(drone, Land())
        return True

    def _to(self, drone: str, route: Route) -> Section:
        """To all stops, and hover at the last."""
        points, stands = self._start(drone, self._airspace.cruise_height)
        route.is_new = False
        for stop in route.stops:
            points += way_from(self._airspace, drone, points[-1], stop)
        return Section(drone, tuple(points), stands, False)

    def _tail(self, drone: str, target: Point) -> tuple[Point, ...]:
        """Return where it goes from there: down, if that is above its dock and no other is in it."""
        if self._traffic is None or not docked(target, self._drones[drone].home):
            return ()
        below = self._traffic.ground.below(drone, target)
        return () if below is None else (below,)

    def way_down(self, drone: str) -> Section:
        """Return the way down, straight or beside it."""
        here = self._controls.telemetry[drone].location
        if self._traffic is not None:
            return self._traffic.ground.way_down(drone)
        points = [here]
        if self._airspace.problem(here) is not None:
            points.append(way_back(self._airspace, here))
        return Section(drone, (*points, (*points[-1][:2], 0.0)), False, True)

    def _home(self, drone: str) -> Section:
        """To above its dock, at the height that it has."""
        x, y, _ = self._drones[drone].home
        points, stands = self._start(drone, self._airspace.cruise_height)
        above = (x, y, points[-1][2])
        points += way_from(self._airspace, drone, points[-1], above)
        return Section(drone, tuple(points), stands, False, self._tail(drone, above))

    def _start(self, drone: str, height: float) -> tuple[list[Point], bool]:
        """Return where a drone is, where it will be after its take-off, and whether it must take off."""
        here = self.place(drone)
        if not self._controls.telemetry[drone].landed:
            return [here], False
        return [here, (here[0], here[1], height)], True

    def place(self, drone: str) -> Point:
        """Return where a drone is, by what it was told, so that no way depends on a few centimetres."""
        if self._traffic is not None:
            return self._traffic.place(drone)
        return self._controls.telemetry[drone].location

    def _key(self, drone: str) -> int:
        return FLEET + 1 + self._drones[drone].index
