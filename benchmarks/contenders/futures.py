"""Drones and flights on asyncio, for the contenders that are frameworks on top of it."""

from __future__ import annotations

import asyncio
from heapq import heappop, heappush

from .work import LIMIT, fails


class Fleet:
    """The free drones, and the missions that wait for one."""

    def __init__(self, drones: int) -> None:
        self.free, self.seq = list(range(drones)), 0
        self.waiting: list[tuple[int, int, asyncio.Future[int]]] = []

    async def acquire(self, priority: int) -> int:
        """Wait for a drone."""
        if self.free:
            return heappop(self.free)
        turn: asyncio.Future[int] = asyncio.get_running_loop().create_future()
        self.seq += 1
        heappush(self.waiting, (-priority, self.seq, turn))
        return await turn

    def release(self, drone: int) -> None:
        """Hand a drone to the next that waits, or keep it."""
        if self.waiting:
            heappop(self.waiting)[2].set_result(drone)
        else:
            heappush(self.free, drone)


def launch(mission: int, trip: int, attempt: int) -> asyncio.Future[bool]:
    """Fly, watched by a timer; whichever comes first sets the future."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[bool] = loop.create_future()

    def land(ok: bool) -> None:
        if not done.done():
            timer.cancel()
            done.set_result(ok)

    timer = loop.call_later(LIMIT, land, False)
    loop.call_soon(land, not fails(mission, trip, attempt))
    return done
