"""A Crazyflie passes the kit: flown through the unmodified cflib, in virtual time, against simulated ones."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar

import pytest

from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server, let
from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import DroneNavigation
from tests.kit.unthreaded import AirLoop, one_thread
from tests.library.crazyflie.hangar import navigation

BUILDS = [Build(id=f"cf{at}", home=(float(at), 2.0, 0.0)) for at in range(1, 9)]
NO_DRONE = "udp://127.0.0.1:99"


class TestCrazyflie(NavigationContract):
    height, away, speed, rest = 0.3, 0.8, 1.5, 0.15
    may_fall = together = True
    folder: ClassVar[Path]
    server: ClassVar[Server]
    fresh: ClassVar[list[Build]]
    """The drones that have not flown yet."""
    flown: ClassVar[dict[DroneNavigation, SimulatedCrazyflie]]

    @staticmethod
    def loop_factory() -> asyncio.AbstractEventLoop:
        here, loop = TestCrazyflie, AirLoop()
        here.server = Server(BUILDS, FlightLog())
        here.fresh = [*BUILDS]
        here.flown = {}
        loop.run_until_complete(here.server.start())
        return loop

    def make(self) -> DroneNavigation:
        return self._made(self.server.uris[self.fresh[-1].id])

    def make_unreachable(self) -> DroneNavigation:
        return self._made(NO_DRONE)

    def _made(self, uri: str) -> DroneNavigation:
        build = self.fresh.pop()
        made = navigation(build, uri, self.folder)
        self.flown[made] = self.server.drones[build.id]
        return made

    def silence(self, navigation: DroneNavigation) -> None:
        self._let(navigation, "silent")

    def crash(self, navigation: DroneNavigation) -> None:
        self._let(navigation, "tumble")

    def _let(self, navigation: DroneNavigation, what: str) -> None:
        end = self.server.endpoints[self.flown[navigation].build.id]
        let(end.drone, end.air, what, True)

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        body = self.flown[navigation].body
        return Truth(position=body.position, yaw=body.yaw, motors=body.motors)


@pytest.fixture(scope="module", autouse=True)
def air(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    pytest.importorskip("cflib")
    TestCrazyflie.folder = tmp_path_factory.mktemp("hangar")
    with one_thread():
        yield
