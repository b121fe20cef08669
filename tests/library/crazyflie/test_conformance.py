"""A Crazyflie passes the kit: flown through the unmodified cflib, over UDP, against simulated ones."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import ClassVar

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import DroneNavigation, DroneSetup

pytest.importorskip("cflib")

NO_DRONE = "udp://127.0.0.1:9"


class Hangar:
    """Simulated Crazyflies in a thread of their own: each flight of the kit has its own loop."""

    def __init__(self, folder: Path) -> None:
        builds = [Build(id=f"cf{at}", home=(float(at), 2.0, 0.0)) for at in range(1, 9)]
        self.folder, self.server = folder, Server(builds, MemoryLog())
        self.fresh = list(reversed(builds))
        self.flown: dict[DroneNavigation, SimulatedCrazyflie] = {}
        self._loop = asyncio.new_event_loop()
        self._thread = Thread(target=self._loop.run_forever, name="hangar", daemon=True)
        self._thread.start()
        asyncio.run_coroutine_threadsafe(self.server.start(), self._loop).result(10)

    def take(self, uri: str | None = None) -> DroneNavigation:
        """Return the navigation of a drone that has not flown yet, or of one that is not there."""
        build = self.fresh.pop()
        uri = uri or self.server.uris[build.id]
        setup = DroneSetup(
            id=build.id, uri=uri, home=build.home, speed=1.0, options={}, folder=self.folder
        )
        navigation = Crazyflie(setup)
        self.flown[navigation] = self.server.drones[build.id]
        return navigation

    def let(self, navigation: DroneNavigation, what: str) -> None:
        """Let something happen to its drone, soon."""
        drone = self.flown[navigation].build.id
        asyncio.run_coroutine_threadsafe(self.server.let(drone, what, True), self._loop)

    def close(self) -> None:
        """Put them away."""
        asyncio.run_coroutine_threadsafe(self.server.close(), self._loop).result(10)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()


class TestCrazyflie(NavigationContract):
    """In real time, as the firmware flies."""

    height, away, speed, rest = 0.3, 0.8, 1.5, 0.15
    may_fall = together = True
    hangar: ClassVar[Hangar]

    def make(self) -> DroneNavigation:
        return self.hangar.take()

    def make_unreachable(self) -> DroneNavigation:
        return self.hangar.take(NO_DRONE)

    def silence(self, navigation: DroneNavigation) -> None:
        self.hangar.let(navigation, "silent")

    def crash(self, navigation: DroneNavigation) -> None:
        self.hangar.let(navigation, "tumble")

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        body = self.hangar.flown[navigation].body
        return Truth(position=body.position, yaw=body.yaw, motors=body.motors)


@pytest.fixture(scope="module", autouse=True)
def hangar(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Have simulated Crazyflies while the kit flies them."""
    TestCrazyflie.hangar = Hangar(tmp_path_factory.mktemp("hangar"))
    yield
    TestCrazyflie.hangar.close()
