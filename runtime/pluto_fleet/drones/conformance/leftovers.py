"""What a navigation has left behind: threads that keep a program from ending, tasks, open sockets."""

from __future__ import annotations

import asyncio
import gc
import socket
import threading
from dataclasses import dataclass

_EXECUTOR = "asyncio_"
"""Threads of the loop's own pool: the loop ends them."""


@dataclass(frozen=True, slots=True)
class There:
    """What there is at one moment, in the running loop's process."""

    threads: frozenset[threading.Thread]
    tasks: frozenset[asyncio.Task[object]]
    sockets: frozenset[tuple[int, int]]
    """Each by its identity and its file descriptor."""


def there() -> There:
    """Look around."""
    return There(
        threads=frozenset(
            thread
            for thread in threading.enumerate()
            if not thread.daemon and not thread.name.startswith(_EXECUTOR)
        ),
        tasks=frozenset(asyncio.all_tasks()),
        sockets=frozenset(
            (id(one), one.fileno())
            for one in gc.get_objects()
            if type(one) is socket.socket and one.fileno() >= 0
        ),
    )


async def left_since(before: There, seconds: float = 1.0) -> list[str]:
    """Return what has come since and is still there after a while, a few words each."""
    loop = asyncio.get_running_loop()
    limit = loop.time() + seconds
    while found := _found(before, there()):
        if loop.time() > limit:
            break
        await asyncio.sleep(0.05)
    return found


def _found(before: There, now: There) -> list[str]:
    threads = [f"the thread {one.name}" for one in now.threads - before.threads]
    tasks = [f"the task {one.get_coro()}" for one in now.tasks - before.tasks]
    sockets = [f"a socket, number {number}" for _, number in now.sockets - before.sockets]
    return sorted(threads) + sorted(tasks) + sorted(sockets)
