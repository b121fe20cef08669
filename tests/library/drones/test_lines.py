"""The localization that the pages show: positions that come as lines over UDP."""

from __future__ import annotations

import asyncio
import socket

from lines import Lines

from pluto_fleet.drones.loading import make_localization
from pluto_fleet.drones.localization import LocalizationFeed
from pluto_fleet.shared.domain.model import Point


class Drone:
    """It hears where it is."""

    def __init__(self) -> None:
        self.heard: asyncio.Queue[Point] = asyncio.Queue()

    async def locate(self, position: Point) -> None:
        self.heard.put_nowait(position)


def test_what_is_sent_is_fed_and_what_is_no_line_is_told() -> None:
    said: list[str] = []

    async def play() -> Point:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        source = make_localization("lines:Lines", {"port": port})
        assert isinstance(source, Lines)
        drone = Drone()
        feeding = LocalizationFeed("lines:Lines", source, {"cf1": drone}, said.append)
        feeding.start()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as camera:
            while drone.heard.empty():  # until it listens
                camera.sendto(b'{"drone": "cf1", "position": [1, 2, 0.5]}', ("127.0.0.1", port))
                await asyncio.sleep(0)
            camera.sendto(b"nonsense", ("127.0.0.1", port))
            while not said:
                await asyncio.sleep(0)
        await feeding.close()
        return drone.heard.get_nowait()

    assert asyncio.run(asyncio.wait_for(play(), 20)) == (1.0, 2.0, 0.5)
    assert said[0].startswith("the localization lines:Lines gives no positions any more (JSON")
