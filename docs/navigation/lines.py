"""Says where drones are, as told over UDP: a whole localization.

Each packet is a line such as `{"drone": "cf1", "position": [1.0, 2.0, 0.5]}`, in the map's metres.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Mapping
from contextlib import closing

from pluto_fleet.drones import Point


class Lines(asyncio.DatagramProtocol):
    def __init__(self, options: Mapping[str, object]) -> None:
        self.port = int(str(options.get("port", 5005)))
        self.heard: asyncio.Queue[bytes] = asyncio.Queue()

    def datagram_received(self, data: bytes, address: object) -> None:
        self.heard.put_nowait(data)

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
        loop = asyncio.get_running_loop()
        here = ("127.0.0.1", self.port)
        transport, _ = await loop.create_datagram_endpoint(lambda: self, local_addr=here)
        with closing(transport):
            while True:
                told = json.loads(await self.heard.get())
                x, y, z = map(float, told["position"])
                yield told["drone"], (x, y, z)
