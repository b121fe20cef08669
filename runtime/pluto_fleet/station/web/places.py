"""The places of WebSockets that have not said yet who they are: a stranger can keep no one from them."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager


class Displaced(Exception):
    """Raised in a connection whose place another has taken."""


class WaitingPlaces:
    """So many places; where all are taken, one more takes the oldest of the client that has most of them."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._waiting: dict[asyncio.Task[None], str] = {}
        """The client of each connection, the oldest first."""

    @contextmanager
    def taken(self, task: asyncio.Task[None], client: str) -> Iterator[None]:
        """Keep a place for a connection, whose task raises `Displaced` if another takes it."""
        if len(self._waiting) >= self._most:
            self._make_room()
        self._waiting[task] = client
        try:
            yield
        except asyncio.CancelledError:
            if task in self._waiting:  # the whole station ends
                raise
            task.uncancel()
            raise Displaced from None
        finally:
            self._waiting.pop(task, None)

    def _make_room(self) -> None:
        [(greedy, _)] = Counter(self._waiting.values()).most_common(1)
        oldest = next(task for task, client in self._waiting.items() if client == greedy)
        del self._waiting[oldest]
        oldest.cancel()
