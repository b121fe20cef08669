"""What a brain can say to a gateway in another process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ..navigation import Commanding


class Reached(Commanding, Protocol):
    """The same, of a gateway in another process."""

    def when_seen(self, watcher: Callable[[], object]) -> None:
        """Call this whenever something was heard of the drones."""
        ...

    async def goodbye(self) -> None:
        """Let the gateway end, once all drones are down; nothing is lost by that."""
        ...

    async def close(self) -> None:
        """Hang up: the gateway goes on, and lands everything if nobody else comes."""
        ...
