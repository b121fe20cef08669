"""The watch over the event loop does not blame it for a busy machine."""

from __future__ import annotations

import asyncio
import threading
import time

from pluto_fleet.drones.conformance.probes import LoopWatch

LONG = 0.1
"""Seconds: twice what is found."""


class LateThread(threading.Thread):
    """One that the machine lets run only after a while."""

    def _bootstrap(self) -> None:
        time.sleep(LONG)
        super()._bootstrap()  # type: ignore[misc]  # as `threading` calls it


def test_a_thread_that_the_machine_starts_late_is_not_blamed() -> None:
    thread = LateThread(target=time.sleep, args=(0,))

    async def watched() -> list[str]:
        with LoopWatch() as watch:
            await asyncio.sleep(0.05)
            thread.start()
            await asyncio.sleep(0.05)
        return watch.found

    assert asyncio.run(watched()) == []
    thread.join()
