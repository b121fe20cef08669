"""The built-in tracker `lines`: what moves, as another program says it over TCP, a JSON object a line.

Such as `{"id": "t7", "kind": "person", "at": [2.0, 7.5, 0.0]}`, in the map's metres; `ago` may say how many
seconds ago that was.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Mapping
from contextlib import closing
from time import monotonic

from ..shared.domain.errors import BadInput
from .tracking import Track

LONGEST = 10_000
"""Bytes of a line."""


class Lines:
    """Reads what another program says at an address."""

    def __init__(self, options: Mapping[str, object]) -> None:
        address = options.get("address")
        host, _, port = str(address).rpartition(":")
        if not host or not port.isdecimal() or [*options] != ["address"]:
            raise BadInput('it takes one option, such as address = "127.0.0.1:5006"')
        self._host = host
        self._port = int(port)

    async def tracks(self) -> AsyncIterator[Track]:
        """Yield what is said, as long as the other program serves."""
        reader, writer = await asyncio.open_connection(self._host, self._port, limit=LONGEST)
        with closing(writer):
            while line := await reader.readline():
                said = json.loads(line)
                x, y, z = said["at"]
                yield Track(
                    id=said["id"],
                    kind=said.get("kind", ""),
                    at=(x, y, z),
                    time=monotonic() - said.get("ago", 0.0),
                )
