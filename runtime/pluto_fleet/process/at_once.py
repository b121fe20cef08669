"""Work that is never queued behind other work."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

R = TypeVar("R")


async def at_once(call: Callable[[], R]) -> R:
    """Do this in a new thread: the few of the event loop may all be at work for others."""
    thread = ThreadPoolExecutor(1, "at once")
    try:
        return await asyncio.get_running_loop().run_in_executor(thread, call)
    finally:
        thread.shutdown(wait=False)
