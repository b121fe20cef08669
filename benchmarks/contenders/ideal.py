"""The ideal: what a very good engineer writes by hand on asyncio. All others are held against it.

One coroutine a mission, a heap of free drones, a Future for each flight and a timer of the loop; no
copies, no task for a block. It records nothing.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from heapq import heappop, heappush
from typing import TypeVarTuple

from .process import Notes, main
from .work import LIMIT, Done, Work, fails

STANDBY, COMPLETED, FAILED, RUNNING = 0, 1, 2, 3

Ts = TypeVarTuple("Ts")


class Mission:
    """A mission, and how far it is."""

    __slots__ = (
        "attempt",
        "done_trips",
        "drone",
        "failed_trips",
        "id",
        "priority",
        "status",
        "trip",
        "trips",
    )

    def __init__(self, number: int, trips: int) -> None:
        self.id = number
        self.trips = trips
        self.trip = 0
        self.attempt = 0
        self.priority = 0
        self.status = STANDBY
        self.drone = -1
        self.done_trips = 0
        self.failed_trips = 0


class Navigation:
    """Flies at once, or for a while; calls back from the loop, never from `start`."""

    __slots__ = ("flight", "loop", "notes")

    def __init__(self, loop: asyncio.AbstractEventLoop, flight: float, notes: Notes) -> None:
        self.loop, self.flight, self.notes = loop, flight, notes

    def start(
        self, drone: int, m: Mission, done: Callable[[*Ts, bool], None], *arguments: *Ts
    ) -> None:
        """Fly, then call `done` with these arguments and whether it went well."""
        ok = not fails(m.id, m.trip, m.attempt)
        if self.flight:
            self.notes.launched(drone, self.loop.time())
            self.loop.call_later(self.flight, self.land, drone, done, *arguments, ok)
        else:
            self.loop.call_soon(done, *arguments, ok)

    def land(
        self, drone: int, done: Callable[[*Ts, bool], None], *arguments: *tuple[*Ts, bool]
    ) -> None:
        """A flight that took time is over."""
        self.notes.landed(drone, self.loop.time())
        done(*arguments)


class Fleet:
    """The free drones, and the missions that wait for one."""

    __slots__ = ("free", "seq", "waiting")

    def __init__(self, drones: int) -> None:
        self.free = list(range(drones))
        self.waiting: list[tuple[int, int, asyncio.Future[int]]] = []
        self.seq = 0

    def release(self, drone: int) -> None:
        """Hand a drone to the next that waits, or keep it."""
        if self.waiting:
            heappop(self.waiting)[2].set_result(drone)
        else:
            heappush(self.free, drone)


def land(done: asyncio.Future[bool], ok: bool) -> None:
    """A flight is over."""
    if not done.done():
        done.set_result(ok)


def expire(done: asyncio.Future[bool]) -> None:
    """A flight takes too long."""
    if not done.done():
        done.set_result(False)


async def flow(m: Mission, loop: asyncio.AbstractEventLoop, fleet: Fleet, nav: Navigation) -> None:
    """Take one mission from start to end."""
    while True:
        if fleet.free:  # allocate
            drone = heappop(fleet.free)
        else:
            turn: asyncio.Future[int] = loop.create_future()
            fleet.seq += 1
            heappush(fleet.waiting, (-m.priority, fleet.seq, turn))
            drone = await turn
        m.drone = drone
        m.status = RUNNING  # launch
        done: asyncio.Future[bool] = loop.create_future()
        nav.start(drone, m, land, done)
        timer = loop.call_at(loop.time() + LIMIT, expire, done)  # [watch, timer] -> first
        ok = await done
        timer.cancel()
        fleet.release(drone)
        m.drone = -1
        if not ok:
            m.status = FAILED
            m.failed_trips += 1
            m.attempt += 1
            m.priority += 1  # retry
            continue
        m.done_trips += 1
        m.trip += 1
        m.attempt = 0
        if m.trip < m.trips:
            m.status = STANDBY
            continue
        m.status = COMPLETED
        return  # judge -> again -> end


async def all_flows(work: Work, notes: Notes) -> Done:
    """Fly all missions side by side."""
    loop = asyncio.get_running_loop()
    nav = Navigation(loop, work.flight, notes)
    missions = [Mission(number, work.trips) for number in range(work.missions)]
    fleet = Fleet(work.drones)
    tasks = [loop.create_task(flow(m, loop, fleet, nav)) for m in missions]
    for task in tasks:
        await task
    return told(missions)


def told(missions: list[Mission]) -> Done:
    """Return what came of the missions."""
    return Done(
        missions=sum(m.status == COMPLETED for m in missions),
        completed=sum(m.done_trips for m in missions),
        failed=sum(m.failed_trips for m in missions),
    )


def fly(work: Work, notes: Notes) -> Done:
    """Do the work once."""
    return asyncio.run(all_flows(work, notes))


if __name__ == "__main__":
    main(fly)
