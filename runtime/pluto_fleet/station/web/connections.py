"""Who connects and then dawdles is let go, and makes room for others: there is always some.

Else a stranger who opens connections and says nothing could keep out the one who wants to press Stop.
"""

from __future__ import annotations

import asyncio
from typing import Protocol

_MOST = 256
"""Connections that wait for a request or an answer; WebSockets have limits of their own."""
_EACH = 10.0
"""Seconds between two looks at a connection, and so how long the head of a request may take."""
_LOOKS = 6
"""After so many looks at one and the same request it is given up: nobody reads the answer."""


class Transport(Protocol):
    """One end of a connection."""

    def is_closing(self) -> bool:
        """Whether it is over."""

    def abort(self) -> None:
        """End it at once."""

    def get_protocol(self) -> object:
        """Return who listens."""


class Cycle(Protocol):
    """A request and its answer."""

    response_complete: bool


class Connection(Protocol):
    """What listens to a connection that speaks HTTP."""

    transport: Transport | None
    cycle: Cycle | None


class MakesConnection(Protocol):
    """How the server makes one."""

    def __call__(
        self,
        *,
        config: object,
        server_state: object,
        app_state: object,
        _loop: asyncio.AbstractEventLoop | None,
    ) -> Connection:
        """Make one."""


class Crowd:
    """All connections; it stands where the server looks for what makes them."""

    def __init__(self, make: MakesConnection) -> None:
        self._make = make
        self._all: dict[Connection, None] = {}  # the oldest first

    def __call__(
        self,
        *,
        config: object,
        server_state: object,
        app_state: object,
        _loop: asyncio.AbstractEventLoop | None = None,
    ) -> Connection:
        """Make a connection, and room for it."""
        self._make_room()
        connection = self._make(
            config=config, server_state=server_state, app_state=app_state, _loop=_loop
        )
        self._all[connection] = None
        self._look_later(connection, (None, True), 0)
        return connection

    def _make_room(self) -> None:
        if len(self._all) < _MOST:
            return
        for connection in [each for each in self._all if _is_over(each)]:
            del self._all[connection]
        if len(self._all) >= _MOST:
            idle = next((each for each in self._all if _is_idle(each)), None)
            if idle is not None:
                self._let_go(idle)

    def _look_later(
        self, connection: Connection, seen: tuple[Cycle | None, bool], looks: int
    ) -> None:
        loop = asyncio.get_running_loop()
        loop.call_later(_EACH, self._look, connection, seen, looks)

    def _look(self, connection: Connection, seen: tuple[Cycle | None, bool], looks: int) -> None:
        """See whether anything has happened since the last look."""
        if _is_over(connection):
            self._all.pop(connection, None)
            return
        now = (connection.cycle, _is_idle(connection))
        looks = looks + 1 if now == seen else 0
        if looks >= (1 if now[1] else _LOOKS):
            self._let_go(connection)
        else:
            self._look_later(connection, now, looks)

    def _let_go(self, connection: Connection) -> None:
        self._all.pop(connection, None)
        if connection.transport is not None:
            connection.transport.abort()


def _is_idle(connection: Connection) -> bool:
    """Whether nothing is being answered."""
    return connection.cycle is None or connection.cycle.response_complete


def _is_over(connection: Connection) -> bool:
    """Whether it is closed, or a WebSocket by now."""
    transport = connection.transport
    return transport is not None and (
        transport.is_closing() or transport.get_protocol() is not connection
    )
