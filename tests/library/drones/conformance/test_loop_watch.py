"""The watch over the event loop says what holds it up, and does not blame it for a busy machine."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable

from pluto_fleet.drones.conformance.probes import LoopWatch

LONG = 0.1
"""Seconds: twice what is found."""


class LateThread(threading.Thread):
    """One that the machine lets run only after a while."""

    def _bootstrap(self) -> None:
        time.sleep(LONG)
        super()._bootstrap()  # type: ignore[misc]  # as `threading` calls it


def found(held_up_by: Callable[[], object]) -> list[str]:
    """Return what the watch has found when a turn of the loop does this."""

    async def watched() -> list[str]:
        with LoopWatch() as watch:
            await asyncio.sleep(0.05)
            held_up_by()
            await asyncio.sleep(0.05)
        return watch.found

    return asyncio.run(watched())


def test_a_thread_that_the_machine_starts_late_is_not_blamed() -> None:
    thread = LateThread(target=time.sleep, args=(0,))
    assert found(thread.start) == []
    thread.join()
