"""Leaves a thread behind that keeps the program from ending."""

from __future__ import annotations

import threading

from tests.navigation.simulated import Simulated

FOUND_BY = "test_closing_leaves_no_thread_task_or_socket"
SAYS = "the thread radio"


class Wrong(Simulated):
    """It waits for a word that never comes."""

    over = threading.Event()

    async def connect(self) -> None:
        await super().connect()
        threading.Thread(target=self.over.wait, args=(60,), name="radio").start()
