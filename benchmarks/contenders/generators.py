"""Virtual time at its barest: a generator a mission, and a loop of a few lines that resumes them.

What happens at the present instant goes through a deque, what comes later through a heap. Nothing is
ordered but by time and by who came first, and nothing is recorded.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator
from heapq import heappop, heappush
from typing import Any

from .ideal import COMPLETED, FAILED, RUNNING, STANDBY, Mission, told
from .process import Notes, main
from .work import LIMIT, Done, Work, fails


class Waiting(Mission):
    """A mission that can be resumed; what comes too late has an old `epoch`."""

    __slots__ = ("epoch", "send")

    epoch: int
    send: Callable[[int | None], None]


class Simulation:
    """The clock, what is to happen, and the drones."""

    __slots__ = ("flight", "free", "heap", "now", "ready", "seq", "timers", "waiting", "wseq")

    def __init__(self, drones: int, flight: float) -> None:
        self.now, self.flight = 0.0, flight
        self.seq = self.wseq = 0
        self.ready: deque[tuple[Waiting, int, int | None]] = deque()
        self.heap: list[tuple[float, int, Waiting, int, bool]] = []
        self.timers: deque[tuple[float, Waiting, int]] = deque()
        self.free = list(range(drones))
        self.waiting: list[tuple[int, int, Waiting]] = []

    def start(self, m: Waiting, epoch: int) -> None:
        """Fly."""
        ok = not fails(m.id, m.trip, m.attempt)
        if self.flight:
            self.seq += 1
            heappush(self.heap, (self.now + self.flight, self.seq, m, epoch, ok))
        else:
            self.ready.append((m, epoch, ok))

    def run(self) -> None:
        """Go on until nothing is left to happen."""
        ready, heap, timers = self.ready, self.heap, self.timers
        while True:
            while ready:
                wake(*ready.popleft())
            if not heap:
                return
            now = heap[0][0]
            while timers and timers[0][0] <= now:
                _, m, epoch = timers.popleft()
                wake(m, epoch, False)
            self.now = now
            while heap and heap[0][0] == now:
                _, _, m, epoch, ok = heappop(heap)
                ready.append((m, epoch, ok))


def wake(m: Waiting, epoch: int, value: int | None) -> None:
    """Let a mission go on, unless it has gone on already."""
    if m.epoch == epoch:
        m.epoch += 1
        try:
            m.send(value)
        except StopIteration:
            return


def flow(m: Waiting, simulation: Simulation) -> Generator[None, Any, None]:
    """Take one mission from start to end."""
    while True:
        if simulation.free:
            m.drone = heappop(simulation.free)
        else:
            simulation.wseq += 1
            heappush(simulation.waiting, (-m.priority, simulation.wseq, m))
            m.drone = yield
        m.status = RUNNING
        simulation.timers.append((simulation.now + LIMIT, m, m.epoch))
        simulation.start(m, m.epoch)
        ok = yield
        if simulation.waiting:
            other = heappop(simulation.waiting)[2]
            simulation.ready.append((other, other.epoch, m.drone))
        else:
            heappush(simulation.free, m.drone)
        if not ok:
            m.status = FAILED
            m.failed_trips += 1
            m.attempt += 1
            m.priority += 1
            continue
        m.done_trips += 1
        m.trip += 1
        m.attempt = 0
        if m.trip < m.trips:
            m.status = STANDBY
            continue
        m.status = COMPLETED
        return


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    simulation = Simulation(work.drones, work.flight)
    missions = [Waiting(number, work.trips) for number in range(work.missions)]
    for m in missions:
        m.send, m.epoch = flow(m, simulation).send, 0
        simulation.ready.append((m, 0, None))
    simulation.run()
    return told([*missions])


if __name__ == "__main__":
    main(fly)
