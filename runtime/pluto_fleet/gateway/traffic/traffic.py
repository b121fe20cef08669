"""Traffic control: a drone gets a whole section, or waits for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from math import dist, inf
from typing import TYPE_CHECKING

from ...shared.domain.errors import Failure, FlightFailed
from ...shared.time.kernel import FLEET, EventKind, Kernel, Timer
from .beside import best_angle, places_above, places_around, to_beside
from .reservations import Reservation, ahead, are_near, meets
from .space import SWAY, Space
from .wait_queue import HOVERS, Elder, Obstacle, Wait, WaitQueue
from .ways import Ground, Section, sections

if TYPE_CHECKING:
    from ...jobs.controls import Controls, FleetDrone
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Point

AGAIN = 0.5
"""Seconds between two looks at the waiting drones that are due, even if none has reported to have passed."""
WAIT_BEFORE_LANDING = 10.0
"""Seconds that a drone hovers in the way of others before it lands, and waits there."""
AT_LAST = 30.0
"""Seconds after which it lands even if its way will soon be free."""
TOGETHER = 0.1
"""Seconds within which requests count as simultaneous: those of one instant reach a gateway one by one."""
ELDER = 20.0
"""Seconds after which later requests may not even cross where a drone wants to fly."""
NEARER = 4.0
"""Seconds that a drone flies longer rather than act one step, by which drones are kept apart, farther from its target."""
OVERSHOOT, STOPPING = 0.6, 2.0
"""How far a real drone overshoots when it stops, in metres, and for how long: at least, and a Crazyflie."""
REACTS = 0.5
"""Seconds for which a real drone flies on until it brakes."""
_TARGETS, _WAYS = 100, 2_000
"""Of how many targets the places beside them are kept, and how many ways to such places."""
_EXACT = 1e-9

Ways = Callable[[Section], Iterable[Section]]
"""Alternative sections to a drone's destination, the best first."""


class Traffic:
    """The reservations of all drones: no two come nearer to each other than `apart`."""

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[FleetDrone],
        airspace: Airspace,
        *,
        apart: float,
        slack: float = 0.0,
        max_airborne: int | None = None,
    ) -> None:
        self._kernel, self._controls, self._airspace = kernel, controls, airspace
        self._drones = {drone.id: drone for drone in drones}
        self._telemetry = controls.telemetry
        self.apart, self.step = apart, apart + slack
        self.limit = self.step - _EXACT
        self.is_real = slack > 0
        """Whether drones are real: simulated ones stop at once."""
        self.level = self.step + (SWAY if self.is_real else 0.0)
        """The height between two ways of which one leads over the other."""
        self._max_airborne = max_airborne
        most = len(drones) if max_airborne is None else max_airborne
        self.is_limited = most < len(drones)
        """Whether the number of drones in the air is limited."""
        # Those that wait ask for the same again and again.
        around = partial(places_around, step=self.level, airspace=airspace)
        self._places_around = lru_cache(_TARGETS)(around)
        self._to_beside = lru_cache(_WAYS)(partial(to_beside, airspace=airspace))
        self._waiting = WaitQueue(self.limit)
        self._space = Space(
            kernel, self._drones, controls.telemetry, apart, self.limit, self.is_real, most
        )
        self._space.changed = self._waiting.changed
        self._claims = self._space.claims
        self.place = self._space.place
        self.lost, self.found = self._space.lost, self._space.found
        self._free: dict[str, None] = {}
        """The drones that have released space at this instant."""
        self.halted: dict[str, None] = {}
        """Drones that were stopped because another has failed, and continue by another route."""
        self._timer: Timer | None = None
        self.ground = Ground(self._drones, self._telemetry, airspace, self.step, self.place)
        self.look_around()

    def join(self, drone: FleetDrone) -> None:
        """Keep a drone that has joined apart, too; its dock is taken from now on."""
        self._drones[drone.id] = drone  # the space and the ground have the same mapping
        if self._max_airborne is None:
            self._space.most = len(self._drones)
        self.is_limited = self._space.most < len(self._drones)

    def look_around(self) -> None:
        """Reserve space for drones that are in the air without a section."""
        for drone, telemetry in self._telemetry.items():
            if drone not in self._claims and not telemetry.landed:
                self._space.claim(drone).rests((), 0.0)

    # A drone's section

    def clear(
        self, section: Section, ways: Ways | None = None, beside: bool = False
    ) -> Section | None:
        """Reserve a section for a drone, or an alternative; return None if it must wait.

        With `beside` it may end beside its target, if another drone has taken that.
        """
        if not self._space.has_room(section):
            return None
        now = self._kernel.now
        shoots = self._shoots(section.drone, now)
        if shoots:
            section = replace(section, shoots=shoots)
        for way in self._ways(section, ways):
            if shoots:
                way = replace(way, shoots=shoots)
            if self._space.blocker(way) is None and not (self._waiting and self._elder(way, now)):
                return self._give(way)
        if not (beside and self._is_taken(section, now)):
            return None
        way_beside = self._beside(section, now)
        return None if way_beside is None else self._give(way_beside)

    async def cleared(
        self,
        section: Section,
        since: float,
        ways: Ways | None = None,
        beside: bool = False,
    ) -> Section | None:
        """Wait for a section, and return it; it may only lead out of the way.

        None: the drone wants another one by now.
        """
        wait = Wait(section, since, tuple(self._ways(section, ways)), beside)
        self._waiting.add(wait)
        if self._timer is None:
            self._timer = self._look_at(self._kernel.now + AGAIN, self._look)
        try:
            return await wait.over
        finally:
            if wait in self._waiting:
                self._waiting.remove(wait)

    def passed(self, drone: str) -> None:
        """Called when a drone has reached the next point of its section."""
        self._claims[drone].at += 1
        self._released(drone)

    def rests(self, drone: str) -> None:
        """Called when a drone is at the end of its section."""
        if self._telemetry[drone].landed:
            self._space.drop(drone)
        else:
            claim = self._space.claim(drone)
            _, seconds = self._stopping(drone)
            claim.rests(claim.tail, self._kernel.now + seconds)
        self._released(drone)

    def stopped(self, drone: str, fails: bool) -> None:
        """Called when a drone's command was aborted, or has failed."""
        claim = self._claims.get(drone)
        telemetry = self._telemetry[drone]
        if telemetry.landed:
            self._space.drop(drone)
        elif fails:
            self._space.claim(drone).sinks()
            self._stop_before(drone)
        elif claim is None:
            self._space.claim(drone).rests((), 0.0)
        elif claim.moves:
            metres, seconds = self._stopping(drone)
            tail = ahead(claim.shape(self._kernel.now), metres)
            claim.rests(tail, self._kernel.now + seconds)
        self._released(drone)

    def _stop_before(self, drone: str) -> None:
        """Stop drones before they fly below a sinking one; one that is there already flies on."""
        column = self._claims[drone].shape(self._kernel.now)
        for other, claim in self._claims.items():
            if other == drone or not claim.moves or other in self.halted:
                continue
            shape = claim.shape(self._kernel.now)
            if meets(shape, column, self.limit) and not meets(shape[:1], column, self.limit):
                self.halted[other] = None
                self._controls.break_off(other)

    def turned(self, section: Section) -> bool:
        """Reserve another section for a drone that is on its way; False: that must stop first.

        The drone does not stop: where it may shoot to is reserved, too.
        """
        now = self._kernel.now
        way = replace(section, shoots=self._shoots(section.drone, now))
        if self._space.blocker(way) is not None or (self._waiting and self._elder(way, now)):
            return False
        self._give(way)
        return True

    def _shoots(self, drone: str, now: float) -> tuple[Point, ...]:
        """Return where a drone may shoot to that is on its way, or has not stopped yet."""
        claim = self._claims.get(drone)
        if claim is None or not self.is_real:
            return ()
        if claim.moves:
            metres, _ = self._stopping(drone)
            return ahead(claim.shape(now), metres)
        return claim.tail if now < claim.until else ()

    def _stopping(self, drone: str) -> tuple[float, float]:
        """Return how many metres a drone overshoots when it stops, and for how many seconds."""
        if not self.is_real:
            return 0.0, STOPPING
        category = self._drones[drone].category
        speed = min(category.speed, category.motion.limit)
        rate = category.motion.acceleration
        if not rate:
            return OVERSHOOT, STOPPING
        metres = speed * (REACTS + speed / (2 * rate))
        return max(OVERSHOOT, metres), max(STOPPING, REACTS + speed / rate)

    def wants_another(self, drone: str) -> bool:
        """Called when a drone that may wait for its section wants another; return whether it did."""
        wait = self._waiting.of(drone)
        if wait is None:
            return False
        self._waiting.remove(wait)
        wait.over.set(None)
        return True

    def break_off(self, drone: str) -> None:
        """Drop a drone's place in the queue."""
        wait = self._waiting.of(drone)
        if wait is not None:
            self._waiting.remove(wait)
            wait.over.fail(FlightFailed(Failure.REFUSED, f"{drone} was told to break it off"))

    # The queue

    def _released(self, drone: str) -> None:
        """Check the drones that wait for this one, at the end of this instant."""
        if self._waiting:
            if (claim := self._claims.get(drone)) is not None:
                self._waiting.changed(claim)
            if not self._free:
                self._look_at(self._kernel.now, self._look_at_some)
            self._free[drone] = None

    def _look_at(self, when: float, look: Callable[[], None]) -> Timer:
        return self._kernel.at(when, EventKind.CLOCK, FLEET, look)

    def _look_at_some(self) -> None:
        """Serve the drones that waited for those that have released space."""
        free, self._free = self._free, {}
        for wait in self._waiting.in_turn():
            is_for_room = wait.section.stands and self.is_limited
            if is_for_room or not free.keys().isdisjoint(wait.keepers):
                self._serve(wait)

    def _look(self) -> None:
        """Serve the waiting drones that are due: space becomes free gradually, without a notice."""
        self._timer, now = None, self._kernel.now
        for wait in self._waiting.in_turn():
            if wait.due <= now or self._should_land(wait) or self._may_go(wait):
                self._serve(wait)
        if self._waiting:
            self._timer = self._look_at(self._kernel.now + AGAIN, self._look)

    def _serve(self, wait: Wait) -> None:
        section = self._found(wait)
        if section is None and wait.beside and self._is_taken(wait.section, wait.since):
            section = self._beside(wait.section, wait.since)
            wait.due = self._kernel.now  # a place may become free at any time
        if section is None and self._should_land(wait):
            ways = self.ground.ways_down(wait.section.drone)
            section = next((way for way in ways if self._space.blocker(way) is None), None)
        if section is not None:
            self._waiting.remove(wait)
            wait.over.set(self._give(section))

    def _found(self, wait: Wait) -> Section | None:
        """Return a free section; if there is none, write down when to look again."""
        now = self._kernel.now
        if not self._space.has_room(wait.section):
            wait.due = now
            return None
        due = inf
        for index, way in enumerate(wait.ways):
            elder = wait.elders[index]
            if index and elder is not None and elder.wait in self._waiting:
                continue  # the first one's obstacle must be known
            obstacle = self._obstacle_on(wait, index)
            if obstacle is None and not self._is_kept(wait, index):
                obstacle = self._obstacle(way)  # where all are now, also if not on their routes
                if obstacle is None and (not way.lands or self.ground.may_land(way)):
                    return way
            wait.obstacles[index] = obstacle
            due = min(due, now + HOVERS if obstacle is None else obstacle.due)
        wait.looked(due)
        return None

    def _obstacle_on(self, wait: Wait, index: int) -> Obstacle | None:
        """Return the obstacle on an alternative: most often the same as before."""
        way, obstacle = wait.ways[index], wait.obstacles[index]
        if obstacle is not None:
            if obstacle.is_sure(self._kernel.now):
                return obstacle
            claim = obstacle.claim
            if self._claims.get(claim.drone) is claim and self._space.is_in_the_way(claim, way):
                obstacle.seen(way.whole, self.limit, self._kernel.now)
                return obstacle
        return self._obstacle(way, wait.clear[index])

    def _obstacle(
        self, way: Section, clear: dict[str, tuple[Point, ...]] | None = None
    ) -> Obstacle | None:
        claim = self._space.blocker(way, clear)
        if claim is None:
            return None
        obstacle = Obstacle(claim, self._drones[claim.drone].category, self.is_real)
        obstacle.seen(way.whole, self.limit, self._kernel.now)
        return obstacle

    def _is_kept(self, wait: Wait, index: int) -> bool:
        """Whether an alternative without an obstacle is for an older drone."""
        elder = wait.elders[index]
        if elder is None or not self._goes_first(elder):
            elder = wait.elders[index] = self._elder(wait.ways[index], wait.since)
        return elder is not None

    def _should_land(self, wait: Wait) -> bool:
        """Whether a waiting drone should do so on the ground."""
        waited = self._kernel.now - wait.since
        if wait.section.stands or waited < WAIT_BEFORE_LANDING:
            return False
        blocker = self._first_blocker(wait)
        return blocker is None or not blocker.moves or waited >= AT_LAST

    def _first_blocker(self, wait: Wait) -> Reservation | None:
        """Return what was in the way of a drone's own section, not of an alternative, at the last check."""
        first = wait.obstacles[0]
        return None if first is None else self._claims.get(first.claim.drone)

    # Beside a target

    def _beside(self, section: Section, since: float) -> Section | None:
        """Return a free section to a place beside the target, which another drone has taken."""
        if not self._space.has_room(section):
            return None
        category = self._drones[section.drone].category
        target = section.points[-1]
        best = None
        least = inf
        soon = section.seconds(category)
        holder = self._space.holder(target, section.drone)
        holders = holder.points if holder is not None and holder.moves else None
        angle = best_angle(section.points, holders)
        around = self._places_around(target, angle=angle)
        free = [place for place in around if self._space.holder(place, section.drone) is None]
        for place in free or places_above(target, self.level, self._airspace):
            far = NEARER * dist(place, target) / self.level
            if soon + far >= least:  # it need not be there earlier than at its target
                break  # all others are farther still
            if self._is_shut(section.drone, place):
                continue
            way = self._to_beside(section, place)
            if way is None or way.seconds(category) + far >= least:
                continue  # so it is at other heights, where it takes longer still
            for one in sections(way, self.level, self._airspace):
                cost = max(soon, one.seconds(category)) + far
                is_free = cost < least and self._space.blocker(one) is None
                if is_free and not self._elder(one, since):
                    best, least = one, cost
        return best

    def _is_shut(self, drone: str, place: Point) -> bool:
        """Whether a drone cannot be at a place now, for another is there, or will come by."""
        return self._space.blocker(Section(drone, (place,), True, False)) is not None

    def _is_taken(self, section: Section, since: float) -> bool:
        """Whether another drone hovers at a section's end or will, or an older one waits for it."""
        end, drone = section.points[-1], section.drone
        return self._space.holder(end, drone) is not None or any(
            wait.since < since - TOGETHER
            and wait.section.drone != drone
            and dist(wait.section.points[-1], end) < self.limit
            for wait in self._waiting
        )

    # Reservations

    def _ways(self, section: Section, ways: Ways | None) -> Iterable[Section]:
        return sections(section, self.level, self._airspace) if ways is None else ways(section)

    def _give(self, section: Section) -> Section:
        claim = self._space.claim(section.drone)
        _, seconds = self._stopping(section.drone)
        until = self._kernel.now + seconds if section.shoots else 0.0
        claim.moves_along(section.points, section.tail, section.shoots, until)
        self._waiting.changed(claim)
        return section

    def _elder(self, section: Section, since: float) -> Elder | None:
        """Return a drone that has waited longer, and would wait longer still for this section.

        None may end where an older one wants to fly, nor cross there once it is its turn. A landing is never
        blocked by that, nor the way to one's dock, nor a drone that makes room for the older one.
        """
        if section.lands or section.tail:
            return None
        points, limit = section.points, self.limit
        for wait in self._waiting:
            wanted = wait.section.points
            if (
                wait.since < since - TOGETHER
                and wait.section.drone != section.drone
                and are_near(section.box, wait.section.box, limit)
                and meets(points, wanted, limit)
            ):
                if meets(points[-1:], wanted, limit):
                    return Elder(wait, True)
                makes_room = not section.stands and meets(points[:1], wanted, limit)
                if self._is_its_turn(wait) and not makes_room:
                    return Elder(wait, False)
        return None

    def _goes_first(self, elder: Elder) -> bool:
        """Whether what was found of an elder drone still holds."""
        return elder.wait in self._waiting and (elder.always or self._is_its_turn(elder.wait))

    def _may_go(self, wait: Wait) -> bool:
        """Whether a drone that only an elder one keeps need not wait for that any more."""
        elder = wait.elders[0]
        return wait.obstacles[0] is None and elder is not None and not self._goes_first(elder)

    def _is_its_turn(self, wait: Wait) -> bool:
        """Whether a drone has waited for long, and does not wait for one that hovers in its way."""
        blocker = self._first_blocker(wait)
        return self._kernel.now - wait.since >= ELDER and (blocker is None or blocker.moves)
