"""How far one can go on asyncio: a coroutine a mission, resumed straight from navigation's callback.

No task and no Future for a wait, and one timer of the loop for all flights: they are all watched for
as long, so they expire in the order in which they began.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Generator
from heapq import heappop, heappush
from types import coroutine

from .ideal import COMPLETED, FAILED, RUNNING, STANDBY, Mission, Navigation, told
from .process import Notes, main
from .work import LIMIT, Done, Work


@coroutine
def suspend() -> Generator[None, int, int]:
    """Wait until the runtime goes on, with what it sends."""
    return (yield)


class Waiting(Mission):
    """A mission that can be resumed; what comes too late has an old `epoch`."""

    __slots__ = ("epoch", "send")

    epoch: int
    send: Callable[[int | None], None]


class Runtime:
    """Resumes missions, and keeps the drones and the timers."""

    __slots__ = ("armed", "finished", "free", "left", "loop", "nav", "seq", "timers", "waiting")

    def __init__(
        self, drones: int, loop: asyncio.AbstractEventLoop, nav: Navigation, left: int
    ) -> None:
        self.loop, self.nav, self.left = loop, nav, left
        self.free, self.seq = list(range(drones)), 0
        self.waiting: list[tuple[int, int, Callable[[int | None], None]]] = []
        self.finished: asyncio.Future[None] = loop.create_future()
        self.timers: deque[tuple[float, Waiting, int]] = deque()
        self.armed = False

    def step(self, send: Callable[[int | None], None], value: int | None) -> None:
        """Let a mission go on up to its next wait."""
        try:
            send(value)
        except StopIteration:
            self.left -= 1
            if not self.left:
                self.finished.set_result(None)

    def wake(self, m: Waiting, epoch: int, value: int) -> None:
        """Let a mission go on, unless it has gone on already."""
        if m.epoch == epoch:
            m.epoch += 1
            self.step(m.send, value)

    def arm(self, m: Waiting) -> None:
        """Watch a flight."""
        self.timers.append((self.loop.time() + LIMIT, m, m.epoch))
        if not self.armed:
            self.armed = True
            self.loop.call_later(LIMIT, self.tick)

    def tick(self) -> None:
        """Give up what flies too long."""
        now, timers = self.loop.time(), self.timers
        while timers:
            until, m, epoch = timers[0]
            if m.epoch == epoch and until > now:
                break
            timers.popleft()
            self.wake(m, epoch, False)
        self.armed = bool(timers)
        if timers:
            self.loop.call_at(timers[0][0], self.tick)

    def release(self, drone: int) -> None:
        """Hand a drone to the next that waits, or keep it."""
        if self.waiting:
            self.loop.call_soon(self.step, heappop(self.waiting)[2], drone)
        else:
            heappush(self.free, drone)


async def flow(m: Waiting, runtime: Runtime) -> None:
    """Take one mission from start to end."""
    while True:
        if runtime.free:
            m.drone = heappop(runtime.free)
        else:
            runtime.seq += 1
            heappush(runtime.waiting, (-m.priority, runtime.seq, m.send))
            m.drone = await suspend()
        m.status = RUNNING
        runtime.arm(m)
        runtime.nav.start(m.drone, m, runtime.wake, m, m.epoch)
        ok = await suspend()
        runtime.release(m.drone)
        m.drone = -1
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


async def all_flows(work: Work, notes: Notes) -> Done:
    """Fly all missions side by side."""
    loop = asyncio.get_running_loop()
    nav = Navigation(loop, work.flight, notes)
    runtime = Runtime(work.drones, loop, nav, work.missions)
    missions = [Waiting(number, work.trips) for number in range(work.missions)]
    for m in missions:
        m.send, m.epoch = flow(m, runtime).send, 0
        runtime.step(m.send, None)
    await runtime.finished
    return told([*missions])


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    return asyncio.run(all_flows(work, notes))


if __name__ == "__main__":
    main(fly)
