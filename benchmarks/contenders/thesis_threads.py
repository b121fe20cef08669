"""The thesis's architecture (4.3, 5.2), as far as it is told: blocks observe each other, with threads.

A thread for each mission, for each trip, and for each block that a mission enters: a block's
`update` starts a thread that does the block's work and then tells those that observe it. Nothing
polls: a thread that waits is woken. The mission is shared by its branches; the gate remembers which trips
have passed.
"""

from __future__ import annotations

from threading import Condition, Event, Lock, Thread, active_count

from . import ideal
from .ideal import COMPLETED, FAILED, RUNNING, STANDBY
from .process import Notes, main
from .work import LIMIT, Done, Work, fails


class Mission(ideal.Mission):
    """A mission, and the trip that it is on."""

    __slots__ = ("end", "ok", "under_way")

    def __init__(self, number: int, trips: int) -> None:
        super().__init__(number, trips)
        self.under_way: Trip
        self.ok = False
        self.end = Event()


class Trip(Thread):
    """A flight, a thread of its own."""

    def __init__(self, m: Mission) -> None:
        super().__init__(daemon=True)
        self.m, self.status, self.ended = m, RUNNING, Event()

    def run(self) -> None:
        """Fly."""
        failed = fails(self.m.id, self.m.trip, self.m.attempt)
        self.status = FAILED if failed else COMPLETED
        self.ended.set()


class Observable:
    """Tells others."""

    def __init__(self) -> None:
        self.observers: list[Block] = []

    def notify(self, m: Mission) -> None:
        """The mission comes to each of them."""
        for observer in self.observers:
            observer.update(m)


class Block(Observable):
    """A block of the flow; by itself it lets every mission pass."""

    def __init__(self, app: App) -> None:
        super().__init__()
        self.app = app

    def update(self, m: Mission) -> None:
        """A mission comes: see to it in a thread of its own."""
        Thread(target=self.work, args=(m,), daemon=True).start()

    def work(self, m: Mission) -> None:
        """Do what the block does."""
        self.notify(m)


class Allocator(Block):
    """Waits for a drone."""

    def __init__(self, app: App, drones: int) -> None:
        super().__init__(app)
        self.free, self.freed = [True] * drones, Condition()

    def take(self) -> int:
        """Return the first free drone; none: -1."""
        for drone, free in enumerate(self.free):
            if free:
                self.free[drone] = False
                return drone
        return -1

    def work(self, m: Mission) -> None:
        """Take one, once there is one."""
        with self.freed:
            while (drone := self.take()) < 0:
                self.freed.wait()
        m.drone = drone
        self.notify(m)

    def release(self, drone: int) -> None:
        """A drone is free."""
        with self.freed:
            self.free[drone] = True
            self.freed.notify()


class Launcher(Block):
    """Lets the drone go."""

    def work(self, m: Mission) -> None:
        """Start the trip."""
        m.status, m.under_way = RUNNING, Trip(m)
        m.under_way.start()
        self.notify(m)


class TripMonitor(Block):
    """Waits for the end of the flight."""

    def work(self, m: Mission) -> None:
        """Arrive at the gate with what came of it."""
        trip = m.under_way
        trip.ended.wait()
        self.app.gate.arrive(m, trip, trip.status == COMPLETED)


class TimerMonitor(Block):
    """Gives a flight up that takes too long."""

    def work(self, m: Mission) -> None:
        """Arrive at the gate if it does."""
        trip = m.under_way
        if not trip.ended.wait(LIMIT):
            self.app.gate.arrive(m, trip, False)


class Gate(Block):
    """Lets the first of two branches pass."""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.lock = Lock()
        self.seen: set[Trip] = set()

    def arrive(self, m: Mission, trip: Trip, ok: bool) -> None:
        """A branch arrives."""
        with self.lock:
            if trip in self.seen:
                return
            self.seen.add(trip)
        m.ok = ok
        self.update(m)

    def work(self, m: Mission) -> None:
        """The trip is over."""
        self.app.allocator.release(m.drone)
        m.drone = -1
        if not m.ok:
            m.status = FAILED
            m.failed_trips += 1
            self.app.retry.update(m)
            return
        m.done_trips += 1
        m.trip += 1
        m.attempt = 0
        m.status = STANDBY if m.trip < m.trips else COMPLETED
        (self.app.allocator if m.status == STANDBY else self.app.judge).update(m)


class Retry(Block):
    """Tries a trip once more."""

    def work(self, m: Mission) -> None:
        """One priority higher."""
        m.priority += 1
        m.attempt += 1
        self.notify(m)


class End(Block):
    """Counts the missions that have ended."""

    def __init__(self, app: App, left: int) -> None:
        super().__init__(app)
        self.lock, self.left, self.over = Lock(), left, Event()

    def work(self, m: Mission) -> None:
        """One less."""
        m.end.set()
        with self.lock:
            self.left -= 1
            if not self.left:
                self.over.set()


class App:
    """The blocks, and who observes whom."""

    def __init__(self, work: Work) -> None:
        self.create = Observable()
        self.allocator, self.gate = Allocator(self, work.drones), Gate(self)
        self.retry, self.judge, self.end = Retry(self), Block(self), End(self, work.missions)
        launcher, again = Launcher(self), Block(self)
        self.create.observers = self.retry.observers = [self.allocator]
        self.allocator.observers = [launcher]
        launcher.observers = [TripMonitor(self), TimerMonitor(self)]
        self.judge.observers, again.observers = [again], [self.end]

    def live(self, m: Mission) -> None:
        """Be the thread of a mission."""
        self.create.notify(m)
        m.end.wait()


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    app = App(work)
    missions = [Mission(number, work.trips) for number in range(work.missions)]
    for m in missions:
        Thread(target=app.live, args=(m,), daemon=True).start()
        notes.threads = max(notes.threads, active_count())
    while not app.end.over.wait(0.1):
        notes.threads = max(notes.threads, active_count())
    return ideal.told([*missions])


if __name__ == "__main__":
    main(fly)
