"""The client: everything that can be asked of a station, and what happens there as it happens."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .connection import Connection

if TYPE_CHECKING:
    from ..station.wire import LiveMessage


class Station(Connection):
    """A ground station: `Station("http://127.0.0.1:8765", token="…")`.

    What is refused raises `Refused` with the station's sentence. A command may be sent again with the
    same `id`, as after a lost answer: it is done once.
    """

    def updates(self) -> Iterator[LiveMessage]:
        """Yield what happens, as it happens: first everything, then what has changed, for ever.

        There is one message a second at least.
        """
        server, flight, seen, log, results = "", "", 0, 0, 0
        while True:
            message = self.live(flight=flight, seen=seen, log=log, results=results)
            if server not in ("", message["server"]):  # its versions count anew
                server, flight, seen, log, results = "", "", 0, 0, 0
                continue
            if message["flight"] != flight:
                log = results = 0
            server, flight, seen = message["server"], message["flight"], message["version"]
            log = max([log, *(line["number"] for line in message["log"])])
            results = max([results, *(one["number"] for one in message["results"])])
            yield message
