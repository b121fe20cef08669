"""Says where things are that move, as told over UDP: a whole tracker.

Each packet is a line such as `{"body": "cart", "position": [1.0, 2.0, 0.0]}`, in the map's metres.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Mapping
from contextlib import closing

from pluto_fleet.drones import Track


class Bodies(asyncio.DatagramProtocol):
    def __init__(self, options: Mapping[str, object]) -> None:
        self.port = int(str(options.get("port", 5006)))
        self.heard: asyncio.Queue[bytes] = asyncio.Queue()

    def datagram_received(self, data: bytes, address: object) -> None:
        self.heard.put_nowait(data)

    async def tracks(self) -> AsyncIterator[Track]:
        loop = asyncio.get_running_loop()
        here = ("127.0.0.1", self.port)
        transport, _ = await loop.create_datagram_endpoint(lambda: self, local_addr=here)
        with closing(transport):
            while True:
                told = json.loads(await self.heard.get())
                x, y, z = map(float, told["position"])
                yield Track(id=told["body"], kind="cart", at=(x, y, z))
