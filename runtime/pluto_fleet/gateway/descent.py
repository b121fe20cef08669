"""Bringing all drones down at once, where they are or each at home, and apart from one another.

A drone that goes home does so even if it is on the ground elsewhere, with what it carries.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from functools import partial
from itertools import islice
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from ..jobs.reports import Down
from ..shared.domain.errors import FlightFailed
from ..shared.fleet.reach import docked
from ..shared.time.kernel import FLEET, Kernel, Task
from .traffic.choosing import DescendingDrone
from .traffic.courses import Course, course
from .traffic.timetable import Timetable, timetable
from .traffic.ways import ways_home

if TYPE_CHECKING:
    from ..jobs.controls import FleetDrone
    from ..shared.domain.airspace import Airspace
    from .executor import Executor
    from .traffic.traffic import Traffic
    from .traffic.ways import Section

_LOOK = 0.1
"""The polling interval while others are to pass first, in seconds."""
_NEAR = 60
"""How many ways to the ground are considered, other than straight below."""

_Command = Callable[[], Coroutine[Any, Any, None]]


class Descent:
    """Brings down every drone in the air. One that fails does not hold up the others."""

    def __init__(
        self,
        kernel: Kernel,
        pilots: Executor,
        drones: Sequence[FleetDrone],
        airspace: Airspace,
        traffic: Traffic | None,
    ) -> None:
        self._kernel, self._pilots, self._airspace = kernel, pilots, airspace
        self._drones, self._traffic = drones, traffic
        self._places = {drone.id: drone.index for drone in drones}
        self._tasks: list[Task[bool]] = []
        self._plan = Timetable()
        self._at: dict[str, tuple[int, int]] = {}
        """The drones' progress: the piece of its course that each left last, and its next stop."""

    async def down(self, how: Down) -> None:
        """Bring them down; if cancelled, they hover."""
        try:
            goers = self._goers(how)
            if self._traffic is None:
                self._at_once(goers)
            else:
                now, later = self._split(goers, self._traffic)
                self._in_turn(timetable(now, self._traffic.limit), later)
            for task in self._tasks:
                await task
        finally:
            for task in self._tasks:
                task.cancel()

    # The plan

    def _goers(self, how: Down) -> list[DescendingDrone]:
        """Return the drones that are to come down, with their courses: home, or near to where they are.

        The one with the longest way home chooses first: the others have time. One that lands below others
        chooses before them.
        """
        found = []
        for drone in self._drones:
            ways = self._ways_home(drone) if how is Down.HOME else []
            if not ways and not self._pilots.telemetry[drone.id].landed:
                ways = self._ways_down(drone)
            if ways:
                courses = sorted((self._course(drone, way) for way in ways), key=attrgetter("cost"))
                found.append(DescendingDrone(drone.id, courses))
        sign = 1 if how is Down.LAND else -1
        return sorted(found, key=lambda goer: sign * goer.courses[0].seconds)

    def _split(
        self, goers: Sequence[DescendingDrone], traffic: Traffic
    ) -> tuple[list[DescendingDrone], list[DescendingDrone]]:
        """Return the drones that go by the plan, and those that go when there is room.

        With a limit of drones in the air, none of these may have to wait for one on the ground.
        """
        stand = [goer for goer in goers if traffic.is_limited and goer.courses[0].section.stands]
        return [goer for goer in goers if goer not in stand], stand

    def _ways_down(self, drone: FleetDrone) -> list[Section]:
        if self._traffic is None:
            return [self._pilots.way_down(drone.id)]
        return [*islice(self._traffic.ground.ways_down(drone.id), _NEAR)]

    def _ways_home(self, drone: FleetDrone) -> list[Section]:
        """Return courses home; none if it is there, or cannot get there."""
        telemetry, traffic = self._pilots.telemetry[drone.id], self._traffic
        if telemetry.landed and docked(telemetry.location, drone.home):
            return []
        if traffic is not None and traffic.ground.below(drone.id, drone.home) is None:
            return []  # another stands there
        step = 0.0 if traffic is None else traffic.step
        here = self._pilots.place(drone.id)
        ways = ways_home(self._airspace, drone, here, telemetry.landed, step)
        kind = drone.category
        enough = telemetry.battery_level * kind.endurance
        return [way for way in ways if self._course(drone, way).seconds < enough]

    def _course(self, drone: FleetDrone, way: Section) -> Course:
        return course(way, drone.category.speed, drone.category.motion)

    # Flying it

    def _at_once(self, goers: Sequence[DescendingDrone]) -> None:
        """Fly all by the quickest way: they are not kept apart."""
        for goer in goers:
            self._send(goer.drone, partial(self._flies, goer.drone, goer.courses[0].section))

    def _in_turn(self, plan: Timetable, later: Sequence[DescendingDrone]) -> None:
        """Fly all by the plan, and then those without a planned course."""
        self._plan = plan
        self._at = dict.fromkeys(plan.courses, (0, 0))
        for drone in plan.courses:
            self._send(drone, partial(self._follows, drone))
        for goer in (*plan.without, *later):
            ways = [one.section for one in goer.courses]
            self._send(goer.drone, partial(self._flies, goer.drone, *ways))

    async def _flies(self, drone: str, *ways: Section) -> None:
        begins = partial(self._pilots.begins, drone)
        await self._pilots.travels(
            drone, lambda: ways[0], begins, ways=lambda _: ways, anywhere=True
        )

    async def _follows(self, drone: str) -> None:
        """Fly stretch by stretch to the end, each time as far as those that go first have passed."""
        last = len(self._plan.courses[drone].pieces) - 1
        telemetry, at = self._pilots.telemetry[drone], 0
        try:
            self._pilots.begins(drone)
            while at < last:
                to = self._free(drone, at)
                if to == at:
                    await self._kernel.sleep(_LOOK)
                    continue
                self._at[drone] = at, to
                await self._pilots.travels(
                    drone, partial(self._stretch, drone), ways=_no_other, anywhere=True
                )
                if telemetry.landed:
                    return
                at = to
                self._at[drone] = at, at
            if not telemetry.landed:  # it was stopped while it left its dock: that is no way to fly
                await self._pilots.land(drone)
        finally:
            del self._at[drone]

    def _stretch(self, drone: str) -> Section:
        """Return a drone's next stretch, from where it is: it may have been stopped on the way."""
        (first, last), one = self._at[drone], self._plan.courses[drone]
        telemetry = self._pilots.telemetry[drone]
        here = self._pilots.place(drone)
        first = max(first, one.piece_at(here, first, last) - 1)
        return one.stretch(here, telemetry.landed, first, last)

    def _free(self, drone: str, at: int) -> int:
        """Return its next resting place; the present one, if another has to pass first."""
        last = len(self._plan.courses[drone].pieces) - 1
        waits = [
            piece for piece, other, its in self._plan.after[drone] if not self._left(other, its)
        ]
        free = min((piece - 1 for piece in waits if piece > at), default=last)
        return self._plan.rest_after(drone, at, free)

    def _left(self, drone: str, piece: int) -> bool:
        """Return whether a drone has left a piece of its course."""
        if drone not in self._at:
            return True  # it is down, or fails
        if self._traffic is not None and self._traffic.touches_down(drone):
            return True
        first, last = self._at[drone]
        if last <= piece and first == last:
            return False
        here = self._pilots.telemetry[drone].location
        return self._plan.courses[drone].piece_at(here, first, last) > piece

    def _send(self, drone: str, command: _Command) -> None:
        key = FLEET + 1 + self._places[drone]
        self._tasks.append(self._kernel.spawn(_well(command), key, f"{drone} comes down"))


async def _well(command: _Command) -> bool:
    """Return whether a command succeeded; a failure does not hold up other drones."""
    try:
        await command()
    except FlightFailed:
        return False
    return True


def _no_other(section: Section) -> Sequence[Section]:
    """No alternative: the plan of all others relies on this course."""
    return (section,)
