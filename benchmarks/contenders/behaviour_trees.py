"""py_trees: a behaviour tree a mission; all trees that still run are ticked in turn, without a pause.

Repeat(trips)[Retry[Selector[Sequence[allocate, launch, Parallel[watch, timer], first], retry]]],
then judge, again
"""

from __future__ import annotations

import time
from heapq import heappop, heappush

import py_trees
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Repeat, Retry

from .ideal import COMPLETED, FAILED, RUNNING, STANDBY, Mission, told
from .process import Notes, main
from .work import LIMIT, Done, Work, fails

ATTEMPTS = 1000
"""More than any trip needs."""

py_trees.logging.level = py_trees.logging.Level.ERROR


class Timed(Mission):
    """A mission that knows when its drone left."""

    __slots__ = ("start",)

    def __init__(self, number: int, trips: int) -> None:
        super().__init__(number, trips)
        self.start = 0.0


class Fleet:
    """The free drones, and the missions that wait for one."""

    def __init__(self, drones: int) -> None:
        self.free, self.seq = list(range(drones)), 0
        self.waiting: list[tuple[int, int, Timed]] = []

    def request(self, m: Timed) -> None:
        """Give a mission a drone, now or later."""
        if self.free:
            m.drone = heappop(self.free)
        else:
            self.seq += 1
            heappush(self.waiting, (-m.priority, self.seq, m))

    def release(self, drone: int) -> None:
        """Hand a drone to the next that waits, or keep it."""
        if self.waiting:
            heappop(self.waiting)[2].drone = drone
        else:
            heappush(self.free, drone)


class Block(Behaviour):
    """A block of the flow as a leaf of the tree."""

    def __init__(self, m: Timed, fleet: Fleet) -> None:
        super().__init__(type(self).__name__)
        self.m, self.fleet = m, fleet

    def update(self) -> Status:
        """Do nothing, and do it well."""
        return Status.SUCCESS


class Allocate(Block):
    """Waits for a drone."""

    def initialise(self) -> None:
        """Ask for it."""
        self.fleet.request(self.m)

    def update(self) -> Status:
        """Return whether it is there."""
        return Status.SUCCESS if self.m.drone >= 0 else Status.RUNNING


class Launch(Block):
    """Lets the drone go."""

    def update(self) -> Status:
        """Note when."""
        self.m.status, self.m.start = RUNNING, time.monotonic()
        return Status.SUCCESS


class Watch(Block):
    """Waits for the end of the flight: it comes at the next tick."""

    def initialise(self) -> None:
        """The drone is in the air."""
        self.in_the_air = True

    def update(self) -> Status:
        """Say how the flight has ended, once it has."""
        m = self.m
        if self.in_the_air:
            self.in_the_air = False
            return Status.RUNNING
        self.fleet.release(m.drone)
        m.drone = -1
        if fails(m.id, m.trip, m.attempt):
            m.status = FAILED
            m.failed_trips += 1
            return Status.FAILURE
        return Status.SUCCESS


class Timer(Block):
    """Gives a flight up that takes too long."""

    def update(self) -> Status:
        """Look at the clock."""
        late = time.monotonic() - self.m.start > LIMIT
        return Status.FAILURE if late else Status.RUNNING


class First(Block):
    """A trip is done."""

    def update(self) -> Status:
        """Count it."""
        m = self.m
        m.done_trips += 1
        m.trip += 1
        m.attempt = 0
        m.status = STANDBY if m.trip < m.trips else COMPLETED
        return Status.SUCCESS


class Again(Block):
    """A trip has failed."""

    def update(self) -> Status:
        """Try it once more, one priority higher."""
        self.m.priority += 1
        self.m.attempt += 1
        return Status.FAILURE


class Judge(Block):
    """Accepts every mission."""


class Repeater(Block):
    """Repeats no mission."""


def tree(m: Timed, fleet: Fleet) -> Sequence:
    """Return a mission's tree."""
    parallel = Parallel("monitors", ParallelPolicy.SuccessOnOne())
    parallel.add_children([Watch(m, fleet), Timer(m, fleet)])
    trip = Sequence("trip", memory=True)
    trip.add_children([Allocate(m, fleet), Launch(m, fleet), parallel, First(m, fleet)])
    tried = Selector("trip or retry", memory=True)
    tried.add_children([trip, Again(m, fleet)])
    trips = Repeat("trips", Retry("retry", tried, num_failures=ATTEMPTS), num_success=m.trips)
    root = Sequence("mission", memory=True)
    root.add_children([trips, Judge(m, fleet), Repeater(m, fleet)])
    return root


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    fleet = Fleet(work.drones)
    missions = [Timed(number, work.trips) for number in range(work.missions)]
    active = [tree(m, fleet) for m in missions]
    while active:
        for root in active:
            root.tick_once()
        active = [root for root in active if root.status == Status.RUNNING]
    return told([*missions])


if __name__ == "__main__":
    main(fly)
