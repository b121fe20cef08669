"""A client that asks and asks, and reads nothing of what it gets; and what it sees when it returns."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Event, Thread

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

ASK = json.dumps({"flight": "", "seen": 0, "log": 0, "results": 0})
"""For everything, as one who has seen nothing yet."""


@contextmanager
def idler(url: str) -> Iterator[Callable[[], int]]:
    """Ask ten times a second without ever reading; the function returns, and gives the newest."""
    over = Event()
    with _line(url) as line:
        asking = Thread(target=_ask, args=(line, over), daemon=True)
        asking.start()

        def back() -> int:
            """Return the version that a client sees who reads again, cut off or not."""
            over.set()
            asking.join()
            with _line(url) as again:
                again.send(ASK)
                version: int = json.loads(again.recv(timeout=10))["version"]
                return version

        try:
            yield back
        finally:
            over.set()
            asking.join()


@contextmanager
def _line(url: str) -> Iterator[ClientConnection]:
    address = url.replace("http://", "ws://") + "/api/live"
    own = {"X-Pluto": "1"}
    with connect(address, additional_headers=own, max_queue=1, close_timeout=1) as line:
        yield line


def _ask(line: ClientConnection, over: Event) -> None:
    end = time.monotonic() + 60
    while not over.wait(0.1) and time.monotonic() < end:
        try:
            line.send(ASK)
        except ConnectionClosed:
            return
