"""What moves: where each tracked object is, and where a drone will meet it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise, starmap
from math import dist, inf
from typing import TYPE_CHECKING, Any

from ..fleet.reach import flight_seconds
from ..hooks.plain_data import point_of
from ..time.kernel import FLEET, EventKind, Future
from .declared import TracksDeclared
from .part import Part

if TYPE_CHECKING:
    from ..domain.model import Drone, Point
    from ..flow.engine import Engine


@dataclass(frozen=True, slots=True)
class Track:
    """An object that moves, by its last two reports."""

    id: str
    kind: str
    at: Point
    time: float
    velocity: Point = (0.0, 0.0, 0.0)

    def place(self, now: float) -> Point:
        """Return where it is at a time, if it goes on as it did."""
        x, y, z = self.at
        vx, vy, vz = self.velocity
        passed = now - self.time
        return x + passed * vx, y + passed * vy, z + passed * vz


class TracksOf(TracksDeclared):
    """Makes the tracks of an app that follows what moves."""

    def __call__(self, engine: Engine) -> Tracks:
        """Return what knows them in a running app."""
        return Tracks(engine)


class Tracks(Part):
    """The objects that are tracked now; nothing of them survives the app."""

    def __init__(self, engine: Engine) -> None:
        self._core = engine.core
        self.known: dict[str, Track] = {}
        self._waiting: dict[str, list[Future[Track]]] = {}

    def tell(self, message: Mapping[str, Any]) -> None:
        """Take over the reports of what moves: `tracks`, by id, with `at`, perhaps `kind`, and seconds `ago`."""
        for id, report in message.get("tracks", {}).items():
            at = point_of(report["at"])
            now = self._core.kernel.now - report.get("ago", 0.0)
            last = self.known.get(id)
            velocity = (0.0, 0.0, 0.0)
            if last is not None and 0.0 < now - last.time < LONGEST_GAP:
                x, y, z = (
                    (new - old) / (now - last.time) for new, old in zip(at, last.at, strict=True)
                )
                velocity = x, y, z
            kind = report.get("kind", "" if last is None else last.kind)
            self.known[id] = track = Track(id, kind, at, now, velocity)
            for future in self._waiting.pop(id, ()):
                future.set(track)

    async def next(self, id: str, within: float, began: float) -> Track | None:
        """Wait for the next report of an object; None: there is none in this time since the last one.

        Nor since a pursuit `began`: each takes that long at the least.
        """
        future = Future[Track]()
        waiting = self._waiting.setdefault(id, [])
        waiting.append(future)
        kernel = self._core.kernel
        known = self.known.get(id)
        since = began if known is None else max(began, known.time)
        due = since + within
        try:
            while not await kernel.within(future, due, EventKind.TIMER, FLEET):
                if kernel.time() - due <= HELD_UP:
                    return None
                # it was held up, and what was told is yet to be heard
                due = kernel.time() + HELD_UP
            return future.result()
        finally:
            if future in waiting:
                waiting.remove(future)

    def meeting(
        self, track: Track, drone: Drone, height: float, *, on_its_way: bool = False
    ) -> Point:
        """Return where a drone that leaves now, or is `on_its_way`, meets an object, at a height above it.

        If it never catches up with it, that is where the object is now.
        """
        now = self._core.kernel.now
        there = self._rest_of_the_way if on_its_way else self._way_there
        early = 0.0
        late = SOONEST
        while there(track, drone, height, now, late) > late:
            early = late
            late *= 2
            if late > LATEST:
                return self._above(track, height, now)
        while late - early > SOONEST:
            middle = (early + late) / 2
            if there(track, drone, height, now, middle) > middle:
                early = middle
            else:
                late = middle
        return self._above(track, height, now + late)

    def ahead(self, track: Track, drone: Drone, height: float) -> tuple[Point, float]:
        """Return where a drone that is on its way is to meet an object, and in how many seconds.

        Never so soon that it would be there before it is told where to fly next.
        """
        now = self._core.kernel.now
        category = drone.category
        after = AHEAD
        for _ in range(TRIES):
            point = self._above(track, height, now + after)
            metres = dist(drone.location, point)
            needed = category.motion.at_speed(metres, category.speed)
            if needed <= after:
                return point, after
            after = needed
        return self._above(track, height, now), 0.0

    def aside(self, point: Point, other: Point, metres: float) -> Point:
        """Return a point so many metres from this one on the side of another, or, if less than 0, on the far one.

        If no drone may be there, that is this point.
        """
        airspace = self._core.airspace
        x, y, z = point
        far = dist(point[:2], other[:2])
        if far == 0.0:
            return point
        share = min(metres, far) / far
        moved = (
            round(x + share * (other[0] - x), 3),
            round(y + share * (other[1] - y), 3),
            z,
        )
        return point if airspace.problem(moved) is not None else moved

    def _way_there(
        self, track: Track, drone: Drone, height: float, now: float, after: float
    ) -> float:
        """Return how many seconds a drone needs to where an object is after others."""
        core = self._core
        point = self._above(track, height, now + after)
        return flight_seconds(drone.category, core.airspace, drone.location, [point], 0.0)

    def _rest_of_the_way(
        self, track: Track, drone: Drone, height: float, now: float, after: float
    ) -> float:
        """Return the same for one that flies already, and keeps its speed."""
        category = drone.category
        way = self._core.airspace.route(drone.location, self._above(track, height, now + after))
        if way is None:
            return inf
        metres = sum(starmap(dist, pairwise((drone.location, *way))))
        motion = category.motion
        return motion.at_speed(metres, category.speed) + motion.stops(category.speed)

    def _above(self, track: Track, height: float, when: float) -> Point:
        """Return the point above an object at a time, on the map."""
        width, depth = self._core.airspace.size
        x, y, z = track.place(when)
        return (
            round(min(max(x, 0.0), width), 3),
            round(min(max(y, 0.0), depth), 3),
            round(z + height, 3),
        )


LONGEST_GAP = 5.0
"""Seconds between two reports from which on they say nothing of a velocity."""
SOONEST = 0.1
"""Seconds to which a meeting is reckoned exactly."""
HELD_UP = 0.1
"""Seconds by which a timer may be late, before it is asked whether something was told meanwhile."""
AHEAD = 1.0
"""Seconds in which a drone that follows is to be where the object will be, at least."""
TRIES = 50
"""How often the time until a meeting is reckoned again, for where the object will be by then."""
LATEST = 600.0
"""Seconds from which on there is no meeting."""
