"""Which connection to a web server makes room for another: the station's and the graph editor's rule.

An idle connection makes room for others: else a client that opens many and sends nothing could lock out all others.
A place is kept for those who have a token: where there are too many, those go first that have shown none, even while
they are answered.
"""

from __future__ import annotations

from typing import Any

CONNECTIONS = 256
"""The most HTTP connections; WebSockets have limits of their own."""
LOOK_EVERY = 10.0
"""The interval of checks of a connection, and so the time-out of a request's head, in seconds."""
LOOKS = 6
"""The number of checks after which a request is given up whose answer is not read."""


class LimitedConnection:
    """What a connection of uvicorn's has beside, so that it is closed when it is idle for too long, or others need its place.

    Where a web server is installed, a class inherits this, and then uvicorn's `H11Protocol`, whose these first four are.
    """

    loop: Any
    connections: set[Any]
    cycle: Any
    transport: Any
    began = 0.0
    """When it was made, on the loop's clock."""

    @property
    def has_token(self) -> bool:
        """Whether its latest request had a token, or none is needed."""
        raise NotImplementedError

    @property
    def is_open(self) -> bool:
        """Whether it is one still: it was not closed, nor became a WebSocket."""
        return self in self.connections

    @property
    def is_idle(self) -> bool:
        """Whether no request is being handled."""
        return self.cycle is None or self.cycle.response_complete

    def take_in(self) -> None:
        """Make room for it, as it is new, and close it once it is idle for too long."""
        self.began = self.loop.time()
        others = [
            each
            for each in self.connections
            if isinstance(each, LimitedConnection) and each is not self
        ]
        if len(others) >= CONNECTIONS:
            least = min(others, key=_claim)
            if least.is_idle or not least.has_token:
                least.let_go()
        _look_later(self, 0)

    def let_go(self) -> None:
        """Close it at once."""
        self.connections.discard(self)
        self.transport.abort()


def _claim(connection: LimitedConnection) -> tuple[bool, bool, float]:
    """Return how good a connection's claim to its place is."""
    return connection.has_token, not connection.is_idle, connection.began


def _look_later(connection: LimitedConnection, looks: int) -> None:
    seen = connection.cycle, connection.is_idle
    connection.loop.call_later(LOOK_EVERY, _look, connection, seen, looks)


def _look(connection: LimitedConnection, seen: tuple[object, bool], looks: int) -> None:
    """Close it if nothing has happened since the last check."""
    if not connection.is_open:
        return
    before, was_idle = seen
    unchanged = connection.cycle is before and connection.is_idle is was_idle
    looks = looks + 1 if unchanged else 0
    if looks >= (1 if connection.is_idle else LOOKS):
        connection.let_go()
    else:
        _look_later(connection, looks)
