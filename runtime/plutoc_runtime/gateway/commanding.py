"""What a brain can say to its gateway, wherever that runs: in this process, or in another."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from ..navigation import Navigation

if TYPE_CHECKING:
    from ..standing import Down, RollCall


class Commanding(Navigation, Protocol):
    """A navigation that remembers every job, for as long as it listens to this brain."""

    async def call(self) -> RollCall:
        """Ask all drones and the ledger how everything stands; from now on the brain is heard."""
        ...

    def attach(self, id: str, report: Callable[[object], None]) -> None:
        """Hear of a job that was given before: when it ends, or now if it has."""
        ...

    def forget(self, id: str) -> None:
        """Nobody will ask for a job any more: its id may be given again."""
        ...

    async def bring_down(self, how: Down) -> None:
        """Break off everything and bring all drones down; return when all that can are down."""
        ...


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
